"""The arm has stopped where it should not have: a person says start, then it gets clear.

RELIABILITY's M5 to M7: after a safety stop, an error of the arm or a path that it has left nothing
moves until a person has seen to it and has said start. Then the arm draws back to where plans can
begin, with whatever it holds, and the action that it was in fails: the executive begins it anew.
"""

from contextlib import suppress
from dataclasses import dataclass, field

from depal.cell.clearing import get_clear
from depal.cell.guards import Guards
from depal.cell.hand import Phase
from depal.cell.planning.desk import Desk
from depal.cell.workplace import Held, Workplace
from depal.domain import Joints
from depal.errors import DeviceError
from depal.ports import Arm, Guard, Question, Trajectory

START, HOPELESS = "start", "it cannot go on now"

OFTEN = 5
"""A person is asked so often in a row before the arm gives up."""

ARM = "arm"
"""What the questions are about."""

ARM_AT = "kr60.at"


class HaltedError(DeviceError):
    """The arm stopped, a person has said start, and it has drawn back: plan anew."""


@dataclass(slots=True)
class HaltingArm:
    """An arm that goes on after a stop only when a person has said so.

    Attributes:
        arm: behind it.
        work: what the cell believes; bound once it is there.
        desk: plans the way out.
        stops: how often it has stopped.
    """

    arm: Arm
    work: Workplace | None = None
    desk: Desk | None = None
    stops: int = 0
    _clearing: bool = field(default=False)

    def bind(self, work: Workplace, desk: Desk) -> None:
        """The cell that it works in."""
        self.work, self.desk = work, desk

    def joints(self) -> Joints:
        """Where the axes are [rad]."""
        return self.arm.joints()

    def load(self) -> float:
        """What hangs on the flange [kg]."""
        return self.arm.load()

    async def follow(self, trajectory: Trajectory, guard: Guard | None = None) -> str | None:
        """Moves along a trajectory.

        Raises:
            HaltedError: it stopped, and may be moved again, from where it is now.
            DeviceError: it stopped, and may not.
        """
        try:
            return await self.arm.follow(trajectory, guard)
        except DeviceError as error:
            if self._clearing or self.work is None or self.desk is None:
                raise
            await self._go_on(self.work, self.desk, error)
            raise HaltedError(str(error)) from error

    async def _go_on(self, work: Workplace, desk: Desk, error: DeviceError) -> None:
        for _ in range(OFTEN):
            await self._ask(work, error)
            if work.ports.safety.state().stopped or work.ports.safety.state().gate_open:
                continue
            try:
                await self._get_clear(work, desk)
            except DeviceError as again:
                error = again
                continue
            return
        raise error

    async def _ask(self, work: Workplace, error: DeviceError) -> None:
        self.stops += 1
        question = Question(
            f"stopped/{self.stops}",
            f"The arm has stopped: {error}. Please see that nobody is in the cell, clear the "
            "cause, reset it, and say start.",
            (START, HOPELESS),
            ARM,
        )
        if await work.questions.ask(question) != START:
            raise error

    async def _get_clear(self, work: Workplace, desk: Desk) -> None:
        """Back to where plans can begin; a box that is being set down stays where it is."""
        hand = work.hand
        if hand is not None and hand.phase is Phase.LOWERING:
            return
        vacuum = any(value > 0.0 for value in work.ports.gripper.vacuum().values())
        facts: list[tuple[str, bool | None]] = [(ARM_AT, None)]
        if hand is not None and hand.phase is Phase.GRASPING and vacuum and work.held is None:
            work.lifted(Held(hand.box, hand.grasp, hand.size, hand.mass, hand.beyond))
            facts.append((f"{hand.box}.taken", True))
        guards = Guards(work.ports.arm, work.ports.gripper, work.ports.safety)
        desk.promises.next_start = None
        self._clearing = True
        try:
            lost = await get_clear(work, desk, guards.holding() if work.held is not None else None)
        finally:
            self._clearing = False
        if lost is not None and work.held is not None:
            box = work.held.box
            await work.ports.gripper.release()
            work.dropped(box)
        work.tell(facts, "arm")


async def moved_away(arm: Arm, *ways: Trajectory | None) -> None:
    """With an empty hand along these, where nothing depends on how far it gets."""
    with suppress(HaltedError):  # it has drawn back by itself
        for way in ways:
            if way is not None:
                await arm.follow(way)
