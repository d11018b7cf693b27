"""The directions in which the edges of faces run."""

import cv2
import numpy as np
import numpy.typing as npt

from depal.perception.faces import Raster

Floats = npt.NDArray[np.float64]

BIN = 0.5
"""Directions are counted in bins of so many degrees."""

APART = 1.9
"""Directions that are searched differ by at least so much [degree]."""

ENOUGH = 0.3
"""A direction with this share of the strongest one's edges is searched too."""

SMOOTH = 0.0045
"""Brightness is smoothed over so much of a surface, a Gauss curve's width [m]."""


def directions_of(raster: Raster, most: int) -> tuple[float, ...]:
    """Turns of the rows of faces against those of the raster.

    Faces have right angles, so a direction stands for four; it is told in (-45, 45] degrees.

    Args:
        raster: what is seen.
        most: so many directions at the most.

    Returns:
        Clockwise turns [rad], the commonest first; 0 alone where nothing is seen.
    """
    grey = np.asarray(cv2.cvtColor(raster.colour, cv2.COLOR_RGB2GRAY), dtype=np.float32)
    grey = np.log(grey + 8.0)
    wide = max(SMOOTH / raster.step, 0.8)
    grey = cv2.GaussianBlur(grey, (0, 0), wide)
    gx, gy = cv2.Scharr(grey, -1, 1, 0), cv2.Scharr(grey, -1, 0, 1)
    inside = cv2.erode(raster.known.astype(np.uint8), np.ones((5, 5), dtype=np.uint8)) > 0
    strength = np.where(inside, np.hypot(gx, gy), 0.0)
    if not inside.any() or strength.max() <= 0.0:
        return (0.0,)
    limit = np.percentile(strength[inside], 75)
    chosen = strength > limit
    angle = np.degrees(np.arctan2(gy[chosen], gx[chosen])) % 90.0
    bins = round(90.0 / BIN)
    weight = np.minimum(strength[chosen], limit * 4)
    counts, _ = np.histogram(angle, bins=bins, range=(0.0, 90.0), weights=weight)
    return tuple(np.radians(each) for each in _peaks(_smoothed(counts), most))


def _smoothed(counts: Floats) -> Floats:
    kernel = np.array([0.1, 0.2, 0.4, 0.2, 0.1])
    ring = np.concatenate((counts[-2:], counts, counts[:2]))
    smooth = np.convolve(ring, kernel, mode="valid")
    return np.asarray(np.maximum(smooth - np.median(smooth), 0.0))


def _peaks(counts: Floats, most: int) -> list[float]:
    """The strongest bins, each apart from those before it [degree]."""
    found: list[float] = []
    for index in np.argsort(-counts, kind="stable"):
        if counts[index] < ENOUGH * counts.max() or len(found) == most:
            break
        angle = (float(index) + 0.5) * BIN
        if all(abs((angle - other + 45.0) % 90.0 - 45.0) >= APART for other in found):
            found.append(angle)
    return [(angle + 45.0) % 90.0 - 45.0 for angle in found] or [0.0]
