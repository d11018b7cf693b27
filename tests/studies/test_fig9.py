"""Pillars: the index by hand, and the study's own laws."""

import numpy as np
import pytest

from depal.studies.fig9 import draw_piles, fig9
from depal.studies.pillars import pillar_index

FOOTPRINT = (0.0, 0.0, 0.8, 1.6)


def boxes(*corners: tuple[float, float, float, float, float, float]) -> tuple[np.ndarray, ...]:  # type: ignore[type-arg]
    """Low and high corners."""
    array = np.array(corners, dtype=float).reshape(-1, 6)
    return array[:, :3], array[:, 3:]


def test_a_full_block_has_no_pillars() -> None:
    """Nothing stands narrower than 0.4 m."""
    low, high = boxes((0, 0, 0, 0.8, 1.6, 1.0))
    assert pillar_index(low, high, FOOTPRINT) == 0.0


def test_a_lone_tower_is_all_pillar() -> None:
    """0.2 x 0.2 m."""
    low, high = boxes((0.2, 0.4, 0, 0.4, 0.6, 1.0))
    assert pillar_index(low, high, FOOTPRINT) == 1.0


def test_a_tower_on_a_block_counts_by_its_volume() -> None:
    """0.2 x 0.2 x 0.5 m on 0.8 x 1.6 x 0.5 m."""
    low, high = boxes((0, 0, 0, 0.8, 1.6, 0.5), (0.2, 0.4, 0.5, 0.4, 0.6, 1.0))
    tower, block = 0.2 * 0.2 * 0.5, 0.8 * 1.6 * 0.5
    assert pillar_index(low, high, FOOTPRINT) == pytest.approx(tower / (tower + block))


def test_nothing_is_no_pillar() -> None:
    """An empty pallet."""
    low, high = boxes()
    assert pillar_index(low, high, FOOTPRINT) == 0.0


def test_both_modalities_leave_the_same_number_of_boxes() -> None:
    """20 fewer than there were, and without weight the very same."""
    for index in range(5):
        piles = draw_piles(0, index, 2, 0.9, 20)
        assert len(piles.left_h) == len(piles.left_hl) == len(piles.pallet) - 20
        same = draw_piles(0, index, 2, 0.0, 20)
        assert same.left_h.tolist() == same.left_hl.tolist()
        assert piles.wanted[0] in piles.blockers


def test_the_study_measures_every_number_of_requests() -> None:
    """One row each, and a pallet to look at."""
    result = fig9(pallets=10)
    assert [row.requests for row in result.rows] == [1, 3]
    assert all(0 <= row.h.mean <= 1 for row in result.rows)
    assert result.example.pillars(result.example.everything) == pytest.approx(0.0)
