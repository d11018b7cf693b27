"""Two cartons that were seen as one are told by their weight, and seen as two at the next look."""

import asyncio
from dataclasses import dataclass, replace

import pytest
from cells_at_work import DECK, PERSON, STORED, Cell, Remembering, gtin, name
from hypothesis import given, settings
from hypothesis import strategies as st

from depal.cell.choosing import NO_TOP
from depal.cell.departures import Fate
from depal.cell.feedback import Feedback
from depal.domain import (
    EURO_PALLET,
    Cup,
    Delivery,
    DeliveryLine,
    Detection,
    Gtin,
    Product,
    Recognition,
)
from depal.geometry import OrientedBox
from depal.ports.fakes import FakeGripper, FakeReader

TORN_AFTER = 0.4
"""After the valves were opened the arm lifts what it holds by then [s]."""

LOW, HIGH = (0.28, 0.25, 0.19), (0.56, 0.25, 0.22)


@dataclass(slots=True)
class Tearing(FakeGripper):
    """One of six cups loses its hold in the lift, in the first grips.

    Attributes:
        tears: in so many.
        opened: when the valves were opened last [s].
    """

    tears: int = 0
    opened: float = 0.0

    async def suck(self, cups: tuple[Cup, ...]) -> bool:
        """Makes vacuum."""
        self.opened = asyncio.get_running_loop().time()
        return await FakeGripper.suck(self, cups)

    def vacuum(self) -> dict[str, float]:
        """An open cup that leaks costs the whole module."""
        now, left = asyncio.get_running_loop().time(), 1.0
        if len(self.grips) <= self.tears and now > self.opened + TORN_AFTER:
            left = 5 / 5.6
        return {name: left * value for name, value in FakeGripper.vacuum(self).items()}


def seen_as_one(
    weight: float, gripper: FakeGripper | None = None, *, named: bool = False
) -> tuple[Cell, list[OrientedBox]]:
    """Two low cartons side by side look like a high one; what perception is told."""
    shape = OrientedBox.upright((1.55, 0.0, DECK + 0.11), (0.25, 0.56, 0.22))
    box = Recognition(name(1), shape, Gtin("high")) if named else Detection(name(1), shape)
    cell = Cell(1, gripper=gripper or FakeGripper(weight=weight))
    told: list[OrientedBox] = []
    cell.sight = Remembering([(box,)])
    cell.work.ports = replace(cell.work.ports, sight=cell.sight)
    cell.work.feedback = Feedback(part=told.append)
    products = [Product(Gtin("low"), "low", LOW, 4.0), Product(Gtin("high"), "high", HIGH, 12.0)]
    lines = tuple(DeliveryLine(each, 2) for each in products)
    cell.work.delivery = Delivery("two", EURO_PALLET, lines)
    return cell.works(), told


@settings(max_examples=4)
@given(st.floats(7.5, 8.5))
def test_what_weighs_and_looks_like_two_is_put_back_and_its_face_is_none(weight: float) -> None:
    """Twice: then it is one of another weight. The place under the cups lies within the face."""
    cell, told = seen_as_one(weight)
    grasps = [step for step in cell.started if step.startswith("kr60_grasp")]
    assert len(grasps) == 3
    assert len(told) == 2
    for place in told:
        low, high = place.corners.min(axis=0), place.corners.max(axis=0)
        assert -0.28 <= low[1] < 0.0 < high[1] <= 0.28
    assert cell.fates[name(1)] is not Fate.STORED


def test_what_weighs_more_than_any_box_of_its_size_and_like_two_has_a_seam() -> None:
    """Two cartons side by side look like one of them that is turned."""
    cell, told = seen_as_one(24.0)
    assert len(told) == 1
    assert len([step for step in cell.started if step.startswith("kr60_grasp")]) == 1


def test_a_name_does_not_make_one_box_of_what_weighs_like_two() -> None:
    """The print is that of one of them; the face that was believed reaches over both."""
    cell, told = seen_as_one(24.0, named=True)
    assert len(told) >= 1
    assert cell.fates.get(name(1)) is not Fate.STORED


def test_what_weighs_like_one_is_one() -> None:
    """Nothing is put back, and perception is told nothing."""
    cell, told = seen_as_one(12.0)
    assert told == []
    assert len([step for step in cell.started if step.startswith("kr60_grasp")]) == 1


@pytest.mark.parametrize("tears", [0, 1, 2])
def test_what_hangs_on_some_of_the_cups_that_had_sealed_is_put_back(tears: int) -> None:
    """It is held beside its middle; there is a seam under the cups."""
    cell, told = seen_as_one(12.0, Tearing(weight=12.0, tears=tears))
    assert len(told) == tears
    assert len([step for step in cell.started if step.startswith("kr60_grasp")]) == tears + 1


class Stuck(FakeGripper):
    """Whatever it holds does not come up: the hold breaks in the lift."""

    def vacuum(self) -> dict[str, float]:
        """Nothing is left, soon after the valves were opened."""
        holds = asyncio.get_running_loop().time() < self.opened + TORN_AFTER
        return {each: value * holds for each, value in FakeGripper.vacuum(self).items()}

    opened = 0.0

    async def suck(self, cups: tuple[Cup, ...]) -> bool:
        """Makes vacuum."""
        self.opened = asyncio.get_running_loop().time()
        return await FakeGripper.suck(self, cups)


def test_a_box_that_does_not_come_up_is_torn_at_twice_and_not_more() -> None:
    """It may be the free strip of one that something stands on."""
    cell, _ = seen_as_one(12.0, Stuck(weight=12.0))
    assert len([step for step in cell.started if step.startswith("kr60_grasp")]) == 2
    assert cell.fates.get(name(1)) is not Fate.STORED


@dataclass(slots=True)
class Leaking(FakeGripper):
    """Of the cups some seal and others do not, in the first grips.

    Attributes:
        leaks: in so many.
    """

    leaks: int = 0

    async def suck(self, cups: tuple[Cup, ...]) -> bool:
        """Makes some vacuum."""
        return await FakeGripper.suck(self, cups) and len(self.grips) > self.leaks

    def load(self) -> float:
        """Nothing hangs on cups that leak."""
        return FakeGripper.load(self) if len(self.grips) > self.leaks else 0.0


@pytest.mark.parametrize(
    ("leaks", "width", "fate"), [(1, 0.42, STORED), (2, 0.27, STORED), (2, 0.42, PERSON)]
)
def test_a_long_box_on_whose_top_cups_leak_twice_is_left_to_a_person(
    leaks: int, width: float, fate: Fate
) -> None:
    """Its front is a part of a longer one, and it would hang beside its middle (dev-006).

    Of one that is about as long as it is broad that would make no difference.
    """
    size = (0.25, width, 0.22)
    shape = OrientedBox.upright((1.55, 0.0, DECK + 0.11), size)
    cell = Cell(1, gripper=Leaking(leaks=leaks), reader=FakeReader((("product-1",),) * 8))
    cell.sight = Remembering([(Detection(name(1), shape),)])
    cell.work.ports = replace(cell.work.ports, sight=cell.sight)
    line = DeliveryLine(Product(gtin(1), "carton", (width, 0.25, 0.22), 4.0), 1)
    cell.work.delivery = Delivery("one", EURO_PALLET, (line,))
    assert cell.works().fates == {name(1): fate}
    reasons = {each.reason for each in cell.work.departures.sequence}
    assert reasons == {NO_TOP if fate is PERSON else ""}
    grasps = [step for step in cell.started if step.startswith("kr60_grasp")]
    assert len(grasps) == (2 if fate is PERSON else leaks + 1)
