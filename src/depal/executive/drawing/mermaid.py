"""A tree as a Mermaid flowchart, for documents that draw it themselves."""

from depal.executive.drawing.palette import PALETTE
from depal.executive.drawing.words import Drawn, Standings, drawn
from depal.executive.tree import Tree


def tree_mermaid(tree: Tree, standings: Standings = None) -> str:
    """Writes a tree as a flowchart.

    Args:
        tree: what is allocated, or a schema grounded in its own parameters.
        standings: of its nodes; None for none.

    Returns:
        The text of the chart.
    """
    nodes = drawn(tree, standings)
    lines = ["flowchart TD"]
    lines += [f"    {_oval(one)}" for one in nodes]
    for one in nodes:
        if one.node.parent >= 0:
            label = f'|"{_escaped(", ".join(one.notes))}"|' if one.notes else ""
            lines.append(f"    n{one.node.parent} -->{label} n{one.node.index}")
    for state, tint in PALETTE.items():
        name = "plain" if state is None else state.value
        members = [f"n{one.node.index}" for one in nodes if one.state is state]
        if members:
            style = f"fill:{tint.fill},stroke:{tint.line},color:{tint.text}"
            lines += [f"    classDef {name} {style}", f"    class {','.join(members)} {name}"]
    abstract = [f"n{one.node.index}" for one in nodes if not one.node.concrete]
    if abstract:
        lines.append("    classDef abstract stroke-dasharray:5 4")
        lines.append(f"    class {','.join(abstract)} abstract")
    return "\n".join(lines) + "\n"


def _oval(one: Drawn) -> str:
    rows = [one.word] if one.word else []
    if one.node.parent < 0:  # it has no edge that could say it
        rows += one.notes
    word = "".join(f"<br/>{_escaped(row)}" for row in rows)
    return f'n{one.node.index}(["{_escaped(one.label)}{word}"])'


def _escaped(text: str) -> str:
    """A text in which nothing has a meaning to Mermaid."""
    for sign, name in (("#", "35"), ("&", "amp"), ("<", "lt"), (">", "gt"), ('"', "quot")):
        text = text.replace(sign, f"\0{name};")
    return text.replace("\0", "#").replace("\n", " ")
