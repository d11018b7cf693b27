"""A tool that comes down on a box that is higher than it looked stops where its cups touch it."""

import math
from collections.abc import Sequence
from dataclasses import replace

import pytest
from cells_at_work import DECK, PERSON, SIZE, STORED, Cell, Remembering, name

from depal.domain import Detection
from depal.executive import events as ev
from depal.geometry import OrientedBox
from depal.motion.kinematics import Kinematics
from depal.motion.moves.margins import LIFT
from depal.ports import View

PRESSES = -9.0
"""What the load cell reads while cups are pressed in [kg]."""


class Higher:
    """A cell with one box without a name, which is higher than it was seen.

    Attributes:
        cell: at work.
        lowest: how deep the flange was beyond where the cups first touched, before they held [m].
        beyond: how much longer the held box was believed to be, upright, at the most [m].
        lifted: how far above where its cups had sealed the box was weighed [m].
    """

    def __init__(self, more: float, *, brushing: bool = False) -> None:
        """So much higher [m]; its bellows may brush over something until it is above the box."""
        self.cell = cell = Cell(1, unknown=[1])
        low = OrientedBox.upright((1.55, -0.45, DECK + SIZE[2] / 2), SIZE)
        cell.sight = Remembering([(Detection(name(1), low),)])
        cell.work.ports = replace(cell.work.ports, sight=cell.sight)
        cell.arm.hanging = self._load
        cell.reader.script = (("product-1",),) * 8
        self._flange = Kinematics(cell.layout.robot).flange
        self._more, self.lowest, self.beyond = more, 0.0, 0.0
        self._brushing = brushing
        self.lifted = math.nan

    def _load(self) -> float:
        held = self.cell.gripper.load()
        if self.cell.work.held is not None:
            self.beyond = max(self.beyond, self.cell.work.held.beyond[2])
        elif held:
            self.lifted = self.lowest - self._deep()
        if held:
            return held
        deep = self._deep()
        self.lowest = max(self.lowest, deep)
        brushes = self._brushing and deep < -0.15
        return PRESSES if deep > 0.0 or brushes else 0.0

    def _deep(self) -> float:
        """How far the cups are pressed in, of a flange that points down over the box [m]."""
        plan = self.cell.desk.promises.pick_of(name(1))
        if plan is None:
            return -math.inf
        here = self._flange(self.cell.arm.at).translation
        there = self._flange(plan.pick.approach[-1].path[-1]).translation
        if math.dist(here[:2], there[:2]) > 0.01:
            return -math.inf
        return there[2] + self._more + 0.01 - here[2]


@pytest.mark.parametrize("more", [0.0, 0.012, 0.02, 0.05])
def test_the_tool_stops_where_its_cups_touch_and_the_box_is_taken(more: float) -> None:
    """Its bellows give by 2 cm; what is higher is carried with room for that."""
    higher = Higher(more)
    higher.cell.works().assert_whole()
    assert higher.cell.fates == {"b1": STORED}
    assert 0.0 < higher.lowest < 0.018
    assert higher.lifted > LIFT - 0.005 - 1e-4
    if more > 0.02:
        assert higher.beyond > more - 0.01


def test_what_stands_far_above_a_box_is_backed_off_from() -> None:
    """Nobody has seen it; the box is left to a person after a few tries, and nothing is pressed."""
    higher = Higher(0.085)
    higher.cell.works()
    assert higher.cell.blunders == []
    assert higher.cell.fates == {"b1": PERSON}
    assert higher.lowest < 0.018
    ends = [event for event in higher.cell.events if isinstance(event, ev.Ended)]
    assert any("above box b1" in end.reason for end in ends)


def test_bellows_that_brush_over_something_on_the_way_do_not_stop_the_tool() -> None:
    """On the way it passes closely over what it knows; only the last straight part is felt."""
    higher = Higher(0.0, brushing=True)
    higher.cell.works().assert_whole()
    assert higher.cell.fates == {"b1": STORED}
    assert [step for step in higher.cell.started if "reach" in step] == ["kr60_reach(b1)"]


class Renaming(Remembering):
    """A sight that calls what stands there otherwise once somebody has tried to take it."""

    grips: Sequence[object] = ()

    async def look(self) -> View:
        """The first name, or the second."""
        self.looks = min(len(self.grips), 1)
        return await Remembering.look(self)


def test_what_is_not_seen_any_more_after_a_try_is_passed_over() -> None:
    """It goes by another name since: nobody looks for it again and again."""
    cell = Cell(1, unknown=[1])
    cell.gripper.breaks = dict.fromkeys(range(4), 0.0)
    box = Detection(name(1), OrientedBox.upright((1.55, -0.45, DECK + SIZE[2] / 2), SIZE))
    cell.sight = Renaming([(box,), (replace(box, id=name(2)),)])
    cell.sight.grips = cell.gripper.grips
    cell.work.ports = replace(cell.work.ports, sight=cell.sight)
    cell.reader.script = (("product-1",),) * 8
    cell.works()
    assert cell.blunders == []
    assert cell.fates == {"b2": STORED}
    assert [step for step in cell.started if "reach" in step] == [
        "kr60_reach(b1)",
        "kr60_reach(b1)",
        "kr60_reach(b2)",
    ]
