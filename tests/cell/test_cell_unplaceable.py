"""A box that turns out to be another than was seen: nobody knows how it hangs, or where it ends."""

from collections.abc import Sequence
from dataclasses import replace
from unittest import mock

from cells_at_work import PERSON, STORED, Cell, Remembering, gtin, name, note, pile
from hypothesis import given, settings
from hypothesis import strategies as st

from depal.cell.departures import Fate
from depal.cell.planning.carrying import Carrying
from depal.cell.planning.loads import UNSURE, WARY, hangs_as_thought, load_of
from depal.cell.planning.plans import CarryPlan
from depal.cell.workplace import Held, Workplace
from depal.domain import Approach, BoxId, Grasp, PlaceId
from depal.geometry import Pose
from depal.ports import View

ABOVE = Pose((0.0, 0.0, 0.3))

OTHER = (0.16, 0.39, 0.32)
"""What the first box really is [m]."""


def seen_wrongly() -> Cell:
    """Three boxes; the first is as large as the others where it was seen, and is another."""
    cell = Cell(3, unknown=[1])
    cell.sight = Remembering([pile(3, [1])])
    cell.work.ports = replace(cell.work.ports, sight=cell.sight)
    first, *others = note(3).lines
    line = replace(first, product=replace(first.product, size=OTHER))
    cell.work.delivery = replace(note(3), lines=(line, *others))
    cell.reader.script = ((gtin(1),),) * 4
    cell.person.delay = 100.0
    return cell


def test_a_person_takes_it_out_of_the_gripper_and_nothing_moves_before() -> None:
    """It comes into no place, not even the one for exceptions."""
    cell = seen_wrongly().works()
    assert cell.blunders == []
    assert cell.fates == {"b1": PERSON, "b2": STORED, "b3": STORED}
    assert "product product-1 is 160 x 390 x 320 mm" in cell.person.asked[0].text


def held(mass: float, beyond: float = 0.0) -> Held:
    """The first box, in a gripper."""
    grasp = Grasp(Approach.VERTICAL, folded=False, box_from_flange=ABOVE, cups=(("lower", 0),))
    return Held(name(1), grasp, pile(1)[0].shape.size, mass, (beyond, 0.0, 0.0))


@settings(max_examples=20)
@given(
    st.floats(0.5, 20.0),
    st.just(0.0) | st.floats(0.0, 0.2),
    st.integers(0, 2),
    st.frozensets(st.sampled_from(Approach)),
)
def test_what_weighs_like_nothing_of_its_size_or_may_be_longer_or_let_go_moves_slowly(
    mass: float, beyond: float, tries: int, failed: frozenset[Approach]
) -> None:
    """Its middle is not where it was thought to be; a sight that is exact leaves no doubt.

    At a face where cups have not failed it is held as well as any.
    """
    cell = Cell(1, unknown=[1])
    cell.work.held = held(mass, beyond)
    cell.work.tries[name(1)] = tries
    cell.work.doubted[name(1)] = failed
    with mock.patch.object(Workplace, "product_of", return_value=None):
        assert hangs_as_thought(cell.work.held, cell.work)
        cell.work.pile.see(View(0.0, pile(1, [1]), remembered=True))
        load = load_of(name(1), cell.work, None)
    sure = (
        abs(mass - 4.0) <= 0.6 and beyond <= 0.04 and (not tries or failed == {Approach.HORIZONTAL})
    )
    assert load is not None
    sharply = 1.0 if beyond == 0.0 else WARY
    assert load.pace == (sharply if sure else UNSURE)


@settings(max_examples=20)
@given(beyond=st.floats(0.0, 0.04), told=st.booleans())
def test_what_a_print_or_a_code_has_told_moves_as_fast_as_any_where_it_is_seen_closely(
    *, beyond: float, told: bool
) -> None:
    """Its middle is where it should be, to a centimetre."""
    cell = Cell(1, unknown=[1])
    cell.work.held = held(4.0, beyond)
    cell.work.pile.see(View(0.0, pile(1, [1]), remembered=True))
    product = note(1).lines[0].product if told else None
    with mock.patch.object(Workplace, "product_of", return_value=product):
        load = load_of(name(1), cell.work, None)
    assert load is not None
    assert load.pace == (1.0 if beyond == 0.0 or (told and beyond <= 0.01) else WARY)


def test_from_where_a_person_has_taken_a_box_out_of_the_gripper_the_arm_gets_clear() -> None:
    """Among others, no place takes the box: before the next look the arm stands in the open."""
    cell = Cell(2)
    find, stands = Carrying.find_place, list[bool]()

    async def none_for_the_first(
        carrying: Carrying, box: BoxId, places: Sequence[PlaceId]
    ) -> CarryPlan | str:
        return "no room" if box == name(1) else await find(carrying, box, places)

    def in_the_open() -> bool:
        return not list(cell.desk.clearing.ways_out())

    ended = Workplace.ended

    def ending(work: Workplace, box: BoxId, fate: Fate, *rest: PlaceId, **more: str) -> None:
        if fate is Fate.BY_PERSON:
            stands.append(in_the_open())
        ended(work, box, fate, *rest, **more)

    with (
        mock.patch.object(Carrying, "find_place", none_for_the_first),
        mock.patch.object(Workplace, "ended", ending),
    ):
        cell.works().assert_whole()
    assert cell.fates == {"b1": PERSON, "b2": STORED}
    assert "Please take it out of the gripper" in cell.person.asked[0].text
    assert stands == [True]
