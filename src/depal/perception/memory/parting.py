"""Boxes share no space: of two that seem to, the one that less speaks for is not believed."""

from collections.abc import Sequence

import numpy as np
import numpy.typing as npt

from depal.geometry import OrientedBox, footprint_overlap, prisms_of
from depal.perception.memory.remembered import Remembered

Array = npt.NDArray[np.float64]

DEEP = 0.03
"""Boxes that reach into each other by no more than this stand side by side, badly measured [m]."""


def parted(boxes: Sequence[Remembered], deep: float = DEEP) -> tuple[Remembered, ...]:
    """The boxes that can stand together, best believed first come first; their order stays."""
    clash = clashes([box.seen.shape for box in boxes], deep)
    order = sorted(range(len(boxes)), key=lambda index: (-boxes[index].belief, index))
    kept: list[int] = []
    for index in order:
        if not clash[index, kept].any():
            kept.append(index)
    return tuple(boxes[index] for index in sorted(kept))


def clashes(shapes: Sequence[OrientedBox], deep: float = DEEP) -> npt.NDArray[np.bool_]:
    """Which boxes cannot stand together: they share more than a depth in every direction.

    Returns:
        (n, n), symmetric.
    """
    n = len(shapes)
    out = np.zeros((n, n), dtype=bool)
    prisms = prisms_of(shapes)
    for a in range(n):
        for b in range(a):
            tall = prisms[a, 5] + prisms[b, 5] - abs(prisms[a, 2] - prisms[b, 2])
            if tall > deep and footprint_overlap(prisms, a, b) > deep:
                out[a, b] = out[b, a] = True
    return out
