"""A task tree as an indented list in the paper's colours, with why a task does not run."""

from collections.abc import Sequence

from depal.server.cellstate import TaskNode, TaskTree
from depal.server.screen.markup import Markup, joined, tag
from depal.server.screen.panels.marks import NODES
from depal.server.screen.words import Words


def trees(found: Sequence[TaskTree], words: Words) -> Markup:
    """Every tree, the most important first."""
    if not found:
        return tag("p", words("tree.none"), cls="quiet")
    ordered = sorted(found, key=lambda tree: -tree.priority)
    return joined(_tree(tree, words) for tree in ordered)


def _tree(tree: TaskTree, words: Words) -> Markup:
    head = words("tree.priority", number=tree.number, priority=f"{tree.priority:.2f}")
    rows = joined(_node(node, words) for node in tree.nodes)
    return tag("section", tag("h4", head), tag("ul", rows, cls="tree"), cls="task")


def _node(node: TaskNode, words: Words) -> Markup:
    look = NODES[node.state]
    style = f"background:{look.tint.fill};color:{look.tint.text};border-color:{look.tint.line}"
    shape = "oval is-running" if node.state == "running" else "oval"
    oval = tag(
        "span",
        tag("span", look.shape, aria_hidden="true"),
        " ",
        node.label,
        tag("small", words(f"node.{node.state}")),
        cls=f"{shape} is-action" if node.concrete else shape,
        style=style,
    )
    why = tag("span", node.why, cls="why") if node.why else None
    return tag("li", oval, why, style=f"--depth:{node.depth}")
