"""Bellows that are pressed in: how far, and what the load cell feels of it."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from simulated_worlds import CELL, hanging

from depal.domain import LOWER
from depal.simulation.sealing import Solids, pressed

STROKE, RADIUS = 0.010, 0.030
DOWN = np.array([0.0, 0.0, -1.0])
BOX = Solids(np.zeros((1, 3)), np.eye(3)[None], np.array([[0.2, 0.1, 0.15]]))
"""A box about the origin; its top is 0.15 m above it."""


def at(x: float, y: float, above: float) -> float:
    """How far a cup is pressed in that looks down from above the top [m]."""
    points = np.array([[x, y, 0.15 + above]])
    return float(pressed(points, DOWN, BOX, RADIUS, STROKE)[0])


@given(st.floats(-0.199, 0.199), st.floats(-0.099, 0.099), st.floats(-0.04, 0.04))
def test_bellows_give_from_a_stroke_before_the_plane_to_a_stroke_behind_it(
    x: float, y: float, above: float
) -> None:
    """No farther: then the tool itself is on the box."""
    expected = np.clip(STROKE - above, 0.0, 2 * STROKE)
    assert at(x, y, above) == pytest.approx(expected, abs=1e-12)


@given(st.floats(0.201, 0.5), st.floats(-0.3, 0.3), st.floats(-0.04, 0.04))
def test_a_cup_beside_a_box_is_not_pressed_in(x: float, y: float, above: float) -> None:
    """Nor is one that is far above or deep below its top."""
    assert at(x, y, above) == 0.0
    assert at(0.0, 0.0, 0.011) == 0.0
    assert at(0.0, 0.0, -0.06) == 0.0


def test_the_load_cell_feels_a_box_that_is_pressed_on_and_none_that_hangs() -> None:
    """Held, the box pulls down; let go of, it stands under bellows that are in by their stroke."""
    world, suction = hanging(LOWER, (0.3, 0.3, 0.2), 5.0), CELL.tool.suction
    held = world.load()
    assert held == pytest.approx(5.0, abs=0.2)
    world.suction.vent(world.now)
    push = 6 * suction.stiffness * suction.stroke
    assert held - world.load() == pytest.approx(push / 9.81, rel=0.1)
