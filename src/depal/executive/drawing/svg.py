"""A tree as a picture, as in Fig. 3: dashed ovals abstract, continuous ovals concrete."""

from html import escape

from depal.executive.drawing.layout import (
    LABEL_SIZE,
    MARGIN,
    NOTE_LINE,
    NOTE_PAD,
    NOTE_SIZE,
    WORD_SIZE,
    Layout,
    Placed,
    layout,
    text_width,
)
from depal.executive.drawing.palette import EDGE, INK, PALETTE, PAPER, SOFT
from depal.executive.drawing.words import Standings, drawn, postcondition
from depal.executive.schema import Action
from depal.executive.tree import NodeState, Tree

TITLE_SIZE = 18.0
FACE = "Inter, 'Segoe UI', 'Helvetica Neue', 'DejaVu Sans', Arial, sans-serif"


def tree_svg(tree: Tree, standings: Standings = None, title: str = "") -> str:
    """Draws a tree as SVG.

    The state of a node is its colour and a word; what may run now has a bold outline. The
    preconditions stand on the edges, marked where they do not hold. Each node says in its
    tooltip what it is for.

    Args:
        tree: what is allocated, or a schema grounded in its own parameters.
        standings: of its nodes; None for none.
        title: above the picture; empty for none.

    Returns:
        A complete SVG file.
    """
    top = MARGIN + (TITLE_SIZE + 16.0 if title else 0.0)
    found = layout(drawn(tree, standings), top)
    legend = _Legend(states=standings is not None)
    width = max(found.width, legend.width + 2 * MARGIN, text_width(title, TITLE_SIZE) + 2 * MARGIN)
    shift = (width - found.width) / 2
    height = top + found.height + 34.0 + legend.height + MARGIN
    name = title or tree.root.label
    parts = [
        (
            f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width:.0f} {height:.0f}" '
            f'width="{width:.0f}" height="{height:.0f}" role="img" font-family="{FACE}" '
            f'text-anchor="middle">'
        ),
        f"<title>{_safe(name)}</title>",
        f'<rect width="100%" height="100%" fill="{PAPER}"/>',
    ]
    if title:
        parts.append(
            f'<text x="{MARGIN:.0f}" y="{MARGIN + TITLE_SIZE:.0f}" font-size="{TITLE_SIZE:g}" '
            f'font-weight="600" text-anchor="start" fill="{INK}">{_safe(title)}</text>'
        )
    parts.append(f'<g transform="translate({shift:.1f} 0)">')
    parts += _edges(found)
    parts += [part for one in found.nodes for part in (*_note(one), *_node(one))]
    parts.append("</g>")
    parts += legend.drawn(MARGIN, height - MARGIN - legend.height)
    return "\n".join([*parts, "</svg>"]) + "\n"


def _safe(text: str) -> str:
    """A text that XML takes, without signs that it has no way to write."""
    return escape("".join(sign if sign.isprintable() else " " for sign in text))


def _edges(found: Layout) -> list[str]:
    """From each oval to those below it, falling into their bands; to the root from its note."""
    parts = []
    for one in found.nodes:
        x, end = one.oval.x, one.oval.top
        if one.drawn.node.parent >= 0:
            above = found.nodes[one.drawn.node.parent].oval
            middle = (above.bottom + one.band) / 2
            start = (
                f"M{above.x:.1f} {above.bottom:.1f} C{above.x:.1f} {middle:.1f} "
                f"{x:.1f} {middle:.1f} {x:.1f} {one.band:.1f}"
            )
        elif one.note is not None:
            start = f"M{x:.1f} {one.note.bottom:.1f}"
        else:
            continue
        parts.append(
            f'<path d="{start} V{end - 7:.1f}" fill="none" stroke="{EDGE}" stroke-width="1.4"/>'
            f'<path d="M{x - 4.5:.1f} {end - 9:.1f} L{x:.1f} {end - 1:.1f} '
            f'L{x + 4.5:.1f} {end - 9:.1f} Z" fill="{EDGE}"/>'
        )
    return parts


def _note(one: Placed) -> list[str]:
    """The precondition on an edge; red where it is what disables the node."""
    if one.note is None:
        return []
    box = one.note
    lacking = one.drawn.lacking
    tint = PALETTE[NodeState.DISABLED] if lacking else PALETTE[None]
    fill = tint.fill if lacking else PAPER
    line = tint.line if lacking else EDGE
    lines = "".join(
        f'<tspan x="{box.x:.1f}" y="{box.top + NOTE_PAD / 2 + NOTE_LINE * (row + 0.76):.1f}">'
        f"{_safe(text)}</tspan>"
        for row, text in enumerate(one.lines)
    )
    return [
        (
            f'<rect x="{box.left:.1f}" y="{box.top:.1f}" width="{box.width:.1f}" '
            f'height="{box.height:.1f}" rx="7" fill="{fill}" stroke="{line}" stroke-width="0.8"/>'
        ),
        f'<text font-size="{NOTE_SIZE:g}" fill="{tint.text}">{lines}</text>',
    ]


def _node(one: Placed) -> list[str]:
    """An oval with its label, its state in a word, and what it is for as a tooltip."""
    oval, tint = one.oval, PALETTE[one.drawn.state]
    dash = "" if one.drawn.node.concrete else ' stroke-dasharray="6 4"'
    bold = "2.8" if one.drawn.ready else "1.5"
    middle = oval.top + oval.height / 2
    label = middle - 2 if one.drawn.word else middle + LABEL_SIZE * 0.35
    parts = [
        "<g>",
        f"<title>{_safe(_about(one))}</title>",
        (
            f'<ellipse cx="{oval.x:.1f}" cy="{middle:.1f}" rx="{oval.width / 2:.1f}" '
            f'ry="{oval.height / 2:.1f}" fill="{tint.fill}" stroke="{tint.line}" '
            f'stroke-width="{bold}"{dash}/>'
        ),
        (
            f'<text x="{oval.x:.1f}" y="{label:.1f}" font-size="{LABEL_SIZE:g}" '
            f'font-weight="500" fill="{tint.text}">{_safe(one.drawn.label)}</text>'
        ),
    ]
    if one.drawn.word:
        parts.append(
            f'<text x="{oval.x:.1f}" y="{middle + 15:.1f}" font-size="{WORD_SIZE:g}" '
            f'fill="{tint.text}" opacity="0.85">{_safe(one.drawn.word)}</text>'
        )
    return [*parts, "</g>"]


def _about(one: Placed) -> str:
    schema = one.drawn.node.schema
    about = f"{one.drawn.label} until {postcondition(one.drawn.node)}"
    if isinstance(schema, Action) and schema.uses:
        about += f", uses {', '.join(schema.uses)}"
    return about


class _Legend:
    """What the shapes and the colours mean."""

    height = 20.0

    def __init__(self, *, states: bool) -> None:
        """Chooses the entries."""
        self._entries: list[tuple[str, NodeState | None, str]] = [
            ("abstract", None, 'stroke-width="1.5" stroke-dasharray="5 3"'),
            ("concrete", None, 'stroke-width="1.5"'),
        ]
        if states:
            self._entries += [(s.value, s, 'stroke-width="1.5"') for s in NodeState]
            self._entries.append(("may run", NodeState.ENABLED, 'stroke-width="2.8"'))

    @property
    def width(self) -> float:
        """Of all entries."""
        return sum(self._step(word) for word, _, _ in self._entries)

    @staticmethod
    def _step(word: str) -> float:
        return 62.0 + text_width(word, NOTE_SIZE)

    def drawn(self, x: float, top: float) -> list[str]:
        """The entries in one row."""
        parts = []
        middle = top + self.height / 2
        for word, state, outline in self._entries:
            tint = PALETTE[state]
            parts.append(
                f'<ellipse cx="{x + 16:.1f}" cy="{middle:.1f}" rx="16" ry="9" '
                f'fill="{tint.fill}" stroke="{tint.line}" {outline}/>'
                f'<text x="{x + 40:.1f}" y="{middle + 4:.1f}" font-size="{NOTE_SIZE:g}" '
                f'text-anchor="start" fill="{SOFT}">{word}</text>'
            )
            x += self._step(word)
        return parts
