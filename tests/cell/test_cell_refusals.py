"""What no way leads to is tried again where something near it has changed, or nothing else is."""

from collections.abc import Sequence
from dataclasses import replace

from cells_at_work import Cell, Remembering, gtin, name, note, pile
from hypothesis import given
from hypothesis import strategies as st

from depal.cell.planning.plans import PickPlan
from depal.cell.refusals import NEAR, Refusals
from depal.domain import Detection, Grasp, Perceived, Recognition
from depal.geometry import Pose
from depal.ports import View

WHY = "the tool against the pallet"

spots = st.lists(st.floats(-1.5, 1.5), min_size=0, max_size=5)


def at(number: int, along: float, *, named: bool) -> Perceived:
    """A box so far from the first one, along the front [m]."""
    (first,) = pile(1)
    x, y, z = first.shape.centre
    shape = replace(first.shape, pose=Pose((x, y + along, z), first.shape.pose.rotation))
    return Recognition(name(number), shape, gtin(1)) if named else Detection(name(number), shape)


@given(before=spots, after=spots, named=st.booleans())
def test_a_refusal_holds_while_the_same_boxes_stand_near(
    *, before: Sequence[float], after: Sequence[float], named: bool
) -> None:
    """What stands farther off may come and go; a box that got a name is another neighbour."""
    cell, (box,) = Cell(1), pile(1, [1])
    refusals = Refusals()

    def see(others: Sequence[float], *, named: bool) -> set[tuple[int, bool]]:
        boxes = [at(k, along, named=named) for k, along in enumerate(others, start=2)]
        cell.work.pile.see(View(0.0, (box, *boxes), remembered=True))
        return {(k, named) for k, along in enumerate(others, start=2) if abs(along) < NEAR}

    near = see(before, named=False)
    assert refusals.still(box, cell.work.pile) is None
    refusals.keep(box, cell.work.pile, WHY)
    assert refusals.still(box, cell.work.pile) == WHY
    same = see(after, named=named) == near
    assert refusals.still(box, cell.work.pile) == (WHY if same else None)


def test_it_costs_no_second_plan_while_something_else_can_be_taken() -> None:
    """And is tried again as soon as nothing else can."""
    cell = Cell(3)
    cell.sight = Remembering([pile(3)])
    cell.work.ports = replace(cell.work.ports, sight=cell.sight)
    cell.work.delivery = note(3)
    tried = list[str]()
    plain = cell.desk.picking.try_pick

    def barred(box: Perceived, first: Grasp | None = None, *, only: bool = False) -> PickPlan | str:
        tried.append(box.id)
        if box.id == "b1" and len(cell.work.pile.boxes) > 1:
            return WHY
        return plain(box, first, only=only)

    cell.desk.picking.try_pick = barred  # type: ignore[method-assign]
    cell.works().assert_whole()
    assert tried == ["b1", "b3", "b2", "b1"]
    assert list(cell.fates) == ["b3", "b2", "b1"]
