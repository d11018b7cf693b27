"""Boxes of one look agree: with their faces, with their cameras, with what carries them."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from depal.geometry import Pose
from depal.perception.faces import Errors, Face, Facing
from depal.perception.settling import Draft, Place, settled
from depal.perception.settling.carrying import contacts
from depal.perception.settling.draft import YAW, Z

SIZE = (0.2, 0.3, 0.25)
GROUND = 0.06
FRONT = ((0.0, 0.0, 1.0), (-1.0, 0.0, 0.0), (0.0, -1.0, 0.0))
TOP = ((0.0, -1.0, 0.0), (-1.0, 0.0, 0.0), (0.0, 0.0, -1.0))
SIGMA = (0.002, 0.002, 0.004, math.radians(0.5))

places = st.tuples(st.floats(0.2, 0.6), st.floats(-0.3, 0.3), st.floats(0.3, 1.5))
turns = st.floats(-0.1, 0.1)


def errors(sigma: tuple[float, ...] = SIGMA, camera: int = 0, sway: float = 0.0) -> Errors:
    """Independent errors, and a depth that is too long where the camera's scale is."""
    rows = tuple(tuple(row) for row in np.diag(np.square(sigma)).tolist())
    return Errors(rows, camera, (0.0, 0.0, sway, 0.0))


def place(
    facing: Facing,
    middle: tuple[float, float, float],
    yaw: float = 0.0,
    off: tuple[float, float, float] = (0.0, 0.0, 0.0),
    told: Errors | None = None,
) -> Place:
    """A face of a box of `SIZE` in the region; found off by u, v and depth [m]."""
    depth, width, height = SIZE
    front = facing is Facing.FRONT
    local = (-depth / 2, 0.0, 0.0) if front else (0.0, 0.0, height / 2)
    box = Pose.from_yaw(middle, yaw)
    pose = box @ Pose(local, FRONT if front else TOP) @ Pose(off)
    size = (width, height) if front else (width, depth)
    return Place(Face(facing, pose, size, 0.9, errors=told or errors()), pose, yaw)


@given(places, turns, st.sampled_from([(Facing.FRONT,), (Facing.TOP,), tuple(Facing)]))
def test_a_box_is_where_its_faces_agree_that_it_is(
    middle: tuple[float, float, float], yaw: float, seen: tuple[Facing, ...]
) -> None:
    """Whichever of them are seen; a state where nothing is off is not moved."""
    draft = Draft(tuple(place(facing, middle, yaw) for facing in seen), SIZE, stands=False)
    state = np.array([*middle, yaw])
    for one in draft.places:
        assert draft.off(one, state)[0] == pytest.approx(np.zeros(4), abs=1e-12)
    exact = errors((1e-6,) * 4)
    draft = Draft(tuple(place(f, middle, yaw, told=exact) for f in seen), SIZE, stands=False)
    assert settled([draft], GROUND).states[0] == pytest.approx(state, abs=1e-4)


@given(places, turns, st.integers(0, 3), st.sampled_from(list(Facing)))
def test_what_is_expected_of_a_face_changes_as_its_rows_say(
    middle: tuple[float, float, float], yaw: float, axis: int, facing: Facing
) -> None:
    """Against differences."""
    draft = Draft((place(facing, middle, yaw),), SIZE, stands=False)
    state, step = np.array([*middle, yaw]), np.zeros(4)
    step[axis] = 1e-6
    before, rows = draft.off(draft.places[0], state)
    after, _ = draft.off(draft.places[0], state + step)
    assert (before - after) / 1e-6 == pytest.approx(rows[:, axis], abs=1e-4)


def test_the_more_exact_face_counts_more() -> None:
    """A front is wrong in depth, a top knows better, the other way round for heights."""
    middle = (0.4, 0.0, 0.7)
    front = place(Facing.FRONT, middle, off=(0.0, 0.0, 0.01), told=errors((1e-3, 1e-3, 0.01, 0.01)))
    top = place(Facing.TOP, middle, off=(0.0, 0.0, 0.01), told=errors((1e-3, 1e-3, 0.01, 0.01)))
    (state,) = settled([Draft((front, top), SIZE, stands=False)], GROUND).states
    assert state[:3] == pytest.approx(middle, abs=5e-4)


def test_boxes_stand_on_the_ground_and_on_each_other() -> None:
    """Tops alone are seen, each too low or too high by more than a box's slack."""
    lows = [GROUND + SIZE[2] * (k + 0.5) for k in range(3)]
    drafts = [
        Draft((place(Facing.TOP, (0.4, 0.0, z), off=(0.0, 0.0, off)),), SIZE, stands=True)
        for z, off in zip(lows, (0.006, -0.006, 0.005), strict=True)
    ]
    found = settled(drafts, GROUND)
    assert found.states[:, Z] == pytest.approx(lows, abs=2e-3)
    assert found.covariances[:, Z, Z].max() < 0.004**2


def test_a_box_that_stands_on_nothing_stays_where_it_is() -> None:
    """The gap is no error: it hangs over, or nobody sees what carries it."""
    draft = Draft((place(Facing.TOP, (0.4, 0.0, 0.75)),), SIZE, stands=True)
    assert settled([draft], GROUND).states[0, Z] == pytest.approx(0.75, abs=1e-9)
    free = Draft((place(Facing.TOP, (0.4, 0.0, 0.19)),), SIZE, stands=False)
    assert contacts([free], np.array([[0.4, 0.0, 0.19, 0.0]]), np.eye(5) * 1e-6, GROUND) == []


def test_what_carries_a_box_need_not_be_seen() -> None:
    """Others stand on boxes of that height: there is a level."""
    low, high = GROUND + SIZE[2] / 2, GROUND + SIZE[2] * 1.5
    drafts = [
        Draft((place(Facing.TOP, (0.4, -0.3, low)),), SIZE, stands=True),
        Draft((place(Facing.TOP, (0.4, 0.3, high), off=(0.0, 0.0, 0.006)),), SIZE, stands=True),
    ]
    assert settled(drafts, GROUND).states[1, Z] == pytest.approx(high, abs=4e-3)


def test_the_scale_of_a_cameras_depths_is_learnt_from_what_others_see() -> None:
    """All its fronts are too far away; tops know where they are."""
    drafts = []
    for k in range(6):
        middle = (0.4, 0.35 * (k % 3) - 0.35, 0.6 + 0.3 * (k // 3))
        swayed = errors((2e-3, 2e-3, 2e-3, 0.01), 0, 2.0)
        front = place(Facing.FRONT, middle, off=(0.0, 0.0, 0.006), told=swayed)
        top = place(Facing.TOP, middle, told=errors((1e-3, 1e-3, 5e-3, 0.01), 1))
        drafts.append(Draft((front, top), SIZE, stands=False))
    found = settled(drafts, GROUND)
    assert found.scales[0] == pytest.approx(0.003, abs=5e-4)
    assert np.abs(found.states[:, 0] - 0.4).max() < 1e-3


def test_what_is_badly_seen_is_turned_as_the_pile_is() -> None:
    """Straight in a straight pile, as measured in a crooked one."""
    vague, sure = ((2e-3, 2e-3, 4e-3, math.radians(turn)) for turn in (2.0, 0.2))
    yaws = []
    for turned in (0.0, math.radians(4)):
        drafts = [
            Draft((place(Facing.TOP, (0.4, k, 0.7), yaw, told=errors(sure)),), SIZE, stands=False)
            for k, yaw in enumerate([turned, -turned] * 4)
        ]
        seen = place(Facing.FRONT, (0.4, 9.0, 0.7), math.radians(2), told=errors(vague))
        drafts.append(Draft((seen,), SIZE, stands=False))
        yaws.append(settled(drafts, GROUND).states[-1, YAW])
    assert 0.0 < yaws[0] < math.radians(0.4)
    assert math.radians(1.2) < yaws[1] < math.radians(2)


def test_no_boxes_are_no_problem() -> None:
    """An empty pallet."""
    assert settled([], GROUND).states.shape == (0, 4)
