"""A tool keeps clear of what is measured, whatever boxes are believed."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from test_cell_unexplained import CELL, DECK, box, frame_of, from_above

from depal.cell.planning.towers import HIGHER, towers
from depal.cell.sight import relief_of
from depal.geometry import OrientedBox
from depal.ports import Relief

heights = st.floats(0.1, 0.5)
across = st.floats(-0.3, 0.3)


def relief(*there: OrientedBox) -> Relief:
    """What a camera above measures."""
    found = relief_of([from_above(list(there), 0.002)], CELL.pallet)
    assert found is not None
    return found


@given(st.floats(1.56, 1.85), across, heights)
def test_a_relief_is_as_high_as_what_stands_there(x: float, y: float, height: float) -> None:
    """Nowhere less within its edges, and nowhere more."""
    there = box(x, y, (0.24, 0.24, height))
    found = relief(there)
    assert np.nanmax(found.heights) == pytest.approx(height, abs=0.015)
    middle = found.cell_from_grid.inverse.apply(there.centre)
    row, column = (int(at / found.step) for at in middle[:2])
    around = found.heights[row - 10 : row + 11, column - 10 : column + 11]
    assert np.nanmin(around) == pytest.approx(height, abs=0.015)


def test_from_the_side_no_relief_is_measured() -> None:
    """Depths err along the ground there."""
    assert relief_of([frame_of([box(1.6, 0.0)])], CELL.pallet) is None


@given(across, heights, heights)
def test_all_that_is_higher_beside_a_box_lies_in_towers(y: float, low: float, high: float) -> None:
    """To the edge of a place; what is not higher does not, and what has left does not either."""
    taken = box(1.55, y, (0.2, 0.2, low))
    beside = box(1.75, y, (0.2, 0.2, high))
    found = towers(relief(taken, beside), taken)
    corners = np.concatenate([np.empty((0, 3)), *(solid.corners for solid in found)])
    if high < low + HIGHER - 0.015:
        assert not found
    elif high > low + HIGHER + 0.015:
        assert corners[:, 0].min() == pytest.approx(1.65, abs=0.03)
        assert corners[:, 0].max() == pytest.approx(1.85, abs=0.03)
        assert corners[:, 1].min() == pytest.approx(y - 0.1, abs=0.03)
        assert corners[:, 2].max() == pytest.approx(DECK + high, abs=0.015)
    assert towers(relief(taken, beside), taken, [beside]) == ()


@given(st.integers(0, 2**32 - 1))
def test_towers_are_where_places_are_higher_and_nowhere_else(seed: int) -> None:
    """Whatever the relief; a place is in one tower at the most."""
    rng = np.random.default_rng(seed)
    values = rng.choice([np.nan, 0.1, 0.4], (8, 9))
    found = Relief(CELL.pallet.cell_from_pallet, 0.02, values)
    low = OrientedBox.upright((0.08, 0.09, 0.1), (0.16, 0.18, 0.2)).seen_from(found.cell_from_grid)
    covered = np.zeros(values.shape, dtype=int)
    for tower in towers(found, low):
        local = tower.seen_from(found.cell_from_grid.inverse).corners
        first, last = np.round(local[:, :2].min(axis=0) / 0.02), local[:, :2].max(axis=0) / 0.02
        rows = slice(int(first[0]), round(float(last[0])))
        columns = slice(int(first[1]), round(float(last[1])))
        covered[rows, columns] += 1
    assert (covered == (values > 0.2 + HIGHER)).all()
