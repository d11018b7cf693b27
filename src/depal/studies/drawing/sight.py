"""How much of a cuboid the viewer sees past the others."""

import numpy as np
import numpy.typing as npt

from depal.studies.drawing.view import Array

LINES = 12
"""Points across each side that is looked at."""


def seen_share(index: int, lower: npt.ArrayLike, upper: npt.ArrayLike, towards: Array) -> float:
    """The share of a cuboid's outline that no other one hides.

    Args:
        index: which cuboid.
        lower: corners with the smallest coordinates, (n, 3) [m].
        upper: corners with the greatest coordinates, (n, 3) [m].
        towards: from the scene to the viewer, (3,), no component zero.

    Returns:
        From 0 (hidden) to 1 (nothing before it).
    """
    low, high = np.asarray(lower, dtype=float), np.asarray(upper, dtype=float)
    points, areas = _facing(low[index], high[index], towards)
    others = np.delete(np.arange(len(low)), index)
    # The steps along a ray from each point after which it enters and leaves each other cuboid.
    ends = np.stack((low[others], high[others]))[:, None] - points[None, :, None]
    steps = np.sort(ends / towards, axis=0)
    enter, leave = steps[0].max(axis=-1), steps[1].min(axis=-1)
    free = ~(np.maximum(enter, 0.0) < leave - 1e-9).any(axis=1)
    return float(areas[free].sum() / areas.sum())


def _facing(low: Array, high: Array, towards: Array) -> tuple[Array, Array]:
    """Points on the three sides that face the viewer, (m, 3), and their shares of the picture."""
    share = (np.arange(LINES) + 0.5) / LINES
    first, second = (grid.ravel() for grid in np.meshgrid(share, share))
    points, areas = [], []
    for axis in range(3):
        shares = np.insert(np.stack((first, second)), axis, float(towards[axis] > 0), axis=0).T
        points.append(low + shares * (high - low))
        area = float(np.prod(np.delete(high - low, axis)) * abs(towards[axis]))
        areas.append(np.full(len(shares), area))
    return np.concatenate(points), np.concatenate(areas)
