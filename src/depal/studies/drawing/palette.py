"""The colours of every figure: grey ink, brown cases, saturated only where it means something."""

from matplotlib.colors import LinearSegmentedColormap, to_rgb

Colour = tuple[float, float, float]
"""Red, green and blue in [0, 1]."""

PAPER: Colour = to_rgb("#ffffff")
INK: Colour = to_rgb("#24292e")
GREY: Colour = to_rgb("#59616a")
LINE: Colour = to_rgb("#aeb5bc")
HAIR: Colour = to_rgb("#e3e6e9")

CASES: tuple[Colour, ...] = tuple(map(to_rgb, ("#dcbd94", "#d3b083", "#e3c8a3", "#caa576")))
"""Cardboard in four tints, so that neighbours can be told apart."""

CASE_FAR: Colour = to_rgb("#efe2cd")
CASE_EDGE: Colour = to_rgb("#80603c")
WOOD: Colour = to_rgb("#b9ab98")

ASKED: Colour = to_rgb("#178a4a")
"""The requested box."""

IN_THE_WAY: Colour = to_rgb("#a6d8b4")
"""What blocks the requested box."""

CHANGED: Colour = to_rgb("#c9252b")
"""What a request has changed."""

OURS: Colour = to_rgb("#1c68ad")
"""What was measured here, beside the paper's grey."""

URGENCY = LinearSegmentedColormap.from_list(
    "urgency", ["#2c5aa8", "#6fa6d0", "#cfe3dd", "#f7e7a1", "#f3ac5c", "#dc5a3c", "#b21f2c"]
)
"""Blue where there is time, yellow between, red where a box goes first (Fig. 4)."""


def blend(colour: Colour, other: Colour, share: float) -> Colour:
    """A colour that has gone the given share, in [0, 1], of the way to another."""
    red, green, blue = (a + (b - a) * share for a, b in zip(colour, other, strict=True))
    return red, green, blue


def darker(colour: Colour, share: float) -> Colour:
    """A colour that has gone the given share, in [0, 1], of the way to black."""
    return blend(colour, (0.0, 0.0, 0.0), share)
