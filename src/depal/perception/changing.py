"""Where a pile looks other than at the look before."""

import cv2
import numpy as np
import numpy.typing as npt

from depal.perception.faces import Raster

Flags = npt.NDArray[np.bool_]
Bytes = npt.NDArray[np.uint8]
Narrow = npt.NDArray[np.float32]

MOVED = 0.022
"""A surface whose depth differs by more has moved or is another one [m]."""

PALER = 0.22
"""A surface whose brightness or colour, smoothed, differs by this share looks other than before."""

SMOOTH = 0.010
"""Colours are compared over so much of a surface, a Gauss curve's width [m]."""

SPECK = 0.018
"""Changes that are narrower are noise [m]."""


def changed(before: Raster, now: Raster) -> Flags:
    """The places of a raster that another picture shows otherwise.

    Args:
        before: of the look before.
        now: of this look, in the same direction, with the same step.

    Returns:
        (h, w) of `now`.
    """
    old, depth, known = _seen_as(before, now)
    differs = known != now.known
    with np.errstate(invalid="ignore"):
        differs |= np.abs(depth - now.depth) > MOVED
    both = known & now.known
    colour = np.abs(_tones(old, both, now.step) - _tones(now.colour, both, now.step))
    paler = colour > PALER
    differs |= both & (paler[..., 0] | paler[..., 1] | paler[..., 2])
    wide = max(round(SPECK / now.step) | 1, 3)
    square = np.ones((wide, wide), dtype=np.uint8)
    return np.asarray(cv2.morphologyEx(differs.astype(np.uint8), cv2.MORPH_OPEN, square) > 0)


def shift_between(before: Raster, now: Raster) -> tuple[int, int]:
    """Rows and columns from a pixel of `before` to the same place in `now`."""
    way = before.cell_from_raster.inverse @ now.cell_from_raster
    x, y, _ = way.translation
    return -round(y / now.step), -round(x / now.step)


def _seen_as(before: Raster, now: Raster) -> tuple[Bytes, Narrow, Flags]:
    """Colour, depth and knownness of `before` at the pixels of `now`; nan where nothing is."""
    height, width = now.known.shape
    colour = np.zeros((height, width, 3), dtype=np.uint8)
    depth = np.full((height, width), np.nan, dtype=np.float32)
    known = np.zeros((height, width), dtype=np.bool_)
    shifts = shift_between(before, now)
    pairs = [
        (slice(max(-by, 0), min(old, new - by)), slice(max(by, 0), min(new, old + by)))
        for by, old, new in zip(shifts, before.known.shape, now.known.shape, strict=True)
    ]
    there, here = tuple(pair[0] for pair in pairs), tuple(pair[1] for pair in pairs)
    if all(part.start < part.stop for part in here):
        known[here] = before.known[there]
        depth[here] = np.where(before.known[there], before.depth[there], np.nan)
        colour[here] = before.colour[there]
    return colour, depth, known


def _tones(colour: Bytes, known: Flags, step: float) -> Narrow:
    """(h, w, 3) logarithms of smoothed colours, of what is known."""
    weight = known.astype(np.float32)
    wide = SMOOTH / step
    share = np.maximum(cv2.GaussianBlur(weight, (0, 0), wide), 1e-3)
    kept = colour.astype(np.float32) * weight[..., None]
    mean = np.asarray(cv2.GaussianBlur(kept, (0, 0), wide)) / share[..., None]
    return np.log(mean + 8.0).astype(np.float32)
