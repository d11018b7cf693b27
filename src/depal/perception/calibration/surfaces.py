"""Planes of a cell whose places are known: plates, what they hang on, the floor around them."""

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from depal.domain import Fiducial
from depal.geometry import OrientedBox
from depal.perception.calibration.finding import corners_of
from depal.perception.calibration.markers import PLATE

Floats = npt.NDArray[np.float64]

FLOOR = 0.02
"""A marker that faces up below this height lies on the floor, which is at height 0 [m]."""

AROUND = 3.4
"""The floor around such a marker is used so far: edge of the square by the marker's own."""

HUNG = 0.01
"""A plate hangs on a face that is so near to it [m]."""

_PARALLEL = 0.999


@dataclass(frozen=True, slots=True, eq=False)
class Surface:
    """A rectangle that a camera can measure depths on.

    Attributes:
        corners: (4, 3) in the cell frame [m].
        outward: its unit normal, away from what is behind it.
        hole: (4, 3) a part of it that something else covers [m]; None where there is none.
        edged: whether it ends at its corners: depths bleed over edges.
    """

    corners: Floats
    outward: Floats
    hole: Floats | None = None
    edged: bool = True


def surface_of(fiducial: Fiducial, fixtures: Iterable[OrientedBox]) -> Surface:
    """The largest known plane at a marker.

    Args:
        fiducial: the marker.
        fixtures: solid things of the cell, in its frame.

    Returns:
        The floor around a plate that lies on it, the face of the fixture that it hangs on, or
        the plate itself.
    """
    outward = -np.array(fiducial.cell_from_marker.rotation)[:, 2]
    middle = np.array(fiducial.cell_from_marker.translation)
    plate = corners_of(fiducial, PLATE)
    if outward[2] > _PARALLEL and middle[2] <= FLOOR:
        ground = corners_of(fiducial, AROUND)
        ground[:, 2] = 0.0
        return Surface(ground, outward, plate, edged=False)
    for fixture in fixtures:
        face = _face(fixture, outward, middle)
        if face is not None and _area(face) > _area(plate):
            return Surface(face, outward)
    return Surface(plate, outward)


def _face(box: OrientedBox, outward: Floats, point: Floats) -> Floats | None:
    """The face of a box that looks outward and that a point lies on: (4, 3), or None."""
    turn, half = np.array(box.pose.rotation), np.array(box.size) / 2
    along = outward @ turn
    axis = int(np.abs(along).argmax())
    if abs(along[axis]) < _PARALLEL:
        return None
    sign = float(np.sign(along[axis]))
    local = (point - np.array(box.pose.translation)) @ turn
    beside = np.abs(local) - half
    beside[axis] = abs(local[axis] - sign * half[axis]) - HUNG
    if beside.max() > 0.0:
        return None
    one, other = (axis + 1) % 3, (axis + 2) % 3
    corners = np.zeros((4, 3))
    corners[:, axis] = sign * half[axis]
    corners[:, one] = np.array((-1, 1, 1, -1)) * half[one]
    corners[:, other] = np.array((-1, -1, 1, 1)) * half[other]
    return np.asarray(corners @ turn.T + np.array(box.pose.translation))


def _area(corners: Floats) -> float:
    sides = corners[1] - corners[0], corners[3] - corners[0]
    return float(np.linalg.norm(np.cross(*sides)))
