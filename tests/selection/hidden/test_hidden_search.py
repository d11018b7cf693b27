"""What to remove first for a box that nobody has seen."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from depal.domain import Approach
from depal.selection import EXACT
from depal.selection.access import Way, Ways, free_ways, mask_of, members
from depal.selection.hidden import NOBODY, Region, Scene, View, best_set, owners_of, sought
from depal.studies.hidden import Looks
from depal.studies.pallets import RandomPallet, generator_named

pallets = st.builds(
    lambda kind, seed: generator_named(kind)(np.random.default_rng(seed)),
    st.sampled_from(["guillotine", "columns", "dropped"]),
    st.integers(0, 10_000),
)

needs = st.lists(
    st.tuples(st.integers(0, 63), st.floats(0.01, 1.0)), min_size=1, unique_by=lambda each: each[0]
)


@given(needs)
def test_no_set_of_a_place_is_worth_more_per_box(listed: list[tuple[int, float]]) -> None:
    """Probability per box, over all that are asked for."""
    found = best_set(listed)
    total = sum(mass for _, mass in listed)
    sets = [boxes for boxes, _ in listed if boxes]

    def held(boxes: int) -> float:
        return sum(mass for each, mass in listed if each and each & ~boxes == 0) / total

    if not sets:
        assert found.boxes == 0
        return
    assert found.boxes in sets
    assert found.probability == pytest.approx(held(found.boxes))
    best = max(held(boxes) / boxes.bit_count() for boxes in sets)
    assert found.probability / found.boxes.bit_count() == pytest.approx(best)


@settings(max_examples=20)
@given(pallets, st.integers(0, 43))
def test_what_is_sought_first_can_leave(pallet: RandomPallet, pick: int) -> None:
    """One after the other, whatever else stays."""
    looks = Looks.first(pallet.prisms)
    unseen = [box for box in range(len(pallet)) if not looks.seen >> box & 1]
    if not unseen:
        return
    length, width, height = pallet.sizes[unseen[pick % len(unseen)]].tolist()
    ways = free_ways(pallet.prisms, EXACT, list(members(looks.seen)))
    found = sought(looks.scene(), (length, width, height), pallet.prisms, ways)
    if found is None:
        return
    assert found.boxes & ~looks.seen == 0
    assert ways.peeled(found.boxes) == found.boxes
    assert 0 < found.probability <= 1 + 1e-9
    assert found.expected >= 0


def test_a_box_behind_a_wall_is_sought_behind_it() -> None:
    """The only room is behind the front box: it goes first, for certain."""
    region = Region((0.0, 0.0, 0.0), (0.8, 0.4, 0.4))
    front = [0.2, 0.2, 0.2, 0.2, 0.2, 0.2, 1.0, 0.0]
    lid = [0.6, 0.2, 0.36, 0.2, 0.2, 0.04, 1.0, 0.0]
    prisms = np.array([front, lid])
    owners = owners_of(region, prisms, [0, 1])
    view = View.of(owners)
    scene = Scene(region, owners, view.passed, view)
    open_ways = Ways.among([0, 1], [Way(0, Approach.HORIZONTAL, 0), Way(1, Approach.VERTICAL, 0)])
    found = sought(scene, (0.4, 0.4, 0.32), prisms, open_ways)
    assert found is not None
    assert found.boxes in {0b01, 0b10}
    assert found.probability == pytest.approx(1)
    assert found.expected == pytest.approx(1)


def test_what_fits_nowhere_or_waits_for_ever_is_not_sought() -> None:
    """A box too large for the room; and one behind boxes that nothing can take."""
    region = Region((0.0, 0.0, 0.0), (0.8, 0.4, 0.4))
    prisms = np.array(
        [[0.2, 0.2, 0.2, 0.2, 0.2, 0.2, 1.0, 0.0], [0.6, 0.2, 0.36, 0.2, 0.2, 0.04, 1.0, 0.0]]
    )
    owners = owners_of(region, prisms, [0, 1])
    view = View.of(owners)
    scene = Scene(region, owners, view.passed, view)
    open_ways = Ways.among([0, 1], [Way(0, Approach.HORIZONTAL, 0), Way(1, Approach.VERTICAL, 0)])
    shut = Ways.among([0, 1], [])
    assert sought(scene, (0.4, 0.4, 0.38), prisms, open_ways) is None
    assert sought(scene, (0.4, 0.4, 0.32), prisms, shut) is None
    assert mask_of([0, 1]) == shut.present
    assert (owners != NOBODY).any()
