"""Where a face is by its print: every point of the print tells where it is seen."""

import math
from collections.abc import Sequence

import numpy as np
import numpy.typing as npt

from depal.perception.recognition.features import Features
from depal.perception.refining import kernels
from depal.perception.refining.belief import DEPTH, STATES, TURN, Belief, U, V

Floats = npt.NDArray[np.float64]

OUTLIER = 0.35
"""Features that differ by more count less."""

NOISE = 0.15
"""Features of a picture and another box of the product differ by so much at least."""

ALIKE = 5.5
"""So many pixels that are looked at differ alike."""

EVERY = 3
"""One pixel of so many along rows and columns is looked at."""

STEPS = 5
"""Gauss-Newton steps at the most."""

STILL = 5e-5
"""Steps end when nothing changes by more [m, rad]."""

PRINTED = 0.0022
"""The print sits so exactly on a box, two boxes against each other: standard deviation [m]."""

TURNED = math.radians(0.06)
"""The same for its turn [rad]."""

GROWN = 0.003
"""The same for its size, as a share."""


def by_print(
    seen: Features,
    printed: Features,
    eye: tuple[float, float, float],
    before: Belief,
    starts: Sequence[tuple[float, float, float]],
) -> Belief:
    """What a print says about where its face is.

    Args:
        seen: features of the face with a margin around it.
        printed: features of the print as it would be seen.
        eye: of the camera, in the face's frame [m].
        before: what is believed of the face.
        starts: how far the print may lie from there, roughly: along u, v [m] and its turn [rad];
            the one from which it agrees best in the end is taken.

    Returns:
        What the print alone says.
    """
    tried = [_laid(seen, printed, eye, before, start) for start in starts]
    _, normal, state = min(tried, key=lambda each: each[0])
    return _of_print(normal, state, eye)


def _laid(
    seen: Features,
    printed: Features,
    eye: tuple[float, float, float],
    before: Belief,
    start: tuple[float, float, float],
) -> tuple[float, Floats, Floats]:
    """How badly a print agrees when it is laid over a face, the information of that, and where."""
    free = slice(0, TURN + 1)
    prior, mean = np.linalg.inv(before.covariance[free, free]), before.mean[free]
    view = np.array([*eye, seen.step, OUTLIER, EVERY])
    state = np.zeros(8)
    state[free] = mean
    state[[U, V, TURN]] = start
    room, normal, right = np.zeros((3, 6)), np.zeros((8, 8)), np.zeros(8)
    views = (seen.values, seen.weights, printed.values, printed.weights)
    square, weight = 0.0, 1.0
    for _ in range(STEPS):
        square = float(kernels.laid_over(*views, view, state, room, normal, right))
        weight = 1.0 / (ALIKE * max(NOISE**2, square / 3))
        both, pull = normal * weight, right * weight
        both[free, free] += prior
        pull[free] += prior @ (mean - state[free])
        both[5:, 5:] += np.eye(3) * 1e-6
        change = np.linalg.solve(both, pull)
        state += change
        if np.abs(change[free]).max() < STILL:
            break
    return square, normal * weight, state


def _of_print(normal: Floats, state: Floats, eye: tuple[float, float, float]) -> Belief:
    """The offsets left out, and the print's own place and size on its box reckoned in."""
    ridge = np.diag([1.0, 1.0, 1e-2, 1.0, 1.0])  # nothing is said: known to no better than this
    inner = normal[:5, :5] - normal[:5, 5:] @ np.linalg.solve(
        normal[5:, 5:] + np.eye(3) * 1e-6, normal[5:, :5]
    )
    spread = np.linalg.inv(inner + ridge)
    grown = np.zeros(5)
    grown[[U, V, DEPTH]] = eye[0], eye[1], eye[2]
    spread += np.diag([PRINTED**2, PRINTED**2, 0.0, 0.0, TURNED**2])
    spread += np.outer(grown, grown) * GROWN**2
    information = np.zeros((STATES, STATES))
    information[:5, :5] = np.linalg.inv(spread)
    mean = np.zeros(STATES)
    mean[:5] = state[:5]
    return Belief(information, information @ mean)
