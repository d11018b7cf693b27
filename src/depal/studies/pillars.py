"""How much of a pile stands in pillars: the measure behind Fig. 9."""

import math

import numpy as np
import numpy.typing as npt
from scipy import ndimage

Array = npt.NDArray[np.float64]

CELL = 0.02
"""Edge of a cell of the height map [m]."""

NARROW = 0.40
"""What is narrower than this along x or y is a pillar [m]; half of the pallet's depth."""


def pillar_index(low: Array, high: Array, footprint: tuple[float, float, float, float]) -> float:
    """The share of a pile's volume that stands narrower than NARROW.

    The height map of the pile (its upper surface) is opened by a flat square of side NARROW;
    what the opening takes away is too narrow to hold such a square at its height.

    Args:
        low: (n, 3) corners with the smallest coordinates [m].
        high: (n, 3) the opposite corners [m].
        footprint: x_min, y_min, x_max, y_max of the pallet [m].

    Returns:
        The share, in [0, 1]; 0 for no boxes.
    """
    if not len(low):
        return 0.0
    x_min, y_min, x_max, y_max = footprint
    columns = math.ceil((x_max - x_min) / CELL - 0.5)
    rows = math.ceil((y_max - y_min) / CELL - 0.5)
    heights = np.zeros((columns, rows))
    start = np.rint((low[:, :2] - (x_min, y_min)) / CELL).astype(int)
    end = np.rint((high[:, :2] - (x_min, y_min)) / CELL).astype(int)
    for (i, j), (k, m), top in zip(start.tolist(), end.tolist(), high[:, 2].tolist(), strict=True):
        heights[i:k, j:m] = np.maximum(heights[i:k, j:m], top)
    side = round(NARROW / CELL)
    around = np.pad(heights, side)
    opened = ndimage.grey_opening(around, size=(side, side))
    return float((around - opened).sum() / around.sum()) if around.any() else 0.0
