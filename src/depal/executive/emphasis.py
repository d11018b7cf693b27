"""Emphasis: who goes first, as the attentional executive SEED weighs it.

    e(n) = sum over s of w_s c_s(n) + w_parent e(parent),   0 where the branch is not released

The contributions: the priority of the tree's request (at the root), the bias written in the
task file, a stimulus from below, and the time that a node has waited, so that nobody starves.
"""

from dataclasses import dataclass

from depal.executive.nodes import LiveNode


@dataclass(frozen=True, slots=True)
class EmphasisWeights:
    """The weights of the contributions.

    Attributes:
        priority: of the tree's priority, at its root.
        bias: of the step's bias.
        parent: of the parent's emphasis.
        age: per second of waiting.
        margin: by how much a challenger must exceed a running holder to displace it.
    """

    priority: float = 1.0
    bias: float = 1.0
    parent: float = 1.0
    age: float = 0.001
    margin: float = 0.2


def resting_emphasis(node: LiveNode, weights: EmphasisWeights) -> float:
    """The emphasis of a released node without its age."""
    own = weights.bias * node.node.bias
    if node.parent is None:
        return own + weights.priority * node.tree.priority
    return own + weights.parent * resting_emphasis(node.parent, weights)


def rank(node: LiveNode, weights: EmphasisWeights) -> float:
    """A number that orders waiting nodes as their emphasis does at any time.

    All of them age alike, so the order of e + age * (now - since) is that of e - age * since.
    """
    return resting_emphasis(node, weights) - weights.age * node.waiting_since
