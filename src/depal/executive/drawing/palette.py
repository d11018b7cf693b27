"""The paper's colours, muted: green enabled, blue accomplished, red disabled."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Final

from depal.executive.tree import NodeState


@dataclass(frozen=True, slots=True)
class Tint:
    """Three shades of one colour.

    Attributes:
        fill: of an oval.
        line: around it.
        text: inside it.
    """

    fill: str
    line: str
    text: str


PALETTE: Final[Mapping[NodeState | None, Tint]] = {
    None: Tint("#f6f6f4", "#77756f", "#2c2b29"),
    NodeState.ENABLED: Tint("#e2f2e6", "#3f8f5b", "#1d5533"),
    NodeState.ACCOMPLISHED: Tint("#e1ebf8", "#3d72ad", "#1d4473"),
    NodeState.DISABLED: Tint("#f9e7e4", "#b8584c", "#7c2d25"),
}

PAPER: Final = "#ffffff"
INK: Final = "#2c2b29"
EDGE: Final = "#a5a29b"
SOFT: Final = "#6d6a64"
"""Of words that explain."""
