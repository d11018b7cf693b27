"""Laying a print over what is seen: shift, small turn, small scale."""

import math
from dataclasses import dataclass

import cv2
import numpy as np
import numpy.typing as npt

from depal.perception.recognition.features import Features
from depal.perception.recognition.kernels import steps_of_laying

Floats = npt.NDArray[np.float64]

PRIOR = (0.008, 0.008, math.radians(2.0), 0.007)
"""How far off a face's pose may be: x, y [m], turn [rad], scale; standard deviations."""

OUTLIER = 0.35
"""Features that differ by more count less."""

NOISE = 0.15
"""Standard deviation of a feature between a picture and another box of the product."""

REACH = 0.016
"""The first search looks so far around [m]."""

STEPS = 9
"""Gauss-Newton steps at the most."""

ROUGH = 4
"""The first of them look at every second pixel of those that the others look at."""

STILL = (0.02, 2e-4)
"""Steps end when the shift [pixel] and the turn [rad] change by less."""


@dataclass(frozen=True, slots=True)
class Motion:
    """Where a print lies on what is seen.

    A point (x, y) of what is seen, from its middle, lies in the print, from its middle, at
    (1 + scale) R(turn) (x, y) + (x, y of the shift).

    Attributes:
        x: shift [m].
        y: shift [m].
        turn: clockwise [rad].
        scale: growth.
        sigma: standard deviations of x, y [m] and turn [rad], of the laying alone.
    """

    x: float = 0.0
    y: float = 0.0
    turn: float = 0.0
    scale: float = 0.0
    sigma: tuple[float, float, float] = (0.008, 0.008, 0.026)

    @property
    def middle(self) -> tuple[float, float]:
        """Where on what is seen the print's middle lies, from the middle there [m]."""
        c, s, k = math.cos(self.turn), math.sin(self.turn), 1.0 + self.scale
        return -(c * self.x + s * self.y) / k, -(c * self.y - s * self.x) / k


def found_at(seen: Features, printed: Features, reach: float = REACH) -> tuple[float, Motion]:
    """The shift at which a print agrees best with what is seen, both coarse.

    Args:
        seen: features of a face.
        printed: features of a picture at the same step.
        reach: how far to look around [m].

    Returns:
        How well they agree there, the cosine between their features, and the shift.
    """
    around = math.ceil(reach / seen.step)
    shape, part = seen.weights.shape, printed.weights.shape
    height, width = (max(a, b + 2 * around) for a, b in zip(shape, part, strict=True))
    top, left = (height - shape[0]) // 2, (width - shape[1]) // 2
    room = (top, height - shape[0] - top, left, width - shape[1] - left)
    field = cv2.copyMakeBorder(seen.values, *room, cv2.BORDER_CONSTANT)
    known = cv2.copyMakeBorder(seen.weights, *room, cv2.BORDER_CONSTANT)
    own = printed.values * printed.weights[..., None]
    product = cv2.matchTemplate(field, own, cv2.TM_CCORR)
    square = (field * field).sum(axis=2)
    energy = cv2.matchTemplate(square, printed.weights, cv2.TM_CCORR)
    squared = (own * printed.values).sum(axis=2)
    others = cv2.matchTemplate(known, squared, cv2.TM_CCORR)
    cosine = product / np.sqrt(np.maximum(energy * others, np.float32(1e-6)))
    rows, columns = cosine.shape
    y0, x0 = (rows - 1) / 2, (columns - 1) / 2
    low = (max(round(y0) - around, 0), max(round(x0) - around, 0))
    inner = cosine[low[0] : round(y0) + around + 1, low[1] : round(x0) + around + 1]
    _, best, _, (column, row) = cv2.minMaxLoc(inner)
    x = left + (shape[1] - 1) / 2 - (column + low[1] + (part[1] - 1) / 2)
    y = top + (shape[0] - 1) / 2 - (row + low[0] + (part[0] - 1) / 2)
    return best, Motion(x * seen.step, y * seen.step)


def registered(
    seen: Features, printed: Features, start: Motion, every: int = 1, steps: int = STEPS
) -> Motion:
    """The motion that lays a print over what is seen, from one nearby.

    Args:
        seen: features of a face.
        printed: features of a picture at the same step.
        start: where to begin.
        every: one pixel of so many along rows and columns is looked at.
        steps: how often to improve it at the most.
    """
    step = seen.step
    state = np.array([start.x / step, start.y / step, start.turn, start.scale, 0, 0, 0, 0, 0])
    state[7:] = OUTLIER, every
    spread = np.array([PRIOR[0] / step, PRIOR[1] / step, PRIOR[2], PRIOR[3], 1.0, 1.0, 1.0])
    room, normal, right = np.zeros((7, 7)), np.zeros((7, 7)), np.zeros(7)
    views = (seen.values, seen.weights, printed.values, printed.weights)
    ends = (ROUGH, steps, *STILL)
    steps_of_laying(*views, NOISE**2 / spread**2, ends, state, room, normal, right)
    sx, sy, st = (NOISE * np.sqrt(np.diag(np.linalg.inv(normal))[:3])).tolist()
    x, y, turn, scale = state[:4].tolist()
    return Motion(x * step, y * step, turn, scale, (sx * step, sy * step, st))


def brought_back(seen: Features, motion: Motion, shape: tuple[int, int]) -> Features:
    """What is seen, moved to where it lies on the print.

    Args:
        seen: features of a face.
        motion: where the print lies on it.
        shape: height and width of the print [pixel].
    """
    height, width = seen.weights.shape
    k, step = 1.0 + motion.scale, seen.step
    c, s = math.cos(motion.turn) / k, math.sin(motion.turn) / k
    # From the print's pixels back to those of what is seen.
    u0, v0 = (shape[1] - 1) / 2 + motion.x / step, (shape[0] - 1) / 2 + motion.y / step
    warp = np.array(
        [
            [c, s, (width - 1) / 2 - c * u0 - s * v0],
            [-s, c, (height - 1) / 2 + s * u0 - c * v0],
        ]
    )
    flags = cv2.INTER_LINEAR | cv2.WARP_INVERSE_MAP
    size = (shape[1], shape[0])
    values = cv2.warpAffine(seen.values, warp, size, flags=flags)
    weights = cv2.warpAffine(seen.weights, warp, size, flags=flags)
    return Features(np.asarray(values), np.asarray(weights), step)
