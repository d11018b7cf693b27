"""Which of many rectangles are faces: the set without overlap that is most likely as a whole."""

import math
from collections.abc import Sequence

import numpy as np
import numpy.typing as npt
from scipy.optimize import Bounds, LinearConstraint, milp
from scipy.sparse import csr_array

from depal.geometry import loop_kernel
from depal.perception.faces import Raster, Rectangle
from depal.perception.rasters.taken import DEEP, RIM

Floats = npt.NDArray[np.float64]
Flags = npt.NDArray[np.bool_]

OVERLAP = 2 * RIM
"""Rectangles may reach so far into each other [m]."""

GRID = 0.015
"""Overlap is looked for at points so far apart [m]."""

HIDES = DEEP
"""What is seen so far before a rectangle hides it there [m]."""

NODES = 200
"""The search visits so many nodes at the most; nearly always the first is the solution."""


def packed(
    rectangles: Sequence[Rectangle],
    values: Floats,
    raster: Raster | None = None,
    sure: Flags | None = None,
) -> list[int]:
    """The indices of the rectangles that together have the greatest value.

    Args:
        rectangles: in the plane of one raster.
        values: (n,) of each: the logarithm of its odds of being a face.
        raster: what is seen: where something nearer hides a rectangle it may be overlapped.
        sure: (n,) which go on behind nearer ones where nothing was measured; none if not given.

    Returns:
        Indices, increasing; no two of them overlap.
    """
    useful = np.flatnonzero(values > 0.0)
    if not useful.size:
        return []
    some = [rectangles[index] for index in useful.tolist()]
    goes_on = np.zeros(len(some), dtype=np.bool_) if sure is None else sure[useful]
    shared = _shared(some, raster, goes_on)
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


def _shared(rectangles: Sequence[Rectangle], raster: Raster | None, sure: Flags) -> Flags:
    """(rows, n): in each row rectangles of which one may be chosen at the most.

    Args:
        rectangles: n.
        raster: what is seen.
        sure: (n,) which may go on behind nearer ones where nothing was measured: in the shadow
            of a box, say.
    """
    inside, unknown = _inside(rectangles, raster)
    several = inside.sum(axis=1) > 1
    rows = _different(inside[several & ~unknown])
    dark = _different(inside[several & unknown])
    if not len(dark):
        return rows
    depths = np.array([each.depth for each in rectangles])
    behind = depths[None, :] - depths[:, None]
    # Each one with what it excludes of the others behind it: these exclude one another, too.
    excluded = (behind >= 0.0) & ((behind <= HIDES) | ~sure[None, :])
    of_one = np.concatenate([row & excluded[row] for row in dark])
    return _different(np.concatenate((rows, of_one[of_one.sum(axis=1) > 1])))


def _inside(rectangles: Sequence[Rectangle], raster: Raster | None) -> tuple[Flags, Flags]:
    """Which points of a grid lie inside which rectangles, made a little smaller.

    Returns:
        (points, n) that, and (points,) whether nothing was measured at a point.
    """
    middles = np.array([(each.u, each.v) for each in rectangles])
    halves = np.array([(each.width, each.height) for each in rectangles]) / 2 - OVERLAP / 2
    halves = np.maximum(halves, GRID)
    turns = np.array([each.turn for each in rectangles])
    reach = np.hypot(halves[:, 0], halves[:, 1]).max()
    lower, upper = middles.min(axis=0) - reach, middles.max(axis=0) + reach
    u, v = (np.arange(a, b, GRID) for a, b in zip(lower, upper, strict=True))
    inside = np.zeros((len(v), len(u), len(rectangles)), dtype=np.bool_)
    _cover(u, v, middles, halves, np.column_stack((np.cos(turns), np.sin(turns))), inside)
    unknown = np.zeros(inside.shape[:2], dtype=np.bool_)
    if raster is not None:
        height, width = raster.depth.shape
        rows = np.clip(np.round(v / raster.step).astype(int), 0, height - 1)
        columns = np.clip(np.round(u / raster.step).astype(int), 0, width - 1)
        depths = np.array([each.depth for each in rectangles])
        shown = raster.depth[np.ix_(rows, columns)]
        unknown = ~np.isfinite(shown)
        with np.errstate(invalid="ignore"):
            inside &= ~(depths - shown[..., None] > HIDES)
    return inside.reshape(-1, len(rectangles)), unknown.reshape(-1)


@loop_kernel
def _cover(
    u: Floats, v: Floats, middles: Floats, halves: Floats, turns: Floats, inside: Flags
) -> None:
    """Marks the points of a grid that lie inside rectangles.

    Args:
        u: (w,) of the grid's columns [m].
        v: (h,) of its rows [m].
        middles: (n, 2) of the rectangles [m].
        halves: (n, 2) half their width and height [m].
        turns: (n, 2) cosine and sine of their turns.
        inside: (h, w, n) false at first; updated.
    """
    for n in range(middles.shape[0]):
        c, s = turns[n, 0], turns[n, 1]
        reach = math.hypot(halves[n, 0], halves[n, 1])
        for i in range(v.shape[0]):
            y = v[i] - middles[n, 1]
            if abs(y) > reach:
                continue
            for j in range(u.shape[0]):
                x = u[j] - middles[n, 0]
                if abs(x * c + y * s) < halves[n, 0] and abs(y * c - x * s) < halves[n, 1]:
                    inside[i, j, n] = True


def _different(rows: Flags) -> Flags:
    """Each row once, in order."""
    bits = np.packbits(rows, axis=1)
    every = b"".join(sorted({row.tobytes() for row in bits}))
    once = np.frombuffer(every, dtype=np.uint8).reshape(-1, bits.shape[1])
    return np.unpackbits(once, axis=1, count=rows.shape[1]).astype(np.bool_)


def _greedy(shared: Flags, values: Floats, useful: npt.NDArray[np.intp]) -> list[int]:
    """The best one first, then the best that goes with it, and so on."""
    free = np.ones(len(useful), dtype=bool)
    kept = []
    for index in np.argsort(-values, kind="stable"):
        if free[index]:
            kept.append(int(useful[index]))
            free[shared[shared[:, index]].any(axis=0)] = False
    return sorted(kept)
