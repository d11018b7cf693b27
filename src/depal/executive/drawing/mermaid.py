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
            label = f'|"{_escaped(_edge(one))}"|' if one.when else ""
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
    word = f"<br/>{one.word}" if one.word else ""
    return f'n{one.node.index}(["{_escaped(one.label)}{word}"])'


def _edge(one: Drawn) -> str:
    if one.met is None:
        return one.when
    return f"{'✓' if one.met else '✗'} {one.when}"


def _escaped(text: str) -> str:
    """A text in which nothing has a meaning to Mermaid."""
    for sign, name in (("#", "35"), ("&", "amp"), ("<", "lt"), (">", "gt"), ('"', "quot")):
        text = text.replace(sign, f"\0{name};")
    return text.replace("\0", "#").replace("\n", " ")
