"""How a camera's depths are scaled, from what they say of planes whose places are known."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from depal.perception.calibration.planes import PlaneDepth

Floats = npt.NDArray[np.float64]

SURE = 4.0
"""An offset is believed when it is so many times its own error."""

SPREAD = 1.4
"""An offset can be told from a scale where the farthest plane is so many times the nearest."""

BESIDE = 3.0
"""Depths may belong to pixels so far beside them, all alike, which tells on slanted planes [pixel].

Stereo finds a depth for a window, and what in it is nearer decides more.
"""

TRUSTED = 1.5
"""A plane that is off by more of its own errors counts less."""

ROUNDS = 20


@dataclass(frozen=True, slots=True)
class DepthScale:
    """How true depths follow from measured ones: `scale * measured + offset`.

    Attributes:
        scale: the factor; 1 where nothing was measured.
        offset: what is added [m].
        error: standard deviation of a depth in the middle of the planes, by that depth.
        planes: how many it was found from.
    """

    scale: float = 1.0
    offset: float = 0.0
    error: float = float("inf")
    planes: int = 0

    def applied(self, depth: npt.NDArray[np.float32]) -> npt.NDArray[np.float32]:
        """True depths of measured ones; 0 stays 0, which says that nothing was measured."""
        true = np.float32(self.scale) * depth + np.float32(self.offset)
        return np.where(depth > 0.0, true, np.float32(0.0)).astype(np.float32)


def scale_of(planes: Sequence[PlaneDepth]) -> DepthScale:
    """The scale that fits planes best, and an offset where they tell one.

    Args:
        planes: from any number of pictures of one camera.
    """
    if not planes:
        return DepthScale()
    measured = np.array([plane.measured for plane in planes])
    true = np.array([plane.true for plane in planes])
    errors = np.array([plane.error for plane in planes])
    slants = np.array([plane.slant for plane in planes])
    best, cov = _fitted(np.column_stack((measured, slants)), true, errors)
    found = DepthScale(best[0], 0.0, float(np.sqrt(cov[0, 0])), len(planes))
    if true.max() < SPREAD * true.min():
        return found
    columns = np.column_stack((measured, np.ones_like(measured), slants))
    best, cov = _fitted(columns, true, errors)
    if abs(best[1]) < SURE * np.sqrt(cov[1, 1]):
        return found
    middle = float(np.average(measured, weights=1 / errors**2))
    at = np.array((middle, 1.0, 0.0))
    return DepthScale(best[0], best[1], float(np.sqrt(at @ cov @ at)) / middle, len(planes))


def _fitted(columns: Floats, true: Floats, errors: Floats) -> tuple[list[float], Floats]:
    """Least squares with Huber's weights; and the covariance, no smaller than the fit is bad.

    Args:
        columns: (n, m); the last is that of `BESIDE`, which is 0 as far as anybody knows.
        true: (n,) what they add up to [m].
        errors: (n,) [m].
    """
    trusted, off = np.ones_like(true), np.zeros_like(true)
    known = np.zeros((1, columns.shape[1]))
    known[0, -1] = 1.0 / BESIDE
    best = np.zeros(columns.shape[1])
    for _ in range(ROUNDS):
        weights = np.sqrt(trusted) / errors
        rows = np.vstack((columns * weights[:, None], known))
        best = np.asarray(np.linalg.lstsq(rows, np.append(true * weights, 0.0), rcond=None)[0])
        off = np.abs(true - columns @ best) / errors
        trusted = np.minimum(TRUSTED / np.maximum(off, 1e-9), 1.0)
    rows = np.vstack((columns * (np.sqrt(trusted) / errors)[:, None], known))
    spread = max(1.0, float(np.mean(trusted * off**2)))
    return best.tolist(), np.asarray(np.linalg.pinv(rows.T @ rows) * spread)
