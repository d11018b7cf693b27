"""Laws of every trajectory: limits, ends, scaling, rounded corners."""

import itertools

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from timed_motions import (
    ACCELERATION,
    CELL,
    KINEMATICS,
    ROBOT,
    SPEED,
    Floats,
    accelerations,
    between,
    corners,
    flange_points,
    flange_speeds,
    seeds,
)

from depal.errors import SettingError
from depal.motion.planning.straight import straight
from depal.motion.timing import Leg, bound_time, full_speed_time, smooth, time_path
from depal.ports import Trajectory


def timed(*legs: Leg, speed: float = 1.0) -> Trajectory:
    """The trajectory along legs with nothing held, which there always is."""
    trajectory = time_path(legs, ROBOT, speed=speed)
    assert trajectory is not None
    return trajectory


def approach() -> tuple[Leg, Leg]:
    """Through free space to before a box, then straight on to it."""
    touch = np.array([0.1, -0.9, 1.2, 0.0, -0.3, 0.0])
    back = straight(KINEMATICS, touch, (-0.25, 0.0, 0.0))
    assert back is not None
    free = np.stack((np.array(ROBOT.parked), back[-1]))
    return Leg(free, speed=2.0), Leg(back[::-1].copy(), curve=True, speed=0.4, touching=True)


@settings(max_examples=30)
@given(seeds, st.sampled_from([0.5, 2.0, float("inf")]))
def test_no_limit_of_the_axes_or_the_flange_is_exceeded(seed: int, fastest: float) -> None:
    """Speeds and accelerations of the axes, speed of the flange."""
    trajectory = timed(Leg(corners(seed), speed=fastest))
    assert (np.abs(trajectory.velocities) <= 1.001 * SPEED).all()
    assert (np.abs(accelerations(trajectory)) <= 1.01 * ACCELERATION).all()
    assert flange_speeds(trajectory).max() <= 1.01 * fastest


@given(seeds)
def test_a_trajectory_begins_and_ends_at_rest_where_its_path_does(seed: int) -> None:
    """Both ends are exact, times rise."""
    points = corners(seed)
    trajectory = timed(Leg(points))
    np.testing.assert_allclose(trajectory.positions[0], points[0], atol=1e-12)
    np.testing.assert_allclose(trajectory.positions[-1], points[-1], atol=1e-9)
    assert not trajectory.velocities[0].any()
    assert not trajectory.velocities[-1].any()
    assert (np.diff(trajectory.times) > 0.0).all()
    assert trajectory.duration > bound_time(points, ROBOT.limits)


@given(seeds)
def test_some_limit_is_reached_nearly_everywhere(seed: int) -> None:
    """What uses no limit could be faster; within one interval it turns from one to another."""
    trajectory = timed(Leg(corners(seed, most=2)))
    fast = (np.abs(trajectory.velocities[:-1]) / SPEED).max(axis=1)
    hard = (np.abs(accelerations(trajectory)[: len(fast)]) / ACCELERATION).max(axis=1)
    assert (np.maximum(fast, hard) > 0.99).mean() > 0.9


@given(seeds, st.floats(0.02, 1.0))
def test_slower_is_the_same_motion_stretched_in_time(seed: int, speed: float) -> None:
    """Times grow by one over the share, speeds shrink with it, accelerations with its square."""
    leg = Leg(corners(seed))
    full, slow = timed(leg), timed(leg, speed=speed)
    np.testing.assert_allclose(slow.times * speed, full.times, rtol=1e-9)
    np.testing.assert_array_equal(slow.positions, full.positions)
    np.testing.assert_allclose(slow.velocities, full.velocities * speed, rtol=1e-9)
    np.testing.assert_allclose(
        accelerations(slow), accelerations(full) * speed**2, rtol=1e-6, atol=1e-6
    )


@settings(max_examples=20)
@given(seeds, st.floats(0.001, 0.02))
def test_a_rounded_corner_stays_near_its_corner(seed: int, rounding: float) -> None:
    """The flange leaves the lines between the corners by no more than it may."""
    points = corners(seed)
    legs = [Leg(points, rounding=rounding)]
    path = smooth(legs, ROBOT)
    assert path is not None
    assert path.deviation <= rounding
    along = np.linspace(0.0, 1.0, 300)[:, None]
    pairs = itertools.pairwise(points)
    lines = flange_points(np.concatenate([a + along * (b - a) for a, b in pairs]))
    flange = flange_points(path.at(np.linspace(0.0, float(path.lengths.sum()), 150)))
    start, step = lines[:-1], np.diff(lines, axis=0)
    to = flange[:, None, :] - start[None, :, :]
    share = np.clip((to * step).sum(axis=2) / np.maximum((step**2).sum(axis=1), 1e-12), 0.0, 1.0)
    off = np.linalg.norm(to - share[:, :, None] * step, axis=2).min(axis=1)
    assert off.max() <= rounding + 1e-4


@given(seeds)
def test_axes_move_without_jumps_over_rounded_corners(seed: int) -> None:
    """Position and rate are continuous wherever the arm does not stop."""
    path = smooth([Leg(corners(seed))], ROBOT, lambda _: True)
    assert path is not None
    for k in range(len(path.lengths) - 1):
        c, u = path.pieces[k], path.lengths[k]
        end = c[0] + u * (c[1] + u * (c[2] + u * c[3]))
        rate = c[1] + u * (2 * c[2] + 3 * u * c[3])
        np.testing.assert_allclose(path.pieces[k + 1, 0], end, atol=1e-9)
        if not path.stops[k + 1]:
            np.testing.assert_allclose(path.pieces[k + 1, 1], rate, atol=1e-9)


@given(seeds)
def test_a_corner_that_may_be_cut_costs_less_than_one_that_may_not(seed: int) -> None:
    """A check that allows everything is faster than the bound, and that than a stop."""
    points = corners(seed)
    stopped = timed(Leg(points, rounding=0.0)).duration
    bounded = timed(Leg(points)).duration
    free = time_path([Leg(points)], ROBOT, clear=lambda _: True)
    assert free is not None
    assert free.duration <= bounded * 1.02
    assert bounded <= stopped * 1.001


def test_what_a_check_refuses_is_not_passed() -> None:
    """Every configuration of the motion is on the lines or was allowed."""
    points = corners(3)
    assert len(points) > 2
    seen: list[Floats] = []

    def clear(rows: Floats) -> bool:
        seen.append(rows)
        return len(seen) > 3

    path = smooth([Leg(points)], ROBOT, clear)
    assert path is not None
    largest = np.ptp(seen[0], axis=0).max()
    assert np.ptp(seen[3], axis=0).max() < 0.3 * largest
    refused = smooth([Leg(points)], ROBOT, lambda _: False)
    assert refused is not None
    assert refused.stops.all()


def test_a_motion_goes_on_from_free_space_into_a_straight_line_without_a_stop() -> None:
    """The flange keeps to the line and to its speed there, and the box may touch only there."""
    free, line = approach()
    trajectory = timed(free, line)
    ((start, end),) = trajectory.allowances
    assert end == trajectory.duration
    points = [trajectory.at(float(t))[0] for t in np.linspace(start + 0.05, end, 60)]
    on_line = flange_points(np.array(points))
    goal = flange_points(line.points[-1:])[0]
    assert np.abs(on_line[:, 1:] - goal[1:]).max() < 2e-4
    late = trajectory.times >= start
    assert flange_speeds(trajectory)[late].max() <= 0.4 * 1.01
    rates = np.abs(trajectory.velocities).max(axis=1)
    assert rates[1:-1].min() > 0.02
    assert start == pytest.approx(timed(free).duration, abs=0.5)


def test_a_leg_without_rounding_ends_in_a_stop() -> None:
    """Then the legs take as long as they would take one by one."""
    free, line = approach()
    sharp = Leg(free.points, speed=free.speed, rounding=0.0)
    together = timed(sharp, line)
    assert together.duration == pytest.approx(timed(free).duration + timed(line).duration, rel=0.01)


def test_an_arm_that_turns_back_stops_first() -> None:
    """There is no corner to cut when the way back is the way there."""
    free, _ = approach()
    there_and_back = np.concatenate((free.points, free.points[:1]))
    double = timed(Leg(there_and_back)).duration
    assert double == pytest.approx(2 * timed(Leg(free.points)).duration, rel=0.01)


def test_neighbouring_legs_that_may_touch_are_one_allowance() -> None:
    """A lift and a pull out are one straight move to the referee."""
    _, line = approach()
    half = len(line.points) // 2
    first = Leg(line.points[: half + 1], curve=True, touching=True)
    second = Leg(line.points[half:], curve=True, touching=True)
    trajectory = timed(first, second)
    assert trajectory.allowances == ((0.0, trajectory.duration),)


def test_where_nothing_moves_there_is_one_sample() -> None:
    """And the same point twice is one."""
    point = np.array([ROBOT.parked, ROBOT.parked])
    trajectory = timed(Leg(point))
    assert trajectory.duration == 0.0
    assert trajectory.end == ROBOT.parked
    free, line = approach()
    resting = Leg(np.repeat(free.points[-1:], 3, axis=0))
    assert timed(free, resting, line).duration == pytest.approx(
        timed(free, line).duration, rel=1e-9
    )


def test_the_same_legs_give_the_same_bytes() -> None:
    """Nothing depends on the hour."""
    first, second = (timed(*approach()) for _ in range(2))
    assert first.times.tobytes() == second.times.tobytes()
    assert first.positions.tobytes() == second.positions.tobytes()
    assert first.velocities.tobytes() == second.velocities.tobytes()


@given(seeds)
def test_the_bound_of_a_path_is_the_time_of_its_straight_line(seed: int) -> None:
    """No path to the same end is shorter at full speed."""
    points = corners(seed)
    bound = bound_time(points, ROBOT.limits)
    assert bound <= full_speed_time(points, ROBOT.limits) + 1e-12
    assert bound == pytest.approx(full_speed_time(points[[0, -1]], ROBOT.limits))
    assert (np.abs(points[-1] - points[0]) <= SPEED * bound * (1 + 1e-12)).all()


@settings(max_examples=20)
@given(seeds)
def test_samples_and_what_lies_between_them_agree(seed: int) -> None:
    """The cubics between samples stay within the limits of the axes' positions too."""
    trajectory = timed(Leg(corners(seed)))
    rows = between(trajectory, 300)
    assert (rows >= np.array(ROBOT.limits.lower) - 1e-6).all()
    assert (rows <= np.array(ROBOT.limits.upper) + 1e-6).all()
    assert np.diff(trajectory.times).max() <= 0.0201


def test_straight_moves_keep_to_the_cells_speed() -> None:
    """The default cell's straight speed is an example of a leg's limit."""
    _, line = approach()
    leg = Leg(line.points, curve=True, speed=CELL.speeds.straight)
    assert flange_speeds(timed(leg)).max() == pytest.approx(CELL.speeds.straight, rel=0.01)


def test_legs_that_do_not_meet_are_refused() -> None:
    """The arm cannot jump."""
    free, line = approach()
    with pytest.raises(SettingError, match=r"leg 2: it begins .* rad from where the one before"):
        timed(line, free)
