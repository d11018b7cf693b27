"""Ways out of wherever the arm has come to rest: from their ends it can go anywhere."""

import numpy as np
import pytest
from cells_at_work import Cell

from depal.domain import Joints, PlaceId
from depal.geometry import Pose
from depal.motion.collision.values import Array
from depal.motion.moves import OPEN
from depal.motion.planning.straight import straight_as_far

CELL = Cell()
PLACES = sorted(CELL.layout.places)
MOVER = CELL.desk.planner.mover


def inside(place: PlaceId) -> list[Joints]:
    """Configurations with the empty tool in the middle of a compartment and nothing near."""
    where = CELL.layout.places[place]
    _, height = where.opening
    checker = MOVER.checker(CELL.desk.promises.scene(CELL.work.pile), OPEN)
    found: list[Joints] = []
    for deep in (0.0, 0.1, 0.2, 0.3):
        at = where.cell_from_place @ Pose((deep, 0.0, 0.75 * height))
        for q in MOVER.body.kinematics.solve(at):
            if checker.free(q):
                a, b, c, d, e, f = q.tolist()
                found.append((a, b, c, d, e, f))
    return found


def open_at(q: Joints | Array) -> bool:
    """Whether nothing is near and the arm can draw in."""
    checker = MOVER.checker(CELL.desk.promises.scene(CELL.work.pile), OPEN)
    return checker.free(np.array(q)) and MOVER.is_open(checker, np.array(q))


def shut_in(place: PlaceId) -> list[Joints]:
    """Those from which the arm cannot draw in, and could after a straight way out."""
    inward = np.array(CELL.layout.places[place].cell_from_place.rotation)[:, 0]
    x, y, z = (-0.9 * inward).tolist()
    kinematics = MOVER.body.kinematics
    return [
        q
        for q in inside(place)
        if not open_at(q)
        and any(open_at(row) for row in straight_as_far(kinematics, np.array(q), (x, y, z)))
    ]


@pytest.mark.parametrize("place", PLACES)
def test_an_empty_arm_gets_out_of_a_compartment_though_nothing_is_near_it_there(
    place: PlaceId,
) -> None:
    """Standing in it free of everything was once taken for being out."""
    for q in shut_in(place):
        cell = Cell()
        cell.arm.at = q
        for way in cell.desk.clearing.ways_out():
            a, b, c, d, e, f = way.positions[-1].tolist()
            cell.arm.at = (a, b, c, d, e, f)
        assert cell.arm.at != q
        assert open_at(cell.arm.at)


def test_there_are_such_configurations() -> None:
    """So that the test above tests something."""
    assert sum(bool(shut_in(place)) for place in PLACES) > 2
