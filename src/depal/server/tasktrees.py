"""The executive's trees as the cell's state tells them."""

from depal.executive.state import State
from depal.executive.tree import NodeState, state_of
from depal.executive.why import why
from depal.server.cellstate import TaskNode, TaskTree

RUNNING = "running"


def trees_of(state: State) -> tuple[TaskTree, ...]:
    """The task trees with the states that the paper's figures show."""
    trees = []
    for tree in state.trees.values():
        standings = state.standings(tree)
        nodes = []
        for live, standing in zip(tree.nodes, standings, strict=True):
            shown = state_of(live=standing.live, post=standing.post)
            running = live.attempt is not None
            text = why(state, tree, live.node.index).text if shown is NodeState.DISABLED else ""
            nodes.append(
                TaskNode(
                    live.node.label,
                    live.node.depth,
                    RUNNING if running else shown.value,
                    not live.node.children,
                    text,
                )
            )
        trees.append(TaskTree(tree.number, tree.priority, tuple(nodes)))
    return tuple(trees)
