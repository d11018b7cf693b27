"""Where everything in the picture of a tree goes.

Each subtree has a strip of its own, as wide as its widest row, so that nothing overlaps: the
ovals of one depth stand in one row, and the conditions of their edges in a band above it.
All lengths are in pixels.
"""

import math
import textwrap
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final

from depal.executive.drawing.words import Drawn

MARGIN: Final = 28.0
GAP: Final = 20.0
"""Between neighbours in a row."""

LABEL_SIZE, WORD_SIZE, NOTE_SIZE = 14.0, 11.5, 12.0
WIDE: Final = 0.61
"""The width of a character, of its size: on the safe side for most faces."""

OVAL_HEIGHT, PLAIN_OVAL_HEIGHT = 58.0, 46.0
NOTE_COLUMNS: Final = 21
"""Conditions are wrapped at so many characters."""

NOTE_LINE: Final = 16.0
NOTE_PAD: Final = 8.0
FALL: Final = 46.0
"""From an oval down to the band of conditions below it."""

STUB: Final = 20.0
"""From that band to the ovals below it, with the arrow's head."""


@dataclass(frozen=True, slots=True)
class Rect:
    """An upright rectangle.

    Attributes:
        x: of its centre.
        top: its upper side.
        width: across.
        height: down.
    """

    x: float
    top: float
    width: float
    height: float

    @property
    def left(self) -> float:
        """Its left side."""
        return self.x - self.width / 2

    @property
    def right(self) -> float:
        """Its right side."""
        return self.x + self.width / 2

    @property
    def bottom(self) -> float:
        """Its lower side."""
        return self.top + self.height


@dataclass(frozen=True, slots=True)
class Placed:
    """A node in its place.

    Attributes:
        drawn: the node and its words.
        oval: around it.
        note: around its precondition; None where it has none.
        lines: of the precondition.
        band: where the condition's band begins, to which the edge falls.
    """

    drawn: Drawn
    oval: Rect
    note: Rect | None
    lines: tuple[str, ...]
    band: float


@dataclass(frozen=True, slots=True)
class Layout:
    """A picture.

    Attributes:
        nodes: in the order of the tree.
        width: of the picture.
        height: of the tree in it, from `top`.
    """

    nodes: tuple[Placed, ...]
    width: float
    height: float


def text_width(text: str, size: float) -> float:
    """About how wide a text is."""
    return len(text) * size * WIDE


def wrapped(when: str) -> tuple[str, ...]:
    """A condition in short lines, broken where one of its parts ends if that is possible."""
    parts = when.replace(" and ", "\nand ").replace(" or ", "\nor ").split("\n")
    return tuple(line for part in parts for line in _hard(part)) if when else ()


def _hard(part: str) -> list[str]:
    if len(part) <= NOTE_COLUMNS:
        return [part]
    return textwrap.wrap(part, NOTE_COLUMNS, subsequent_indent="  ", break_long_words=False)


def layout(nodes: Sequence[Drawn], top: float) -> Layout:
    """Places every node.

    Args:
        nodes: of one tree, in its order.
        top: where the root's row begins.

    Returns:
        All rectangles; none overlaps another.
    """
    lines = [tuple(row for note in one.notes for row in wrapped(note)) for one in nodes]
    ovals = [_oval_width(one) for one in nodes]
    notes = [_note_width(rows) for rows in lines]
    strips = _strips(nodes, [max(pair) + GAP for pair in zip(ovals, notes, strict=True)])
    centres = _centres(nodes, strips)
    height = OVAL_HEIGHT if any(one.word for one in nodes) else PLAIN_OVAL_HEIGHT
    bands, rows = _rows(nodes, lines, top, height)
    placed = []
    for place, one in enumerate(nodes):
        depth = one.node.depth
        tall = _note_height(lines[place])
        note = Rect(centres[place], rows[depth] - STUB - tall, notes[place], tall) if tall else None
        oval = Rect(centres[place], rows[depth], ovals[place], height)
        placed.append(Placed(one, oval, note, lines[place], bands[depth]))
    return Layout(tuple(placed), strips[0] + 2 * MARGIN, max(rows) + height - top)


def _oval_width(one: Drawn) -> float:
    """Wide enough that the corners of both lines stay inside."""
    words = max(text_width(one.label, LABEL_SIZE), text_width(one.word, WORD_SIZE))
    return words / math.sqrt(1 - 0.5**2) + 26.0


def _note_width(lines: Sequence[str]) -> float:
    return max((text_width(line, NOTE_SIZE) for line in lines), default=0.0) + 2 * NOTE_PAD


def _note_height(lines: Sequence[str]) -> float:
    return len(lines) * NOTE_LINE + NOTE_PAD if lines else 0.0


def _strips(nodes: Sequence[Drawn], own: Sequence[float]) -> list[float]:
    """The width of each subtree."""
    strips = list(own)
    for one in reversed(nodes):
        below = sum(strips[child] for child in one.node.children)
        strips[one.node.index] = max(own[one.node.index], below)
    return strips


def _centres(nodes: Sequence[Drawn], strips: Sequence[float]) -> list[float]:
    """The middle of each node: that of its first and last child."""
    left = [MARGIN] * len(nodes)
    for one in nodes:
        below = sum(strips[child] for child in one.node.children)
        x = left[one.node.index] + (strips[one.node.index] - below) / 2
        for child in one.node.children:
            left[child] = x
            x += strips[child]
    return [left[place] + strips[place] / 2 for place in range(len(nodes))]


def _rows(
    nodes: Sequence[Drawn], lines: Sequence[Sequence[str]], top: float, height: float
) -> tuple[list[float], list[float]]:
    """The upper side of the band of conditions and of the row of ovals, of each depth."""
    bands: list[float] = []
    rows: list[float] = []
    for depth in range(max(one.node.depth for one in nodes) + 1):
        tallest = max(
            _note_height(rows_of)
            for one, rows_of in zip(nodes, lines, strict=True)
            if one.node.depth == depth
        )
        band = rows[-1] + height + FALL if rows else top
        bands.append(band)
        rows.append(band + tallest + (STUB if rows or tallest else 0.0))
    return bands, rows
