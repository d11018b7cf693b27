"""Several requests with due times: nothing beats the optimum, and the agenda comes close."""

from itertools import permutations

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from depal.domain import Approach
from depal.selection.access import Way, Ways
from depal.studies.due import DuePiece, Wanted, draw_pallet, due_rows, least_lateness, small_pallets
from depal.studies.due.runs import by_agenda, by_maximum, by_paper


@st.composite
def small_worlds(draw: st.DrawFn) -> tuple[Ways, list[Wanted]]:
    """Up to five boxes with any ways, and requests for some of them."""
    n = draw(st.integers(1, 5))
    masks = st.integers(0, (1 << n) - 1)
    ways = [
        Way(box, Approach.VERTICAL, draw(masks) & ~(1 << box))
        for box in range(n)
        for _ in range(draw(st.integers(1, 2)))
    ]
    wanted = [
        Wanted(box, draw(st.floats(0.1, 1.0)), 0, float(draw(st.integers(0, 5))))
        for box in draw(st.sets(st.integers(0, n - 1), min_size=1))
    ]
    return Ways.among(range(n), ways), wanted


@given(small_worlds())
def test_the_optimum_is_that_of_all_orders(world: tuple[Ways, list[Wanted]]) -> None:
    """By trying every one."""
    ways, wanted = world
    of = {each.box: each for each in wanted}
    found = []
    for order in permutations(range(len(ways.of))):
        gone, late, left = 0, 0.0, set(of)
        for count, box in enumerate(order, start=1):
            if not ways.free(gone) >> box & 1 or not left:
                break
            gone |= 1 << box
            late += of[box].late(count) if box in of else 0.0
            left.discard(box)
        if not left:
            found.append(late)
    least = least_lateness(ways, wanted)
    assert least == (pytest.approx(min(found)) if found else None)


@pytest.mark.parametrize("generator", ["guillotine", "dropped"])
def test_no_policy_of_access_is_below_the_optimum(generator: str) -> None:
    """Pallet by pallet, gaps or not."""
    piece = DuePiece(generator, 0.5, "start", 3, tuple(small_pallets(generator, 3, 4)), small=True)
    for index in piece.indices:
        pallet = draw_pallet(piece, index)
        least = least_lateness(pallet.ways, pallet.requests)
        assert least is not None
        for policy in (by_paper, by_maximum, by_agenda):
            late = policy(pallet)
            assert late is not None
            assert late >= least - 1e-9


@settings(max_examples=10, deadline=None)
@given(st.integers(0, 1_000), st.sampled_from(["start", "random"]))
def test_the_draw_keeps_to_its_rule(index: int, arrivals: str) -> None:
    """Three to eight requests for different boxes, due after they arrive, p above 0."""
    pallet = draw_pallet(DuePiece("guillotine", 0.0, arrivals, 5, (index,)), index)
    boxes = [each.box for each in pallet.requests]
    assert 3 <= len(set(boxes)) == len(boxes) <= 8
    for each in pallet.requests:
        assert 0 < each.priority <= 1
        assert 0 <= each.arrived < each.due
        assert arrivals == "random" or each.arrived == 0


def test_a_box_that_can_never_leave_leaves_the_pallet_out() -> None:
    """No policy serves it, and there is no optimum."""
    ring = Ways.among(range(2), [Way(0, Approach.VERTICAL, 0b10), Way(1, Approach.VERTICAL, 0b01)])
    assert least_lateness(ring, [Wanted(0, 1.0, 0, 0.0)]) is None


@pytest.mark.slow
def test_the_agenda_is_better_than_the_paper_and_close_to_the_optimum() -> None:
    """The issue's figures, on fewer pallets."""
    rows = due_rows(DuePiece("guillotine", 0.0, "random", 1, tuple(range(60))))
    assert [row.policy for row in rows] == ["paper", "maximum", "agenda"]
    assert rows[2].saved.ci95[0] > 0
    assert rows[2].above is None
    some = tuple(small_pallets("dropped", 1, 40))
    small = due_rows(DuePiece("dropped", 0.0, "start", 1, some, small=True))
    assert small[2].above is not None
    assert 0 <= small[2].above <= 0.05
