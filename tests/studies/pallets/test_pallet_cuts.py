"""Cuts, heights and shares, below the generators that use them."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from depal.errors import SettingError
from depal.studies.pallets.cuts import across, cut_in_height, cut_up
from depal.studies.pallets.draws import BLOCK, dealt, uniforms
from depal.studies.pallets.lattice import TICK, ticks_above, ticks_below

seeds = st.integers(min_value=0, max_value=2**32 - 1)
few = settings(max_examples=50, deadline=None)


@few
@given(seed=seeds, length=st.integers(10, 2000), width=st.integers(10, 2000))
def test_a_layer_is_cut_through_its_longer_side(seed: int, length: int, width: int) -> None:
    """At .3 to .7 of it; the whole is left as it was."""
    whole = [0, 0, 0, length, width, 1]
    near, far = cut_up(whole, 2, across(uniforms(np.random.default_rng(seed))), least=1)
    axis = 0 if length > width else 1
    assert whole == [0, 0, 0, length, width, 1]
    assert near[axis + 3] == far[axis]
    assert 0.3 * whole[axis + 3] - 1 <= far[axis] <= 0.7 * whole[axis + 3]
    assert (near[4 - axis], far[4 - axis]) == (whole[4 - axis], whole[4 - axis])


def test_cuts_end_when_none_is_possible_any_more() -> None:
    """The message counts the boxes that there are."""
    half = ticks_above(0.5)
    whole = [0, 0, 0, ticks_below(0.9), ticks_below(0.9), half]
    with pytest.raises(SettingError) as error:
        cut_up(whole, 3, across(uniforms(np.random.default_rng(0))), half)
    assert str(error.value) == (
        "count: of 3 boxes only 1 could be cut; expected fewer boxes, or sides below 0.5 m"
    )


@few
@given(seed=seeds, count=st.integers(1, 20), spare=st.integers(0, 10**12))
def test_heights_fill_the_whole_and_none_is_too_low(seed: int, count: int, spare: int) -> None:
    """Even when there is nothing to spare."""
    least, bottom = 1000, 77
    whole = [1, 2, bottom, 3, 4, bottom + count * least + spare]
    boxes = cut_in_height(whole, count, uniforms(np.random.default_rng(seed)), least)
    assert len(boxes) == count
    assert [box[2] for box in boxes] == [bottom, *(box[5] for box in boxes[:-1])]
    assert boxes[-1][5] == whole[5]
    assert all(box[5] - box[2] >= least for box in boxes)
    assert all(box[:2] + box[3:5] == [1, 2, 3, 4] for box in boxes)


@few
@given(seed=seeds, parts=st.integers(1, 12), most=st.integers(1, 9), fullness=st.floats(0.0, 1.0))
def test_everything_is_dealt_and_no_part_is_empty_or_too_full(
    seed: int, parts: int, most: int, fullness: float
) -> None:
    """Up to the point where every part is full."""
    count = parts + int(fullness * parts * (most - 1))
    shares = dealt(uniforms(np.random.default_rng(seed)), count, parts, most)
    assert len(shares) == parts
    assert sum(shares) == count
    assert all(1 <= share <= most for share in shares)


def test_numbers_come_in_the_order_of_the_generator() -> None:
    """Block after block, none left out."""
    draw = uniforms(np.random.default_rng(8))
    expected = np.random.default_rng(8).random(3 * BLOCK)
    assert [draw() for _ in range(3 * BLOCK)] == expected.tolist()


@few
@given(length=st.floats(0.0, 100.0))
def test_a_length_lies_between_its_ticks(length: float) -> None:
    """Ticks become metres without rounding."""
    below, above = ticks_below(length), ticks_above(length)
    assert below * TICK <= length <= above * TICK
    assert above - below <= 1
