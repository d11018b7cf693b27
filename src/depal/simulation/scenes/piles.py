"""Piles of boxes as they may stand before the cameras."""

from dataclasses import replace
from enum import StrEnum

import numpy as np

from depal.domain import BoxId, Detection
from depal.geometry import OrientedBox, Pose, footprint_overlap, prisms_of
from depal.selection import BlockingGraph
from depal.simulation.cases import Case

TRIES = 4
"""So often another place is drawn for a box that would reach into a neighbour."""


class Kind(StrEnum):
    """What has happened to a stack before the picture."""

    FULL = "full"
    UNLOADED = "unloaded"
    JUMBLED = "jumbled"


def unloaded(cases: tuple[Case, ...], random: np.random.Generator) -> tuple[Case, ...]:
    """What is left after a random share of the boxes has gone, from above and from the front.

    A box goes only when none stands on it and none before it. How much height counts against
    nearness is drawn, so both stairs and half-empty layers come up.
    """
    left = list(cases)
    gone = round(float(random.uniform(0.1, 0.75)) * len(cases))
    weight, noise = float(random.random()), random.normal(0.0, 0.12, len(cases))
    graph = BlockingGraph([Detection(_name(k), case.shape) for k, case in enumerate(left)])
    keys = {
        _name(k): weight * case.shape.centre[2] - (1 - weight) * case.shape.centre[0] + noise[k]
        for k, case in enumerate(left)
    }
    for _ in range(gone):
        leaves = graph.leaves()
        if not leaves:
            break
        graph.remove(max(sorted(leaves), key=keys.__getitem__))
    return tuple(case for k, case in enumerate(cases) if _name(k) in graph)


def loosened(
    cases: tuple[Case, ...], random: np.random.Generator, turn: float, gap: float
) -> tuple[Case, ...]:
    """The boxes with gaps between them, each turned and shifted a little in its place.

    Args:
        cases: as stacked.
        random: draws turns and shifts.
        turn: standard deviation of a box's turn about the vertical [rad].
        gap: by this share the stack is spread out from its middle.

    Returns:
        The same boxes; none reaches into another.
    """
    middle = np.mean([case.shape.centre for case in cases], axis=0)
    spread = []
    for case in cases:
        x, y, z = case.shape.centre
        at = (x + (x - middle[0]) * gap, y + (y - middle[1]) * gap, z)
        spread.append(replace(case, shape=_at(case.shape, at, 0.0)))
    prisms = prisms_of(case.shape for case in spread)
    for k, case in enumerate(spread):
        angles = np.clip(random.normal(0.0, turn, TRIES), -3 * turn, 3 * turn)
        shifts = random.normal(0.0, 0.3 * gap, (TRIES, 2)) * case.shape.size[0]
        for n, (angle, shift) in enumerate(zip(angles.tolist(), shifts, strict=True)):
            ease = 1.0 - n / TRIES
            x, y, z = case.shape.centre
            dx, dy = (shift * ease).tolist()
            tried = _at(case.shape, (x + dx, y + dy, z), angle * ease)
            row = prisms_of([tried])[0]
            before = prisms[k].copy()
            prisms[k] = row
            if not _reaches(prisms, k):
                spread[k] = replace(case, shape=tried)
                break
            prisms[k] = before
    return tuple(spread)


def _reaches(prisms: np.ndarray, k: int) -> bool:
    """Whether a box reaches into another."""
    rise = np.abs(prisms[:, 2] - prisms[k, 2])
    level = np.flatnonzero(rise < prisms[:, 5] + prisms[k, 5] - 1e-3)
    reach = np.hypot(prisms[:, 3], prisms[:, 4])
    apart = np.hypot(prisms[:, 0] - prisms[k, 0], prisms[:, 1] - prisms[k, 1])
    near = [j for j in level.tolist() if j != k and apart[j] < reach[j] + reach[k]]
    return any(footprint_overlap(prisms, k, j) > 0.0 for j in near)


def _at(shape: OrientedBox, at: tuple[float, float, float], angle: float) -> OrientedBox:
    turned = Pose.from_yaw((0.0, 0.0, 0.0), angle) @ Pose(rotation=shape.pose.rotation)
    return OrientedBox(Pose(at, turned.rotation), shape.size)


def _name(k: int) -> BoxId:
    return BoxId(f"{k:05d}")
