"""What the gripper feels tells where one box ends."""

from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np
import numpy.typing as npt
from cells_at_work import Cell, pile
from hypothesis import given, settings
from hypothesis import strategies as st

from depal.cell.guards import Guards
from depal.cell.planning.picking import SHORT
from depal.cell.planning.plans import PickPlan
from depal.cell.primitives.feeling import sucked
from depal.domain import Approach, Cup
from depal.executive.clock import run_simulated
from depal.geometry import OrientedBox
from depal.motion.kinematics import Kinematics
from depal.ports import View

STROKE = 0.010
"""Of the bellows, before and behind the plane of touch [m]."""

Floats = npt.NDArray[np.float64]


def bounds(box: OrientedBox) -> tuple[Floats, Floats]:
    """Lower and upper corner."""
    return box.corners.min(axis=0), box.corners.max(axis=0)


def test_what_is_under_the_cups_is_flat_and_lies_on_the_face_that_is_held() -> None:
    """In the plane of touch, and nowhere beyond the face, however the box is held."""
    cell = Cell(1)
    (box,) = pile(1)
    cell.work.pile.see(View(0.0, (box,)))
    least, most = bounds(box.shape)
    held = 0
    for way in cell.desk.picking.offered(box)[:4]:
        plan = cell.desk.picking.try_pick(box, way, only=True)
        if isinstance(plan, str):
            continue
        held += 1
        cell.arm.at = plan.lift.start
        place = cell.desk.feeling.under_cups(plan)
        low, high = bounds(place)
        assert min(place.size) < 0.01
        assert (low > least - 0.003).all()
        assert (high < most + 0.003).all()
    assert held


class BeforeAFront:
    """A box that no print has named, and its front nearer or farther than it looks.

    Attributes:
        cell: at work.
        plan: to hold the box from the front.
        deepest: how far the tool went beyond the front, with its plane of touch [m].
    """

    def __init__(self, nearer: float, *, leaks: bool = False) -> None:
        """So much [m]; and whether one of the cups never seals."""
        self.cell = cell = Cell(1, unknown=[1])
        (box,) = pile(1, [1])
        cell.work.pile.see(View(0.0, (box,), remembered=True))
        offered = cell.desk.picking.offered(box)
        ways = [each for each in offered if each.approach is Approach.HORIZONTAL]
        plans = [cell.desk.picking.try_pick(box, way, only=True) for way in ways]
        self.plan = next(plan for plan in plans if isinstance(plan, PickPlan))
        self._flange = Kinematics(cell.layout.robot).flange
        self._nearer, self._leaks = nearer, leaks
        self._sealed, self.deepest = False, -1.0
        ports = cell.work.ports
        cell.work.ports = replace(ports, gripper=self)
        cell.arm.at = self.plan.approach.end

    def _beyond(self) -> float:
        """How far the plane of touch is beyond where the front looks [m]."""
        here = self._flange(self.cell.arm.at).translation
        there = self._flange(self.plan.pick.approach[-1].path[-1]).translation
        begin = self._flange(self.plan.pick.approach[-1].path[0]).translation
        way = np.subtract(there, begin)
        return float(np.subtract(here, there) @ way / np.linalg.norm(way))

    async def suck(self, _cups: Sequence[Cup]) -> bool:
        """The cups seal where the front is within their reach."""
        away = self._beyond() + self._nearer
        self.deepest = max(self.deepest, away)
        self._sealed = abs(away) <= STROKE
        return self._sealed and not self._leaks

    def vacuum(self) -> Mapping[str, float]:
        """What has sealed, holds [Pa]."""
        return {"front": 30_000.0 * self._sealed}


@settings(max_examples=15, deadline=None)
@given(st.floats(-0.027, 0.027))
def test_a_front_is_felt_for_from_before_it_and_nothing_is_pushed_hard(nearer: float) -> None:
    """Wherever it is within what a look errs by, the bellows give by all that they meet."""
    front = BeforeAFront(nearer)
    assert front.plan.short == SHORT
    cell = front.cell
    guards = Guards(cell.arm, cell.gripper, cell.work.ports.safety)
    assert run_simulated(sucked(cell.work, cell.desk, front.plan, guards))
    assert front.deepest <= STROKE + 1e-6


@settings(max_examples=15, deadline=None)
@given(st.floats(-0.018, 0.018))
def test_a_front_that_some_cups_never_seal_on_is_not_pushed_either(nearer: float) -> None:
    """One step more than the first seal, for a face may stand askew."""
    front = BeforeAFront(nearer, leaks=True)
    cell = front.cell
    guards = Guards(cell.arm, cell.gripper, cell.work.ports.safety)
    assert not run_simulated(sucked(cell.work, cell.desk, front.plan, guards))
    assert front.deepest <= STROKE + 1e-6
