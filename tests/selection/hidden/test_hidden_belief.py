"""The belief over unseen volume: what is possible stays possible, and all of it sums to 1."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from depal.errors import SettingError
from depal.selection.hidden import (
    NOBODY,
    SHARE,
    Belief,
    Region,
    Scene,
    View,
    believed,
    owners_of,
    placements,
    shares_seen,
    window_of,
)
from depal.selection.hidden.belief import flushness
from depal.studies.pallets import SIZE, X_MAX, X_NEAR, RandomPallet, generator_named

REGION = Region((X_NEAR, -SIZE[1] / 2, 0.0), (X_MAX, SIZE[1] / 2, SIZE[2]))

pallets = st.builds(
    lambda kind, seed: generator_named(kind)(np.random.default_rng(seed)),
    st.sampled_from(["guillotine", "layered", "cubic", "columns", "dropped"]),
    st.integers(0, 10_000),
)


def scene_of(pallet: RandomPallet) -> tuple[Scene, np.ndarray[tuple[int], np.dtype[np.bool_]]]:
    """What the first look shows, and which boxes are seen."""
    owners = owners_of(REGION, pallet.prisms, range(len(pallet)))
    view = View.of(owners)
    seen = shares_seen(owners, view, len(pallet)) >= SHARE
    known = np.where((owners != NOBODY) & seen[np.maximum(owners, 0)], owners, NOBODY)
    return Scene(REGION, known, view.passed, view), seen


@settings(max_examples=20)
@given(pallets)
def test_no_cell_is_both_passed_by_sight_and_taken(pallet: RandomPallet) -> None:
    """What a line of sight has passed is empty."""
    owners = owners_of(REGION, pallet.prisms, range(len(pallet)))
    view = View.of(owners)
    assert not (view.passed & (owners != NOBODY)).any()
    assert ((view.front == NOBODY) == (owners == NOBODY).all(axis=0)).all()
    assert ((view.top == NOBODY) == (owners == NOBODY).all(axis=2)).all()


@settings(max_examples=20)
@given(pallets, st.data())
def test_a_belief_sums_to_1_and_its_region_holds_what_it_says(
    pallet: RandomPallet, data: st.DataObject
) -> None:
    """Every place is within the region, clear of seen boxes and of what is known to be empty."""
    scene, seen = scene_of(pallet)
    box = data.draw(st.integers(0, len(pallet) - 1))
    length, width, height = pallet.sizes[box].tolist()
    belief = believed(scene, (length, width, height), pallet.prisms[seen])
    if not len(belief.mass):
        assert seen[box]
        return
    assert belief.mass.min() >= 0
    assert belief.mass.sum() == pytest.approx(1)
    held = belief.region_holding(0.8)
    assert float(held @ belief.mass) == pytest.approx(0.8)
    assert ((held > 0) & (held < 1)).sum() <= 1
    for first, span in zip(belief.placements.first, belief.placements.spans, strict=True):
        low, high = first, first + span
        assert (low >= 0).all()
        assert (high <= scene.region.shape).all()
        inside = np.s_[low[0] : high[0], low[1] : high[1], low[2] : high[2]]
        assert (scene.owners[inside] == NOBODY).all()
        assert not scene.empty[inside].any()


@settings(max_examples=20)
@given(pallets.filter(lambda pallet: len(pallet) > 0), st.integers(0, 43))
def test_a_wider_region_holds_the_narrower_one(pallet: RandomPallet, pick: int) -> None:
    """Share by share."""
    scene, seen = scene_of(pallet)
    length, width, height = pallet.sizes[pick % len(pallet)].tolist()
    belief = believed(scene, (length, width, height), pallet.prisms[seen])
    if len(belief.mass):
        assert (belief.region_holding(0.5) <= belief.region_holding(0.8)).all()


@settings(max_examples=15)
@given(st.sampled_from(["guillotine", "layered", "cubic", "columns"]), st.integers(0, 10_000))
def test_the_truth_is_among_the_places(kind: str, seed: int) -> None:
    """In pallets without gaps, of every box that the first look does not show."""
    pallet = generator_named(kind)(np.random.default_rng(seed))
    scene, seen = scene_of(pallet)
    for box in np.flatnonzero(~seen):
        length, width, height = pallet.sizes[box].tolist()
        found = placements(scene, (length, width, height))
        span = window_of(REGION, pallet.sizes[box])
        first = np.rint((pallet.centres[box] - REGION.low) / REGION.cell - span / 2)
        assert ((found.first == first) & (found.spans == span)).all(axis=1).any()


def test_a_square_base_is_not_turned() -> None:
    """A quarter turn changes nothing, and would count every place twice."""
    region = Region((0.0, 0.0, 0.0), (0.4, 0.4, 0.4))
    nobody = np.full(region.shape, NOBODY, np.intp)
    nothing = np.zeros(region.shape, np.bool_)
    wall = nobody.copy()
    wall[0], wall[:, :, -1] = 0, 0
    view = View.of(wall)
    scene = Scene(region, wall, nothing, view)
    found = placements(scene, (0.2, 0.2, 0.2))
    assert len(np.unique(found.first, axis=0)) == len(found) > 0
    turned = placements(scene, (0.2, 0.12, 0.2))
    assert {tuple(size) for size in turned.sizes.tolist()} == {(0.2, 0.12, 0.2), (0.12, 0.2, 0.2)}


def test_a_box_outside_the_region_is_nowhere_in_it() -> None:
    """And no share of it is seen."""
    region = Region((0.0, 0.0, 0.0), (0.4, 0.4, 0.4))
    prisms = np.array([[0.2, 0.2, 2.0, 0.1, 0.1, 0.1, 1.0, 0.0]])
    owners = owners_of(region, prisms, [0])
    assert (owners == NOBODY).all()
    assert shares_seen(owners, View.of(owners), 1).tolist() == [0.0]


def test_a_turned_box_fills_about_its_volume() -> None:
    """Cells whose centres lie in it."""
    region = Region((0.0, 0.0, 0.0), (1.0, 1.0, 1.0))
    angle = 0.5
    prisms = np.array([[0.5, 0.5, 0.5, 0.3, 0.2, 0.2, np.cos(angle), np.sin(angle)]])
    filled = (owners_of(region, prisms, [0]) == 0).mean()
    assert filled == pytest.approx(8 * 0.3 * 0.2 * 0.2, rel=0.05)


def test_a_pile_is_flush_when_its_boxes_touch_sideways() -> None:
    """None of no boxes, none apart, all of two side by side."""
    beside = np.array(
        [[0.0, 0.0, 0.1, 0.1, 0.1, 0.1, 1.0, 0.0], [0.0, 0.2, 0.1] + [0.1] * 3 + [1, 0]]
    )
    apart = beside + np.array([[0.0] * 8, [0.0, 0.05] + [0.0] * 6])
    assert flushness(beside[:0]) == 0
    assert flushness(apart) == 0
    assert flushness(beside) == 1


def test_a_region_without_volume_is_refused() -> None:
    """Low must be below high."""
    with pytest.raises(SettingError, match="region"):
        Region((0.0, 0.0, 0.0), (1.0, 0.0, 1.0))


def test_the_region_of_a_certain_belief_is_a_part_of_its_place() -> None:
    """80 % of a place that has all."""
    assert Belief.region_of(np.array([0.0, 1.0]), 0.8).tolist() == [0.0, 0.8]
