"""The primitives of `restart_arm`: a person says start, safety is good, the arm draws back."""

from depal.cell.clearing import get_clear
from depal.cell.guards import Guards
from depal.cell.halting import ABORTED, KR60, STOPPED, HaltingArm
from depal.cell.hand import Phase
from depal.cell.planning.desk import Desk
from depal.cell.workplace import Held, Workplace
from depal.errors import DepalError
from depal.executive.engine import Report
from depal.executive.events import Change
from depal.executive.runtime import Context
from depal.ports import Question

START, HOPELESS = "start", "it cannot go on now"

OFTEN = 5
"""A person is asked so often in a row before the arm gives up."""

ARM = "arm"
"""What the questions are about."""

ARM_AT = f"{KR60}.at"

DECISION, SAFE = f"{KR60}.decision", f"{KR60}.safe"

ANEW: tuple[Change, ...] = ((DECISION, None), (SAFE, False))
"""A person is asked again."""

OVER: tuple[Change, ...] = ((STOPPED, None), (ABORTED, False), *ANEW)
"""The stop is over."""


class Restarting:
    """Brings an arm that has stopped back to where plans can begin."""

    def __init__(self, work: Workplace, desk: Desk, guards: Guards, arm: HaltingArm | None) -> None:
        """Asks through the workplace; moves by the plans of the desk.

        Args:
            work: what the cell believes.
            desk: plans the way out.
            guards: watch what hangs on the arm.
            arm: that stops; None where none does.
        """
        self._work, self._desk, self._guards, self._arm = work, desk, guards, arm
        self._asked = self._row = 0

    async def ask_for_start(self, context: Context) -> Report:
        """Asks a person to see to it."""
        if self._row >= OFTEN:
            return self._given_up()
        self._row += 1
        self._asked += 1
        question = Question(
            f"stopped/{self._asked}",
            f"The arm has stopped: {context.facts.get(STOPPED)}. Please see that nobody is in the "
            "cell, clear the cause, reset it, and say start.",
            (START, HOPELESS),
            ARM,
        )
        answer = await self._work.questions.ask(question)
        return Report(((DECISION, answer),)) if answer == START else self._given_up()

    async def check_safety(self, context: Context) -> Report:
        """Reads the safety inputs; where they are not good the person is asked again."""
        del context
        state = self._work.ports.safety.state()
        bad = state.stopped or state.gate_open
        return Report(ANEW if bad else ((SAFE, True),))

    async def draw_back(self, context: Context) -> Report:
        """Back to where plans can begin; where it stops again, a person is asked again."""
        del context
        try:
            told = await self._get_clear()
        except Exception as again:  # noqa: BLE001 - whatever it is, nobody may wait for ever
            if self._row >= OFTEN:
                return self._given_up()
            why = (
                str(again) if isinstance(again, DepalError) else f"{type(again).__name__}: {again}"
            )
            return Report((*ANEW, (STOPPED, why)))
        self._end(free=True)
        return Report((*OVER, *told))

    async def _get_clear(self) -> tuple[Change, ...]:
        """With whatever it holds; a box that is being set down stays where it is."""
        work, desk, hand = self._work, self._desk, self._work.hand
        if hand is not None and hand.phase is Phase.LOWERING:
            return ()
        vacuum = any(value > 0.0 for value in work.ports.gripper.vacuum().values())
        if hand is not None and hand.phase is Phase.GRASPING and vacuum and work.held is None:
            work.lifted(Held.again(hand))
            work.tell([(f"{hand.box}.taken", True)], "arm")
        desk.promises.next_start = None
        self._clears(begins=True)
        try:
            guard = self._guards.holding() if work.held is not None else None
            lost = await get_clear(work, desk, guard)
        finally:
            self._clears(begins=False)
        if lost is not None and work.held is not None:
            box = work.held.box
            await work.ports.gripper.release()
            work.dropped(box)
        return ((ARM_AT, None),)

    def _clears(self, *, begins: bool) -> None:
        if self._arm is not None:
            self._arm.clearing(begins=begins)

    def _given_up(self) -> Report:
        """The motion fails as if nobody had been asked."""
        self._end(free=False)
        return Report(OVER)

    def _end(self, *, free: bool) -> None:
        self._row = 0
        if self._arm is not None:
            self._arm.ends(free=free)
