"""The AND/OR graph: what is free, what can leave, and the fewest removals against brute force."""

import itertools

from hypothesis import given
from hypothesis import strategies as st

from depal.domain import Approach
from depal.selection.access import Limits, Way, Ways, fewest_removals, mask_of, members
from depal.selection.access.closure import labelled, unavoidable
from depal.selection.access.program import solved
from depal.selection.access.removal import Proof

BOXES = 7

masks = st.integers(0, (1 << BOXES) - 1)


@st.composite
def and_or_graphs(draw: st.DrawFn, most: int = 3) -> Ways:
    """Any ways of up to seven boxes; rings, boxes without a way and free ones included."""
    count = draw(st.integers(1, BOXES))
    ways = []
    for box in range(count):
        for _ in range(draw(st.integers(0, most))):
            blockers = draw(masks) & ~(1 << box) & ((1 << count) - 1)
            thin = draw(masks)
            ways.append(Way(box, draw(st.sampled_from(Approach)), blockers & thin))
    return Ways.among(range(count), ways)


def brute(ways: Ways, wanted: int) -> int | None:
    """The size of the smallest set that can leave and holds the wanted boxes."""
    boxes = list(members(ways.present))
    for size in range(len(boxes) + 1):
        for chosen in itertools.combinations(boxes, size):
            mask = mask_of(chosen)
            if wanted & ~mask == 0 and ways.peeled(mask) == mask:
                return size
    return None


@given(and_or_graphs(), st.integers(0, BOXES - 1), st.integers(0, BOXES - 1))
def test_the_fewest_removals_are_those_of_brute_force(ways: Ways, one: int, other: int) -> None:
    """Rings, bridges and boxes that never leave included."""
    wanted = mask_of({one, other}) & ways.present
    found = fewest_removals(ways, wanted)
    least = brute(ways, wanted)
    if found is None:
        assert least is None
        return
    assert least is not None
    assert found.gap == 0
    assert found.boxes.bit_count() == found.bound == least
    assert ways.peeled(found.boxes) == found.boxes
    assert wanted & ~found.boxes == 0
    assert found.actions == found.least == least - wanted.bit_count()


@given(and_or_graphs(most=1))
def test_where_no_box_has_a_choice_the_closure_is_the_proof(ways: Ways) -> None:
    """No program is solved for it."""
    for box in members(ways.peeled()):
        found = fewest_removals(ways, 1 << box)
        assert found is not None
        assert found.proof is Proof.CLOSURE
        assert found.rounds == 0


@given(and_or_graphs(), st.integers(0, BOXES - 1))
def test_bounds_hold_the_answer_between_them(ways: Ways, box: int) -> None:
    """The unavoidable boxes below, the labelled ones above."""
    able = ways.peeled()
    if not able >> box & 1:
        return
    least = brute(ways, 1 << box)
    assert least is not None
    assert labelled(ways)[box][0].bit_count() >= least
    peeled = labelled(ways)[box][0]
    assert ways.peeled(peeled) == peeled
    if able == ways.present:
        assert unavoidable(ways, 1 << box).bit_count() <= least


@given(and_or_graphs(), masks)
def test_free_boxes_are_the_first_that_can_leave(ways: Ways, gone: int) -> None:
    """By definition: some way has no blocker left."""
    free = ways.free(gone)
    assert free & gone == 0
    assert free == ways.without(gone).free()
    for box in members(ways.present & ~gone):
        open_ways = [way for way in ways.of[box] if not way.blockers & ways.present & ~gone]
        assert bool(open_ways) == bool(free >> box & 1)


@given(and_or_graphs())
def test_no_way_needs_all_that_another_needs(ways: Ways) -> None:
    """Such ways are dropped when the graph is made."""
    for each in ways.of:
        for one, other in itertools.permutations(each, 2):
            assert one.blockers & other.blockers != other.blockers


def _ring() -> Ways:
    """Box 0 leaves by 1 and 2 or by 3, 4 and 5; 1 and 2 free one another, 2 also after 6."""
    way = Approach.VERTICAL
    return Ways.among(
        range(7),
        [
            Way(0, way, mask_of([1, 2])),
            Way(0, way, mask_of([3, 4, 5])),
            Way(1, way, mask_of([2])),
            Way(1, way, mask_of([3, 4, 5, 6])),
            Way(2, way, mask_of([1])),
            Way(2, way, mask_of([3, 6])),
            *(Way(box, way, 0) for box in (3, 4, 5, 6)),
        ],
    )


def test_boxes_do_not_justify_one_another_in_a_ring() -> None:
    """The program alone would take 1 and 2 for it."""
    found = fewest_removals(_ring(), 1)
    assert found is not None
    assert found.boxes == mask_of([0, 3, 4, 5])
    assert found.proof is Proof.PROGRAM


def test_a_search_that_is_stopped_says_how_far_it_is_from_proven() -> None:
    """Its bound never passes the optimum, 4."""
    ways = _ring()
    known, least = ways.present, 1
    for rounds in range(4):
        got = solved(ways, 1, known, least, Limits(rounds=rounds))
        assert ways.peeled(got.boxes) == got.boxes
        assert got.bound <= 4 <= got.boxes.bit_count()
    assert solved(ways, 1, known, least, Limits(rounds=50)).bound == 4


def test_a_program_without_an_answer_leaves_what_was_known() -> None:
    """Here the known set cannot leave at all."""
    way = Approach.VERTICAL
    ways = Ways.among(range(2), [Way(0, way, 2)])
    got = solved(ways, 1, 3, 1, Limits())
    assert (got.boxes, got.bound) == (3, 1)
