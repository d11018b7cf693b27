"""A compartment, a held box and the margins as the kernels take them."""

import math
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from depal.domain import Place
from depal.logistics.placing.values import Held, Margins, Standing

Array = npt.NDArray[np.float64]

EPS = 1e-6
"""Closer than this is equal [m]."""

DENSITY = 300.0
"""Of a box whose mass nobody knows [kg/m^3]."""


class Scene(NamedTuple):
    """A compartment and its boxes as arrays.

    Attributes:
        low: (n, 3) smallest coordinates of each box [m].
        high: (n, 3) greatest ones [m].
        mass: (n,) [kg]; not a number where unknown.
        depth: of the compartment [m].
        width: of its opening [m].
        height: its clear height [m].
        reach: how deep behind the opening an outward face may be [m].
        order: (n,) the boxes from the highest bottom down.
        weight: (n,) mass [kg], estimated where unknown.
        pressing: (n, 3) scratch: what presses on each box [kg], and its moments [kg m].
    """

    low: Array
    high: Array
    mass: Array
    depth: float
    width: float
    height: float
    reach: float
    order: npt.NDArray[np.int64]
    weight: Array
    pressing: Array


class Load(NamedTuple):
    """The held box as arrays.

    Attributes:
        depth: of the box along the way in [m].
        width: [m].
        height: [m].
        mass: [kg]; not a number where unknown.
        tool: (m, 5) reach, right, left, low, high of what comes in with it [m].
    """

    depth: float
    width: float
    height: float
    mass: float
    tool: Array


class Rules(NamedTuple):
    """`Margins` for the kernels."""

    clearance: float
    lift: float
    skim: float
    above: float
    level: float
    support: float
    heavier: float


def scene_of(place: Place, boxes: tuple[Standing, ...], max_depth: float) -> Scene:
    """A compartment and what stands in it, for the kernels."""
    low = np.array([box.corner for box in boxes], dtype=np.float64).reshape(-1, 3)
    size = np.array([box.size for box in boxes], dtype=np.float64).reshape(-1, 3)
    mass = np.array([math.nan if box.mass is None else box.mass for box in boxes], dtype=np.float64)
    width, height = place.opening
    return Scene(
        low=low,
        high=low + size,
        mass=mass,
        depth=place.depth,
        width=width,
        height=height,
        reach=max_depth,
        order=np.argsort(-low[:, 2], kind="stable"),
        weight=np.where(np.isnan(mass), size.prod(axis=1) * DENSITY, mass),
        pressing=np.zeros((len(boxes), 3)),
    )


def load_of(held: Held) -> Load:
    """A held box, for the kernels."""
    rows = [(part.reach, part.right, part.left, part.low, part.high) for part in held.tool]
    tool = np.array(rows, dtype=np.float64).reshape(-1, 5)
    return Load(*held.size, math.nan if held.mass is None else held.mass, tool)


def rules_of(margins: Margins) -> Rules:
    """Margins, for the kernels."""
    return Rules(
        clearance=margins.clearance,
        lift=margins.lift,
        skim=margins.skim,
        above=margins.above,
        level=margins.level,
        support=margins.support,
        heavier=margins.heavier,
    )
