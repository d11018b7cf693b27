"""What is refused now may be taken after another look; what the arm set out for is chosen anew."""

from dataclasses import replace
from unittest import mock

import pytest
from cells_at_work import PERSON, STORED, Cell, Remembering, name, pile
from hypothesis import given
from hypothesis import strategies as st

from depal.cell.choosing import VAIN, may_pass
from depal.cell.planning.picking import Picking
from depal.cell.planning.plans import PickPlan
from depal.domain import BoxId
from depal.ports import View


@given(st.integers(1, 3), st.sampled_from(("the tool against {}", "no reach; the arm against {}")))
def test_what_is_refused_for_a_neighbour_without_a_name_may_pass(other: int, words: str) -> None:
    """It may be named by the next look, or stand elsewhere; of a named one that is known."""
    cell = Cell(3, unknown=[2])
    work = cell.work
    first = pile(3, [2])[0]
    reason = words.format(name(other))
    for remembered in (False, True):
        work.pile.see(View(0.0, pile(3, [2]), remembered=remembered))
        assert may_pass(work, first, reason) == (remembered and other == 2)
    assert not may_pass(work, first, words.format(f"{name(2)}0"))


@pytest.mark.parametrize("refusals", [0, 1, 2, 9])
def test_where_there_is_no_way_any_more_the_box_is_chosen_anew(refusals: int) -> None:
    """A look between the choice and the reach may show its neighbours otherwise; not forever."""
    cell = Cell(1, unknown=[1])
    cell.sight = Remembering([pile(1, [1])])
    cell.work.ports = replace(cell.work.ports, sight=cell.sight)
    cell.reader.script = (("product-1",),) * 4
    planned, refused = Picking.pick, [True] * refusals

    async def pick(self: Picking, box: BoxId) -> PickPlan | str:
        plan = await planned(self, box)
        return "the tool against something" if refused and refused.pop() else plan

    with mock.patch.object(Picking, "pick", pick):
        cell.works().assert_whole()
    reached = [step for step in cell.started if "reach" in step]
    if refusals < VAIN:
        assert cell.fates == {"b1": STORED}
        assert reached == ["kr60_reach(b1)"] * (refusals + 1)
    else:
        assert cell.fates == {"b1": PERSON}
        assert reached == ["kr60_reach(b1)"] * VAIN
