"""Rectangles between lines: from corners to corners, and from corners by the note's sizes."""

from collections.abc import Sequence
from dataclasses import dataclass

import cv2
import numpy as np
import numpy.typing as npt

from depal.perception.proposals import kernels, parts, surfaces
from depal.perception.rasters import Taken
from depal.perception.seams import Seams

Floats = npt.NDArray[np.float64]
Ints = npt.NDArray[np.int64]
Narrow = npt.NDArray[np.float32]

RUN = 0.050
"""A corner's two edges are looked at over so much of their length [m]."""

LEAST = 0.15
"""Mean evidence along an edge below which there is no corner."""

MOST = 400
"""So many corners of each kind are followed up at the most."""

SMALLEST, LARGEST = 0.06, 0.72
"""Edges of a face [m]."""

ROOM = 60_000
"""So many rectangles between corners are looked at at the most."""

SNAP = 0.016
"""The far sides of a rectangle of known size are looked for so far around [m]."""

NEAR = 0.006
"""Every side moves to the strongest edge so near [m]."""

PART = 0.022
"""A part of a rectangle is as large as an expected face where its edges differ by no more [m]."""

TINY = 8
"""Narrower rectangles are none [pixel]."""

WIDEST = 1 << 14
"""No raster has so many pixels along an edge."""

KEPT = 3_500
"""So many rectangles of one direction go on to the score at the most."""

DENSE, FEWEST = 10_000, 1_000
"""And so many for each square metre in which faces are looked for, but so many in any case."""


@dataclass(frozen=True, slots=True, eq=False)
class Rectangles:
    """Rectangles in a turned raster with what was measured of each.

    Attributes:
        seams: the turned raster.
        pixels: (n, 4) left, top, right, bottom.
        features: (n, FEATURES) as `measured` says.
    """

    seams: Seams
    pixels: Ints
    features: Floats


def between_lines(
    seams: Seams, sizes: Sequence[tuple[float, float]], taken: Taken | None = None
) -> Rectangles:
    """Rectangles that edges in one direction suggest.

    Args:
        seams: the evidence of edges.
        sizes: widths and heights of faces that are expected [m]; none where nothing is.
        taken: what of the raster, before it was turned, belongs to known faces.
    """
    rows, columns = running(seams)
    here = None if taken is None else taken.turned(seams.raster_from_turned, seams.level.shape)
    found = _corners(seams, rows, columns)
    candidates = [_left(_by_pairs(seams, found), here)]
    pixels = _left(_by_sizes(seams, found, sizes), here)
    kernels.snapped(rows, columns, round(SNAP / seams.step), 1, pixels)
    candidates += [pixels]
    pixels = _different(np.concatenate(candidates))
    kernels.snapped(rows, columns, max(round(NEAR / seams.step), 1), 1, pixels)
    wide, high = (pixels[:, 2:] - pixels[:, :2]).T
    pixels = _different(pixels[(wide > TINY) & (high > TINY)])
    value = _rough(pixels, rows, columns)
    kept = round(np.clip(DENSE * _open(seams, here), FEWEST, KEPT))
    pixels = pixels[np.argsort(-value, kind="stable")[:kept]]
    return Rectangles(seams, pixels, measured(seams, pixels, (rows, columns), sizes))


def _open(seams: Seams, taken: Taken | None) -> float:
    """In how much of a raster faces are looked for [m^2]."""
    known = np.isfinite(seams.depth)
    free = known if taken is None else known & ~taken.places
    return float(np.count_nonzero(free)) * seams.step**2


def running(seams: Seams) -> tuple[Floats, Floats]:
    """Running sums along rows (h, w + 1), and along columns (w, h + 1)."""
    return _sums(seams.level), _sums(seams.upright.T)


def measured(
    seams: Seams, pixels: Ints, sums: tuple[Floats, Floats], sizes: Sequence[tuple[float, float]]
) -> Floats:
    """(n, FEATURES) of rectangles (n, 4) in pixels.

    Args:
        seams: the evidence of edges.
        pixels: (n, 4) left, top, right, bottom.
        sums: of the evidence, as `running` makes them.
        sizes: widths and heights of faces that are expected [m]; none where nothing is.
    """
    features = np.zeros((len(pixels), kernels.FEATURES))
    known = np.array(sizes, dtype=float).reshape(-1, 2) / seams.step
    kernels.sides(*sums, pixels, features)
    kernels.insides(*sums, pixels, features)
    surfaces.surfaces(seams.depth, seams.step, pixels, features)
    surfaces.covers(seams.depth, seams.step, pixels, features)
    parts.seams_between(*sums, pixels, known, PART / seams.step, features)
    return features


def _different(pixels: Ints) -> Ints:
    """Each rectangle once, in order."""
    powers = WIDEST ** np.arange(3, -1, -1)
    keys = np.sort(pixels @ powers)
    first = np.ones(len(keys), dtype=bool)
    np.not_equal(keys[1:], keys[:-1], out=first[1:])
    keys = keys[first]
    return np.asarray(keys[:, None] // powers % WIDEST)


def _sums(values: Narrow) -> Floats:
    sums = np.zeros((values.shape[0], values.shape[1] + 1))
    np.cumsum(values, axis=1, out=sums[:, 1:])
    return sums


def _corners(seams: Seams, rows: Floats, columns: Floats) -> list[Ints]:
    """(k, 2) x, y of corners of each kind: upper left, upper right, lower right, lower left."""
    maps = np.zeros((4, *seams.level.shape), dtype=np.float32)
    kernels.corners(rows, columns, round(RUN / seams.step), LEAST, maps)
    found = []
    for each in maps:
        peak = (each > 0) & (each >= cv2.dilate(each, np.ones((5, 5), dtype=np.uint8)) - 1e-6)
        y, x = np.nonzero(peak)
        order = np.argsort(-each[y, x], kind="stable")[:MOST]
        found.append(np.column_stack((x[order], y[order])).astype(np.int64))
    return found


def _by_pairs(seams: Seams, found: list[Ints]) -> Ints:
    lower = np.full(2, round(SMALLEST / seams.step))
    upper = np.full(2, round(LARGEST / seams.step))
    out = np.zeros((ROOM, 4), dtype=np.int64)
    count = kernels.pairs(found[0], found[2], lower, upper, out, 0)
    first = out[:count].copy()
    count = kernels.pairs(found[1], found[3], lower, upper, out, 1)
    return np.concatenate((first, out[:count]))


def _left(pixels: Ints, taken: Taken | None) -> Ints:
    """The rectangles that known faces leave."""
    return pixels if taken is None else pixels[taken.leaves(pixels)]


def _by_sizes(seams: Seams, found: list[Ints], sizes: Sequence[tuple[float, float]]) -> Ints:
    """From every corner a rectangle of every size."""
    height, width = seams.level.shape
    made = [np.zeros((0, 4), dtype=np.int64)]
    for wide, high in sizes:
        w, h = round(wide / seams.step), round(high / seams.step)
        for corner, (dx, dy) in zip(found, ((0, 0), (w, 0), (w, h), (0, h)), strict=True):
            x, y = corner[:, 0] - dx, corner[:, 1] - dy
            made.append(np.column_stack((x, y, x + w, y + h)))
    pixels = np.concatenate(made)
    inside = (pixels[:, :2] >= 0).all(axis=1)
    inside &= (pixels[:, 2] < width) & (pixels[:, 3] < height)
    return np.asarray(pixels[inside])


def _rough(pixels: Ints, rows: Floats, columns: Floats) -> Floats:
    """A first score: all four sides, the weakest most."""
    scores = np.zeros(len(pixels))
    kernels.rough(rows, columns, pixels, scores)
    return scores
