"""Boxes dropped on one another."""

import math

import numpy as np
import numpy.typing as npt
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from depal.errors import SettingError
from depal.studies.pallets import COUNTS, GENERATORS, X_NEAR, RandomPallet
from depal.studies.pallets.draws import uniforms
from depal.studies.pallets.dropped import ROOM, drawn_edges, pile

seeds = st.integers(min_value=0, max_value=2**32 - 1)
few = settings(max_examples=25, deadline=None)


def pallet_of(seed: int) -> RandomPallet:
    """One dropped pallet."""
    return GENERATORS["dropped"](np.random.default_rng(seed))


def carriers(pallet: RandomPallet, box: int) -> npt.NDArray[np.intp]:
    """The boxes whose top is just where a box stands and that reach below it."""
    low, high = pallet.low, pallet.high
    shared = np.minimum(high[:, :2], high[box, :2]) - np.maximum(low[:, :2], low[box, :2])
    return np.flatnonzero((high[:, 2] == low[box, 2]) & (shared > 0).all(axis=1))


@few
@given(seed=seeds)
def test_nothing_floats_and_half_of_every_base_is_carried(seed: int) -> None:
    """A box stands on the deck or on boxes that precede it, at exactly their height."""
    pallet = pallet_of(seed)
    low, high = pallet.low, pallet.high
    for box in np.flatnonzero(low[:, 2] > 0).tolist():
        below = carriers(pallet, box)
        assert (below < box).all()
        shared = np.minimum(high[below, :2], high[box, :2]) - np.maximum(
            low[below, :2], low[box, :2]
        )
        base = np.prod(high[box, :2] - low[box, :2])
        assert shared.prod(axis=1).sum() >= base / 2 - 1e-12


@few
@given(seed=seeds)
def test_every_centre_is_over_a_box_that_carries_it(seed: int) -> None:
    """Or over the deck."""
    pallet = pallet_of(seed)
    for box in np.flatnonzero(pallet.low[:, 2] > 0).tolist():
        below, centre = carriers(pallet, box), pallet.centres[box, :2]
        over = (pallet.low[below, :2] < centre) & (centre < pallet.high[below, :2])
        assert over.all(axis=1).any()


@few
@given(seed=seeds)
def test_boxes_lie_on_a_grid_of_two_centimetres(seed: int) -> None:
    """All their corners, counted from the volume's near right corner on the deck."""
    pallet = pallet_of(seed)
    for corners in (pallet.low, pallet.high):
        cells = (corners - [X_NEAR, -0.8, 0.0]) / 0.02
        assert cells == pytest.approx(np.round(cells), abs=1e-7)


@few
@given(seed=seeds, count=st.sampled_from(COUNTS))
def test_boxes_are_drawn_near_cubic_with_62_percent_of_the_volume(seed: int, count: int) -> None:
    """Before they fall. But for rounding no edge is above 5/3 of another one."""
    edges = np.array(drawn_edges(uniforms(np.random.default_rng(seed)), count))
    assert edges.shape == (count, 3)
    assert edges.prod(axis=1).sum() / math.prod(ROOM) == pytest.approx(0.62, abs=0.03)
    assert edges.max() - 0.5 <= (edges.min() + 0.5) * 5 / 3
    assert (edges <= ROOM).all()


def test_boxes_are_drawn_with_62_percent_of_the_volume_in_the_mean() -> None:
    """Over 720 pallets as drawn: what the rounding to cells adds and takes cancels out."""
    draw = uniforms(np.random.default_rng(4))
    fills = [
        np.prod(drawn_edges(draw, count), axis=1).sum() / math.prod(ROOM)
        for _ in range(20)
        for count in COUNTS
    ]
    assert np.mean(fills) == pytest.approx(0.62, abs=0.002)


@few
@given(seed=seeds)
def test_a_box_is_never_larger_than_drawn(seed: int) -> None:
    """It loses as many cells of each edge, down to the smallest side."""
    draw = uniforms(np.random.default_rng(seed))
    drawn = drawn_edges(draw, 20)
    for edges, box in zip(drawn, pile(draw, drawn), strict=True):
        left = [box[axis + 3] - box[axis] for axis in range(3)]
        lost = max(edges) - max(left)
        assert lost >= 0
        assert left == [max(3, edge - lost) for edge in edges]


def test_piles_are_filled_to_two_fifths_and_bridge_gaps() -> None:
    """Over 200 pallets: the mean fill, and boxes that rest on two others or more."""
    rng = np.random.default_rng(1)
    pallets = [GENERATORS["dropped"](rng) for _ in range(200)]
    fills = [pallet.sizes.prod(axis=1).sum() / 1.28 for pallet in pallets]
    bridges = [
        sum(len(carriers(pallet, box)) > 1 for box in range(len(pallet))) for pallet in pallets
    ]
    assert math.fsum(fills) / len(fills) == pytest.approx(0.43, abs=0.02)
    assert np.count_nonzero(bridges) > 20


def test_a_box_without_a_place_is_refused() -> None:
    """The first box fills the volume, so the second one finds nothing at any size."""
    with pytest.raises(SettingError) as error:
        pile(uniforms(np.random.default_rng(0)), [ROOM, (10, 10, 10)])
    assert str(error.value) == (
        "boxes: of 2 boxes only 1 found a place; expected fewer or smaller ones"
    )
