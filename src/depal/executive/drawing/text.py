"""A tree as text, for terminals and logs."""

from depal.executive.drawing.words import Drawn, Standings, drawn
from depal.executive.tree import NodeState, Tree


def tree_text(tree: Tree, standings: Standings = None) -> str:
    """Draws a tree with lines, one node a row.

    Abstract nodes hang on dashed lines and concrete ones on continuous lines. Behind each node
    stand its state, as a mark and a word, and its precondition, marked where it does not hold.

    Args:
        tree: what is allocated, or a schema grounded in its own parameters.
        standings: of its nodes; None for none.

    Returns:
        Lines, the last one with its end.
    """
    rows = [
        (_stem(tree, one) + one.label, _state(one), _notes(one)) for one in drawn(tree, standings)
    ]
    widths = [max(len(row[column]) for row in rows) for column in range(2)]
    lines = (
        "  ".join(
            part
            for part in (
                row[0].ljust(widths[0]),
                row[1].ljust(widths[1]) if widths[1] else None,
                row[2],
            )
            if part is not None
        )
        for row in rows
    )
    return "".join(f"{line.rstrip()}\n" for line in lines)


def _stem(tree: Tree, one: Drawn) -> str:
    """The lines from the root to a node."""
    node = one.node
    if node.parent < 0:
        return ""
    last = tree.nodes[node.parent].children[-1] == node.index
    stem = ("└" if last else "├") + ("─ " if node.concrete else "╌ ")
    above = tree.nodes[node.parent]
    while above.parent >= 0:
        siblings = tree.nodes[above.parent].children
        stem = ("   " if siblings[-1] == above.index else "│  ") + stem
        above = tree.nodes[above.parent]
    return stem


def _state(one: Drawn) -> str:
    if one.state is None:
        return ""
    marks = {NodeState.ACCOMPLISHED: "✓", NodeState.DISABLED: "✗", NodeState.ENABLED: "○"}
    return f"{'▶' if one.ready else marks[one.state]} {one.word}"


def _notes(one: Drawn) -> str:
    """With the word that a file has before a precondition."""
    notes = list(one.notes)
    if one.when:
        first = f"when {one.when}"
        notes[0] = first if one.met is None else f"{'✓' if one.met else '✗'} {first}"
    return ", ".join(notes)
