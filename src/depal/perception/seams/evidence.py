"""How much every place looks like the edge of a face, for edges that run one way."""

from collections.abc import Sequence
from dataclasses import dataclass

import cv2
import numpy as np
import numpy.typing as npt

from depal.perception.faces import Raster

Narrow = npt.NDArray[np.float32]
Flags = npt.NDArray[np.bool_]

ALONG = 0.040
"""Evidence of an edge is averaged over so much of its length [m]."""

HALF = 0.35
"""An edge as strong as this many times the usual noise of its picture counts half."""

STEP = 0.012
"""Depths on both sides of an edge that differ by this much count half [m]."""

ACROSS = 0.010
"""Depths are compared so far on either side of an edge [m]."""

BEYOND = 0.015
"""Edges are looked for so far beyond what is known [m]."""

SLACK = 0.004
"""An edge may be so far from where it is looked for [m]."""


@dataclass(frozen=True, slots=True, eq=False)
class Seams:
    """Evidence in a raster that was turned so that edges run along rows and columns.

    Attributes:
        turn: clockwise, of the rows against the raster's [rad].
        step: of a pixel [m].
        raster_from_turned: (2, 3) from turned pixels to the raster's pixels.
        upright: (h, w) of edges along columns, in [0, 1].
        level: (h, w) of edges along rows, in [0, 1].
        known: (h, w) what a camera saw.
        depth: (h, w) [m]; nan where unknown.
    """

    turn: float
    step: float
    raster_from_turned: npt.NDArray[np.float64]
    upright: Narrow
    level: Narrow
    known: Flags
    depth: Narrow


def seams_of(raster: Raster, turn: float) -> Seams:
    """Evidence of edges in one direction and square to it.

    Args:
        raster: what is seen.
        turn: clockwise, of the rows of faces against those of the raster [rad].
    """
    return seams_along(raster, (turn,))[0]


def seams_along(raster: Raster, turns: Sequence[float]) -> tuple[Seams, ...]:
    """Evidence of edges in several directions.

    Args:
        raster: what is seen.
        turns: clockwise, of the rows of faces against those of the raster [rad].
    """
    channels = _channels(raster)
    return tuple(_seams(raster, channels, turn) for turn in turns)


def _seams(raster: Raster, channels: Narrow, turn: float) -> Seams:
    height, width = raster.known.shape
    c, s = abs(np.cos(turn)), abs(np.sin(turn))
    size = (int(np.ceil(width * c + height * s)), int(np.ceil(width * s + height * c)))
    back = _raster_from_turned(turn, (width, height), size)
    depth = np.where(np.isfinite(raster.depth), raster.depth, 0.0).astype(np.float32)
    if turn == 0.0:
        known, turned, deep = raster.known, channels, raster.depth
    else:
        turned = np.dstack([_turned(each, back, size) for each in np.moveaxis(channels, 2, 0)])
        known = _turned(raster.known.astype(np.uint8), back, size, cv2.INTER_NEAREST) > 0
        deep = _turned(depth, back, size, cv2.INTER_NEAREST)
    deep = np.where(known, deep, np.nan).astype(np.float32)
    along = max(round(ALONG / raster.step), 3)
    upright = _evidence(turned, known, deep, along, raster.step)
    swapped = np.ascontiguousarray(np.moveaxis(turned, 0, 1))
    level = _evidence(swapped, known.T, deep.T, along, raster.step).T
    return Seams(turn, raster.step, back, upright, np.ascontiguousarray(level), known, deep)


def _raster_from_turned(
    turn: float, old: tuple[int, int], new: tuple[int, int]
) -> npt.NDArray[np.float64]:
    c, s = np.cos(turn), np.sin(turn)
    rotation = np.array([[c, -s], [s, c]])
    middle_old = (np.array(old) - 1) / 2
    middle_new = (np.array(new) - 1) / 2
    return np.column_stack((rotation, middle_old - rotation @ middle_new))


def _turned(
    image: npt.NDArray[np.float32] | npt.NDArray[np.uint8],
    back: npt.NDArray[np.float64],
    size: tuple[int, int],
    how: int = cv2.INTER_LINEAR,
) -> Narrow:
    return np.asarray(
        cv2.warpAffine(image, back, size, flags=how | cv2.WARP_INVERSE_MAP), dtype=np.float32
    )


def _channels(raster: Raster) -> Narrow:
    """(h, w, 3) log brightness and two log ratios of colours, unknown places as their nearest."""
    logs = np.log(raster.colour.astype(np.float32) + 6.0)
    coloured = raster.colour.any(axis=2)
    unknown = np.asarray(~coloured, dtype=np.uint8)
    if coloured.any():
        _, labels = cv2.distanceTransformWithLabels(
            unknown, cv2.DIST_L2, 3, labelType=cv2.DIST_LABEL_PIXEL
        )
        first = np.zeros(int(labels.max()) + 1, dtype=np.int64)
        rows = np.flatnonzero(coloured.ravel())
        first[labels.ravel()[rows]] = rows
        logs = logs.reshape(-1, 3)[first[labels]]
    r, g, b = np.moveaxis(logs, 2, 0)
    return np.dstack(((r + g + b) / 3, (r - g) * 0.7, (b - g) * 0.7)).astype(np.float32)


def _evidence(channels: Narrow, known: Flags, depth: Narrow, along: int, step: float) -> Narrow:
    """Of edges along columns."""
    soft = cv2.GaussianBlur(channels, (0, 0), 0.8)
    best = np.zeros(known.shape, dtype=np.float32)
    for channel in np.moveaxis(soft, 2, 0):
        edge = np.zeros_like(channel)
        edge[:, 1:-1] = (channel[:, 2:] - channel[:, :-2]) / 2
        line = np.zeros_like(channel)
        line[:, 2:-2] = channel[:, 2:-2] - (channel[:, 4:] + channel[:, :-4]) / 2
        for response in (edge, line * 0.7):
            run = np.abs(cv2.boxFilter(response, -1, (1, along)))
            best = np.maximum(best, run)
    usual = float(np.median(best[known])) if known.any() else 1.0
    seen = best / (best + max(usual, 2e-3) * 1.5)
    edges = np.maximum(seen, _steps(depth, along, step))
    reach = 2 * round(BEYOND / step) + 1
    near = cv2.dilate(known.astype(np.uint8), np.ones((reach, reach), dtype=np.uint8)) > 0
    edges = np.where(near, edges, 0.0).astype(np.float32)
    slack = max(round(SLACK / step), 1)
    return np.asarray(cv2.dilate(edges, np.ones((1, 2 * slack + 1), dtype=np.uint8)))


def _steps(depth: Narrow, along: int, step: float) -> Narrow:
    """Of steps in depth along columns; where one side is unknown it counts as a step."""
    across = max(round(ACROSS / step), 2)
    far = np.where(np.isfinite(depth), depth, 9.0).astype(np.float32)
    rise = np.zeros_like(far)
    rise[:, across:-across] = far[:, 2 * across :] - far[:, : -2 * across]
    rise = np.clip(rise, -0.2, 0.2)
    run = np.abs(cv2.boxFilter(rise, -1, (1, along)))
    share = run * run / (run * run + STEP * STEP)
    return np.asarray(share, dtype=np.float32)
