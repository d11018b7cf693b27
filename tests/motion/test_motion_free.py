"""Paths through free space: free, deterministic, not much longer than they must be."""

from itertools import pairwise

import numpy as np
import numpy.typing as npt
import pytest

from depal.cell.files import shipped_cell
from depal.geometry import OrientedBox, Pose
from depal.motion.collision import Body, Checker, Hand, Margins, Scene, Upright, fixed_solids
from depal.motion.planning.axes import Axes
from depal.motion.planning.free import Effort, Found, FreePlanner
from depal.motion.planning.samples import level_sample, stream_of, uniform
from depal.motion.planning.shortcuts import pull, shorten

Floats = npt.NDArray[np.float64]

CELL = shipped_cell("default")
BODY = Body.of(CELL)
PLANNER = FreePlanner(BODY.kinematics, CELL.robot.limits)
HELD = OrientedBox(Pose((0.37, 0.0, 0.0)), (0.34, 0.27, 0.22))
PILE = OrientedBox.from_corner((1.4, -0.6, 0.144), (0.8, 1.2, 1.2))
SCENE = Scene.of(fixed_solids(CELL), [("the pile", PILE)])
EMPTY = Checker(BODY, Hand.of(CELL.tool), SCENE, Margins())
HOLDING = Checker(
    BODY, Hand.of(CELL.tool, held=HELD), SCENE, Margins(), Upright((0.0, 0.0, 1.0), 0.44)
)
WALLED = SCENE.with_case("a wall", OrientedBox.from_corner((0.55, 0.45, 0.0), (1.4, 0.05, 2.4)))
"""Between the pallet and the trolleys on the left: too high to reach over."""


def at(x: float, y: float, z: float, yaw: float) -> Floats:
    """The configurations with the flange level at a point, looking along a yaw."""
    return BODY.kinematics.solve(Pose.from_yaw((x, y, z), yaw))


def free_ones(checker: Checker, configurations: Floats) -> Floats:
    """Those that touch nothing."""
    return np.array([q for q in configurations if checker.free(q)])


BEFORE_PILE = at(0.8, 0.1, 1.0, 0.0)
BEFORE_TROLLEY = at(0.1, 1.0, 1.1, np.pi / 2)


def assert_good(checker: Checker, found: Found, start: Floats, goals: Floats) -> None:
    """The path begins and ends as asked and is free between its corners, finely looked at."""
    assert np.array_equal(found.path[0], start)
    assert any(np.array_equal(found.path[-1], goal) for goal in goals)
    for a, b in pairwise(found.path):
        assert checker.edge_free(a, b, 0.004)
    assert found.length >= found.bound - 1e-9


@pytest.mark.parametrize("checker", [EMPTY, HOLDING])
def test_an_easy_way_from_the_pile_to_a_trolley_is_free_and_short(checker: Checker) -> None:
    """Over a drawn-in posture; a held box stays upright."""
    start, goals = free_ones(checker, BEFORE_PILE)[0], free_ones(checker, BEFORE_TROLLEY)
    found = PLANNER.quick(checker, start, goals, Effort())
    assert found is not None
    assert_good(checker, found, start, goals)
    assert found.length < 1.6 * found.bound


@pytest.mark.parametrize("checker", [EMPTY, HOLDING])
def test_trees_find_a_way_too(checker: Checker) -> None:
    """Searched for, not looked up."""
    start, goals = free_ones(checker, BEFORE_PILE)[0], free_ones(checker, BEFORE_TROLLEY)
    found = PLANNER.search(checker, start, goals, Effort(), level=checker is HOLDING)
    assert found is not None
    assert found.how == "trees"
    assert_good(checker, found, start, goals)


def test_where_no_easy_way_is_free_trees_go_the_long_way_round() -> None:
    """A wall between the pile and the trolley."""
    checker = Checker(BODY, Hand.of(CELL.tool), WALLED, Margins())
    start, goals = free_ones(checker, BEFORE_PILE)[0], free_ones(checker, BEFORE_TROLLEY)
    found = PLANNER.plan(checker, start, goals, Effort(iterations=6000), level=False)
    assert found is not None
    assert_good(checker, found, start, goals)


def test_the_same_call_gives_the_same_path_whatever_was_planned_before() -> None:
    """The seed is the call's, not the process's."""
    start, goals = free_ones(HOLDING, BEFORE_PILE)[0], free_ones(HOLDING, BEFORE_TROLLEY)
    first = PLANNER.search(HOLDING, start, goals, Effort(seed=3), level=True)
    PLANNER.search(HOLDING, start, goals, Effort(seed=4), level=True)
    again = PLANNER.search(HOLDING, start, goals, Effort(seed=3), level=True)
    assert first is not None
    assert again is not None
    assert np.array_equal(first.path, again.path)


def test_a_start_or_a_goal_in_collision_has_no_way() -> None:
    """Nothing is promised that is not free."""
    inside, outside = at(1.5, 0.0, 0.9, 0.0)[:1], free_ones(EMPTY, BEFORE_TROLLEY)
    assert not EMPTY.free(inside[0])
    assert PLANNER.plan(EMPTY, inside[0], outside, Effort(iterations=50), level=False) is None
    assert PLANNER.plan(EMPTY, outside[0], inside, Effort(iterations=50), level=False) is None


def test_shortcuts_and_pulled_corners_keep_ends_and_freedom_and_never_lengthen() -> None:
    """From a path with detours."""
    start, goal = free_ones(EMPTY, BEFORE_PILE)[0], free_ones(EMPTY, BEFORE_TROLLEY)[0]
    speed = np.array(CELL.robot.limits.speed)
    arm = BODY.kinematics
    axes = Axes(speed, arm.lower, arm.upper, 0.02)
    found = PLANNER.search(EMPTY, start, goal[None, :], Effort(seed=1), level=False)
    assert found is not None
    detour = np.concatenate((found.path, found.path[-2::-1], found.path[1:]))

    def length(path: Floats) -> float:
        return float((np.abs(np.diff(path, axis=0)) / speed).max(axis=1).sum())

    short = shorten(EMPTY.case, axes, detour, 60, 0)
    pulled = pull(EMPTY.case, axes, short)
    assert length(pulled) <= length(short) < length(detour)
    for path in (short, pulled):
        assert np.array_equal(path[[0, -1]], detour[[0, -1]])
        assert all(EMPTY.edge_free(a, b, 0.004) for a, b in pairwise(path))


def test_level_samples_hold_the_flange_level() -> None:
    """Up to a turn about the vertical, but for axes that reach their limits."""
    arm, stream = BODY.kinematics, stream_of(5)
    levels = np.eye(3)[None, :, :]
    level = 0
    for _ in range(200):
        q = level_sample(arm.lower, arm.upper, levels, arm.dims, stream)
        assert (q >= arm.lower).all()
        assert (q <= arm.upper).all()
        level += arm.frames(q)[6][2, 2] > 1 - 1e-9
    assert level > 120


def test_random_numbers_are_even_and_their_own() -> None:
    """A stream is told by its seed alone."""
    one, same, other = stream_of(1), stream_of(1), stream_of(2)
    numbers = np.array([uniform(one) for _ in range(4000)])
    assert np.array_equal(numbers, [uniform(same) for _ in range(4000)])
    assert not np.array_equal(numbers, [uniform(other) for _ in range(4000)])
    counts, _ = np.histogram(numbers, 20, (0.0, 1.0))
    assert counts.min() > 140
    assert abs(np.corrcoef(numbers[1:], numbers[:-1])[0, 1]) < 0.05
