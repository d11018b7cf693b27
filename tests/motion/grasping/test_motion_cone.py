"""The cone of planes against the theory of cups: never outside it, and not far inside."""

import math

import numpy as np
import numpy.typing as npt
import pytest
from hypothesis import given
from hypothesis import strategies as st

from depal.cell.files import shipped_cell
from depal.domain import Grasp
from depal.geometry import OrientedBox, Vector3
from depal.motion.grasping import Holding, cone_rows, grasps, greatest_lean
from depal.motion.grasping.cone import round_directions
from depal.motion.grasping.holding import G

TOOL = shipped_cell("default").tool
SIZE: Vector3 = (0.35, 0.4, 0.3)
WAYS = grasps(OrientedBox.upright((1.6, 0.0, 0.9), SIZE), 4.0, TOOL, (-1.0, 0.0, 0.0))

numbers = st.floats(-1.0, 1.0)
vectors = st.tuples(numbers, numbers, numbers).map(np.array)
ways = st.sampled_from(WAYS)

Floats = npt.NDArray[np.float64]


def held(grasp: Grasp, mass: float = 4.0) -> Holding:
    """A box in the hand."""
    return Holding.of(grasp, mass, TOOL, size=SIZE)


def up_of(grasp: Grasp) -> Floats:
    """The direction in the flange's frame that points up when the box stands."""
    up: Floats = np.array(grasp.box_from_flange.rotation)[2]
    return up


@given(ways, vectors, vectors)
def test_what_the_planes_allow_the_cups_hold_and_nearly_all_that_they_hold_is_allowed(
    grasp: Grasp, force: Floats, moment: Floats
) -> None:
    """Scaled until the planes just allow it, a load uses between 93 and 100 % of the cups."""
    holding = held(grasp)
    force, moment = 100.0 * force, 10.0 * moment
    force[0] = abs(force[0])  # a pull; a box that presses on the cups is held better
    worst = float((cone_rows(holding) @ np.concatenate((force, moment))).max())
    if worst <= 1e-3:  # it presses the box on: nothing to hold
        return
    counted = holding.pull / holding.safety
    share, _ = holding.group.load_share(force / worst, moment / worst, counted)
    assert share <= 1.0 + 1e-9
    grown, _ = holding.group.load_share(1.08 * force / worst, 1.08 * moment / worst, counted)
    assert grown > 1.0


@given(vectors)
def test_the_directions_cover_the_sphere_to_the_share_that_they_claim(direction: Floats) -> None:
    """No direction is further from all of them than the middle of a face."""
    directions, share = round_directions()
    length = float(np.linalg.norm(direction))
    if length > 1e-6:
        assert (directions @ direction).max() / length >= share - 1e-9
    assert 0.93 < share < 0.94
    assert np.linalg.norm(directions, axis=1) == pytest.approx(np.ones(42))


@given(ways, st.floats(1.0, 12.0), st.floats(0.0, 2 * math.pi), st.floats(0.0, 1.0))
def test_a_box_that_leans_less_than_the_greatest_lean_is_held(
    grasp: Grasp, mass: float, heading: float, share: float
) -> None:
    """In every direction."""
    holding, up = held(grasp, mass), up_of(grasp)
    lean = greatest_lean(holding, up)
    assert (lean < 0.0) == (cone_most(holding, up) > 0.98)
    if lean >= 0.0:
        assert holding.share(G * leaned(up, heading, share * lean)) <= 1.0


@pytest.mark.parametrize("mass", [6.0, 8.0, 10.0])
def test_beyond_the_greatest_lean_some_direction_is_not_held(mass: float) -> None:
    """The bound is one that is reached."""
    for grasp in WAYS:
        holding, up = held(grasp, mass), up_of(grasp)
        lean = greatest_lean(holding, up)
        if 0.0 <= lean < 3.0:
            beyond = [
                cone_most(holding, leaned(up, k * math.pi / 30, lean + 0.01)) for k in range(60)
            ]
            assert max(beyond) > 0.979


@given(ways, vectors, vectors, vectors)
def test_a_flange_that_turns_about_the_boxs_centre_feels_its_inertia_only(
    grasp: Grasp, angular: Floats, spin: Floats, axis: Floats
) -> None:
    """At the centre nothing accelerates; the load is the moment that turns the box."""
    holding = held(grasp)
    arm = holding.centre
    still = -np.cross(angular, arm) - np.cross(spin, np.cross(spin, arm))
    turning = holding.inertia @ angular + np.cross(spin, holding.inertia @ spin)
    share = holding.share_in_motion(still, angular, spin, np.zeros(3))
    assert share == pytest.approx(holding.share(np.zeros(3), turning=turning), abs=1e-9)
    rotated = holding.inertia @ axis
    assert float(axis @ rotated) >= 0.0


def test_the_inertia_is_a_boxs() -> None:
    """A twelfth of the mass times the squares of the edges across, in the flange's frame."""
    upright = WAYS[0]
    assert np.array(upright.box_from_flange.rotation) == pytest.approx(np.eye(3), abs=1e-9)
    x, y, z = SIZE
    expected = np.diag([y * y + z * z, x * x + z * z, x * x + y * y]) * 4.0 / 12
    assert held(upright).inertia == pytest.approx(expected)


def leaned(up: Floats, heading: float, lean: float) -> Floats:
    """A direction that leans away from up."""
    side = np.cross(up, np.eye(3)[int(np.argmin(np.abs(up)))])
    side = side / np.linalg.norm(side)
    other = np.cross(up, side)
    flat = math.cos(heading) * side + math.sin(heading) * other
    out: Floats = math.cos(lean) * up + math.sin(lean) * flat
    return out


def cone_most(holding: Holding, up: Floats) -> float:
    """The fullest row of the cone at rest."""
    into = holding.flange_from_face.T
    force = -holding.mass * G * up
    moment = np.cross(holding.centre - holding.middle, force)
    return float((cone_rows(holding) @ np.concatenate((into @ force, into @ moment))).max())
