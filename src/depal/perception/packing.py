"""Which of many rectangles are faces: the set without overlap that is most likely as a whole."""

from collections.abc import Sequence

import numpy as np
import numpy.typing as npt
from scipy.optimize import Bounds, LinearConstraint, milp
from scipy.sparse import csr_array

from depal.perception.faces import Raster, Rectangle

Floats = npt.NDArray[np.float64]
Flags = npt.NDArray[np.bool_]

OVERLAP = 0.014
"""Rectangles may reach so far into each other [m]."""

GRID = 0.015
"""Overlap is looked for at points so far apart [m]."""

HIDES = 0.03
"""What is seen so far before a rectangle hides it there [m]."""

NODES = 200
"""The search visits so many nodes at the most; nearly always the first is the solution."""


def packed(
    rectangles: Sequence[Rectangle], values: Floats, raster: Raster | None = None
) -> list[int]:
    """The indices of the rectangles that together have the greatest value.

    Args:
        rectangles: in the plane of one raster.
        values: (n,) of each: the logarithm of its odds of being a face.
        raster: what is seen: where something nearer hides a rectangle it may be overlapped.

    Returns:
        Indices, increasing; no two of them overlap.
    """
    useful = np.flatnonzero(values > 0.0)
    if not useful.size:
        return []
    inside = _inside([rectangles[index] for index in useful.tolist()], raster)
    shared = np.unique(inside[inside.sum(axis=1) > 1], axis=0)
    if not len(shared):
        return [int(index) for index in useful]
    result = milp(
        -values[useful],
        integrality=np.ones(len(useful), dtype=np.int64),
        bounds=Bounds(0.0, 1.0),
        constraints=LinearConstraint(csr_array(shared.astype(float)), -np.inf, 1.0),
        options={"node_limit": NODES},
    )
    if result.x is None:
        return _greedy(shared, values[useful], useful)
    return [int(index) for index in useful[result.x > 0.5]]  # noqa: PLR2004


def _inside(rectangles: Sequence[Rectangle], raster: Raster | None) -> Flags:
    """(points, n): which points of a grid lie inside which rectangles, made a little smaller."""
    middles = np.array([(each.u, each.v) for each in rectangles])
    halves = np.array([(each.width, each.height) for each in rectangles]) / 2 - OVERLAP / 2
    halves = np.maximum(halves, GRID)
    turns = np.array([each.turn for each in rectangles])
    reach = np.hypot(halves[:, 0], halves[:, 1]).max()
    lower, upper = middles.min(axis=0) - reach, middles.max(axis=0) + reach
    u, v = (np.arange(a, b, GRID) for a, b in zip(lower, upper, strict=True))
    points = np.stack(np.meshgrid(u, v), axis=-1).reshape(-1, 1, 2)
    away = points - middles
    c, s = np.cos(turns), np.sin(turns)
    along = np.abs(away[..., 0] * c + away[..., 1] * s)
    across = np.abs(away[..., 1] * c - away[..., 0] * s)
    inside = (along < halves[:, 0]) & (across < halves[:, 1])
    if raster is None:
        return np.asarray(inside)
    height, width = raster.depth.shape
    rows = np.clip(np.round(points[:, 0, 1] / raster.step).astype(int), 0, height - 1)
    columns = np.clip(np.round(points[:, 0, 0] / raster.step).astype(int), 0, width - 1)
    before = np.array([each.depth for each in rectangles]) - raster.depth[rows, columns][:, None]
    with np.errstate(invalid="ignore"):
        return np.asarray(inside & ~(before > HIDES))


def _greedy(shared: Flags, values: Floats, useful: npt.NDArray[np.intp]) -> list[int]:
    """The best one first, then the best that goes with it, and so on."""
    free = np.ones(len(useful), dtype=bool)
    kept = []
    for index in np.argsort(-values, kind="stable"):
        if free[index]:
            kept.append(int(useful[index]))
            free[shared[shared[:, index]].any(axis=0)] = False
    return sorted(kept)
