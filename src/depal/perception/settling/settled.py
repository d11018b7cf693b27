"""One least-squares problem over all boxes of a look.

Faces say where their boxes are, each with its own errors; a camera's depths may all be too long by
one share; boxes stand on the ground or on others; and they are turned about as much as each other.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from depal.perception.settling.carrying import Contact, contacts
from depal.perception.settling.draft import YAW, Draft, Z
from depal.perception.settling.kernels import inverse

Floats = npt.NDArray[np.float64]

ROUNDS = 4
"""So often everything is solved, each time with what was learnt of contacts and turns."""

SCALE = 0.003
"""A camera's depths are too long by this share, as a standard deviation."""

OUTLYING = 3.0
"""A face that is off by more of its own standard deviations counts less."""

STRAIGHT, CROOKED = math.radians(0.3), math.radians(4.0)
"""Boxes of a pile are turned against it by at least and at most so much [rad]."""

SURE = math.radians(0.4)
"""How much a pile's boxes are turned is learnt from those whose yaw is known so well [rad]."""

SOME = 4
"""So many of them count as if they were turned as usual."""

USUAL = math.radians(1.2)
"""How much boxes are turned where nothing is known of the pile [rad]."""


@dataclass(frozen=True, slots=True, eq=False)
class Settled:
    """Where boxes are.

    Attributes:
        states: (n, 4) x, y, z of their middles [m] and yaw [rad], in the region's frame.
        covariances: (n, 4, 4).
        scales: by camera the share by which its depths are too long.
    """

    states: Floats
    covariances: Floats
    scales: Floats


def settled(drafts: Sequence[Draft], ground: float) -> Settled:
    """The places of boxes by all that is known of them.

    Args:
        drafts: boxes with their faces.
        ground: height of what the lowest stand on, in the region's frame [m].
    """
    n = len(drafts)
    cameras = 1 + max((p.errors.camera for d in drafts for p in d.places), default=0)
    states = np.array([draft.guess for draft in drafts]).reshape(n, 4)
    scales = np.zeros(cameras)
    touching: list[Contact] = []
    covariance = np.zeros((4 * n + cameras, 4 * n + cameras))
    for turn in range(ROUNDS):
        spread = USUAL if turn == 0 else _spread(states, covariance)
        normal, pull = _of_faces(drafts, states, scales)
        _straightened(normal, pull, states, spread)
        for contact in touching:
            _carried(normal, pull, contact)
        inverse(normal, covariance)
        step = covariance @ pull
        states += step[: 4 * n].reshape(n, 4)
        scales += step[4 * n :]
        touching = contacts(drafts, states, covariance, ground)
    blocks = np.array([covariance[4 * k : 4 * k + 4, 4 * k : 4 * k + 4] for k in range(n)])
    return Settled(states, blocks.reshape(n, 4, 4), scales)


def _of_faces(drafts: Sequence[Draft], states: Floats, scales: Floats) -> tuple[Floats, Floats]:
    """The normal equations of all faces, and of the cameras' scales."""
    n = len(drafts)
    size = 4 * n + len(scales)
    normal, pull = np.zeros((size, size)), np.zeros(size)
    at = np.arange(4 * n, size)
    normal[at, at] = SCALE**-2
    pull[at] = -scales * SCALE**-2
    for k, draft in enumerate(drafts):
        for place in draft.places:
            errors = place.errors
            off, rows = draft.off(place, states[k])
            sway = np.array(errors.sway)
            off = off - sway * scales[errors.camera]
            weight = np.linalg.inv(np.array(errors.covariance))
            away = math.sqrt(max(float(off @ weight @ off) / 4, 1e-12))
            weight *= min(OUTLYING / away, 1.0)
            every = np.column_stack((rows, sway))
            columns = [4 * k, 4 * k + 1, 4 * k + 2, 4 * k + 3, 4 * n + errors.camera]
            normal[np.ix_(columns, columns)] += every.T @ weight @ every
            pull[columns] += every.T @ weight @ off
    return normal, pull


def _straightened(normal: Floats, pull: Floats, states: Floats, spread: float) -> None:
    """Adds that boxes are turned no more than others."""
    yaws = 4 * np.arange(len(states)) + YAW
    normal[yaws, yaws] += spread**-2
    pull[yaws] -= states[:, YAW] * spread**-2


def _spread(states: Floats, covariance: Floats) -> float:
    """How much boxes are turned, as a standard deviation [rad]."""
    variances = np.diag(covariance)[: 4 * len(states)].reshape(-1, 4)[:, YAW]
    sure = variances < SURE**2
    square = float((states[sure, YAW] ** 2).sum()) + SOME * USUAL**2
    return float(np.clip(math.sqrt(square / (sure.sum() + SOME)), STRAIGHT, CROOKED))


def _carried(normal: Floats, pull: Floats, contact: Contact) -> None:
    """Adds that a box stands on something."""
    weight = contact.sigma**-2
    upper = 4 * contact.upper + Z
    columns, row = [upper], np.array([1.0])
    if contact.lower is not None:
        columns, row = [upper, 4 * contact.lower + Z], np.array([1.0, -1.0])
    normal[np.ix_(columns, columns)] += weight * np.outer(row, row)
    pull[columns] -= weight * row * contact.gap
