"""The suction in the timing: held boxes stay held, at the limit and not far below it."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from timed_motions import CELL, KINEMATICS, ROBOT, Floats, carried, heavy, seeds, shares

from depal.domain import Approach, Grasp
from depal.geometry import Pose
from depal.motion.grasping import Holding
from depal.motion.timing import Leg, time_path


def swing(grasp: Grasp) -> Floats:
    """A wide turn with a rise, the box upright at both ends, (2, 6) [rad]."""
    low = Pose.from_yaw((1.5, 0.4, 0.6), 0.0) @ grasp.box_from_flange
    high = Pose.from_yaw((0.4, -1.3, 1.5), -1.3) @ grasp.box_from_flange
    start = KINEMATICS.solve(low)[0]
    ends = KINEMATICS.solve(high, start)
    end = ends[np.argmin(np.abs(ends - start).max(axis=1))]
    return np.stack((start, end))


@settings(max_examples=15)
@given(seeds)
def test_a_held_box_never_asks_more_of_the_cups_than_they_are_counted_on(seed: int) -> None:
    """Seen from the poses of the flange alone, which know nothing of rows and sweeps."""
    case = carried(seed, (2.0, 11.0))
    assume(case is not None)
    assert case is not None
    leg, holding = case
    trajectory = time_path([leg], ROBOT, held=holding)
    assume(trajectory is not None)
    assert trajectory is not None
    assert shares(trajectory, holding, count=120).max() <= 1.01


@settings(max_examples=15)
@given(seeds)
def test_a_box_costs_time_only_where_it_would_be_at_risk(seed: int) -> None:
    """Slower than an empty hand means that the suction is used up somewhere."""
    case = carried(seed, (2.0, 11.0))
    assume(case is not None)
    assert case is not None
    leg, holding = case
    careful = time_path([leg], ROBOT, held=holding)
    careless = time_path([leg], ROBOT)
    assume(careful is not None)
    assert careful is not None
    assert careless is not None
    assert careful.duration >= careless.duration * (1 - 1e-9)
    if careful.duration > 1.02 * careless.duration:
        # The round friction cone is replaced by a polyhedron that keeps 93 % of it.
        assert shares(careful, holding, count=200).max() > 0.85


@pytest.mark.parametrize("mass", [14.0, 16.0, 18.0, 20.0])
@pytest.mark.parametrize("approach", list(Approach))
def test_without_the_cone_a_heavy_box_is_lost_and_with_it_it_is_held(
    mass: float, approach: Approach
) -> None:
    """The whole pull, with safety 1, is not enough at full speed; with the cone it is."""
    grasp, size = heavy(mass, approach)
    grip = replace(Holding.of(grasp, mass, CELL.tool, size=size), safety=1.0)
    leg = Leg(swing(grasp))
    careless = time_path([leg], ROBOT)
    careful = time_path([leg], ROBOT, held=grip)
    assert careless is not None
    assert careful is not None
    assert shares(careless, grip).max() > 1.0
    assert 0.85 < shares(careful, grip).max() <= 1.01


@settings(max_examples=12)
@given(seeds, st.floats(0.04, 1.0))
def test_what_holds_at_full_speed_holds_slower(seed: int, speed: float) -> None:
    """Between the load at rest and the load at speed the cone has no holes."""
    case = carried(seed, (6.0, 11.0))
    assume(case is not None)
    assert case is not None
    leg, holding = case
    trajectory = time_path([leg], ROBOT, held=holding, speed=speed)
    assume(trajectory is not None)
    assert trajectory is not None
    assert shares(trajectory, holding, count=40).max() <= 1.01


def test_a_box_that_would_not_hang_still_has_no_trajectory() -> None:
    """However slowly: the answer is None, not a motion that lasts for ever."""
    grasp, size = heavy(1.0, Approach.HORIZONTAL)
    leg = Leg(swing(grasp))
    held = Holding.of(grasp, 60.0, CELL.tool, size=size)
    assert time_path([leg], ROBOT, held=held) is None
    light = Holding.of(grasp, 1.0, CELL.tool, size=size)
    assert time_path([leg], ROBOT, held=light) is not None
