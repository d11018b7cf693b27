"""Answers to faults: a box whose action gave up is set aside, left behind, or handed over."""

import asyncio
from collections.abc import Callable, Sequence

from depal.cell.departures import Fate
from depal.cell.planning.promises import Promises
from depal.cell.workplace import FIRST, Workplace
from depal.domain import BoxId
from depal.executive import events as ev
from depal.executive.engine import Call
from depal.ports import TAKEN, Question

STORE, ASIDE, EMPTY = "store", "set_aside", "depalletize"


class Answers:
    """Looks for faults after a step of the executive, and answers them by tasks."""

    def __init__(self, work: Workplace, promises: Promises, answered: Callable[[], None]) -> None:
        """Nothing is wrong yet.

        Args:
            work: whose runtime is watched.
            promises: broken for boxes that go another way.
            answered: called when a person has taken a box over.
        """
        self._work = work
        self._promises = promises
        self._answered = answered
        self._handing: set[asyncio.Task[None]] = set()
        self._trees: dict[int, int] = {}
        self._why: dict[int, str] = {}

    def hear(self, events: Sequence[ev.Event]) -> None:
        """Remembers why an attempt failed: the last reason is what a fault is about."""
        for event in events:
            if isinstance(event, ev.Started):
                self._trees[event.attempt] = event.tree
            elif isinstance(event, ev.Ended):
                tree = self._trees.pop(event.attempt, None)
                if tree is not None and event.reason:
                    self._why[tree] = event.reason

    @property
    def pending(self) -> bool:
        """Whether a person is being waited for."""
        return bool(self._handing)

    def look(self) -> None:
        """A box whose action gave up: set aside from the hand, or left on the pallet."""
        runtime = self._work.runtime
        state = runtime.engine.state
        for number, tree in list(state.trees.items()):
            schema, args = tree.root.node.schema.name, tree.root.node.args
            if tree.withdrawn is not None:
                continue
            if schema == EMPTY and state.facts.get(f"{args[0]}.fault"):
                # Nobody can see or choose any more: what has begun ends, then the run does.
                runtime.withdraw(number, str(state.facts[f"{args[0]}.fault"]))
            if schema not in {STORE, ASIDE}:
                continue
            box = BoxId(args[0])
            if state.facts.get(f"{box}.on_floor"):
                self._let_lie(number, box)
                continue
            fault = state.facts.get(f"{box}.fault")
            if fault:
                self._give_up(number, schema, box, self._why.pop(number, str(fault)))

    def _let_lie(self, number: int, box: BoxId) -> None:
        self._work.runtime.withdraw(number, "it lies on the floor")
        self._promises.forget_carry(box)

    def _give_up(self, number: int, schema: str, box: BoxId, fault: str) -> None:
        work, runtime = self._work, self._work.runtime
        taken = runtime.engine.state.facts.get(f"{box}.taken")
        if taken and schema == STORE:
            # First of all its successor: the arm goes from the one to the other.
            work.aside_reasons[box] = fault
            runtime.allocate(Call(ASIDE, (box,), FIRST))
        runtime.withdraw(number, fault)
        runtime.change([(f"{box}.fault", None), (f"{box}.attempts", 0)], "cell")
        if not taken:
            self._promises.forget_pick(box)
            work.left_behind[box] = fault
            work.gone(box).set()
        elif schema == STORE:
            return
        else:
            task = asyncio.get_running_loop().create_task(self._hand_over(box, fault))
            self._handing.add(task)
            task.add_done_callback(self._handed_over)

    def _handed_over(self, task: asyncio.Task[None]) -> None:
        self._handing.discard(task)
        self._answered()

    async def _hand_over(self, box: BoxId, fault: str) -> None:
        """A person takes the box out of the gripper."""
        work = self._work
        question = Question(
            f"hand/{box}",
            f"The arm cannot put box {box} down: {fault}. Please take it out of the gripper.",
            (TAKEN,),
            str(box),
        )
        await work.questions.ask(question)
        await work.ports.gripper.release()
        reason = work.aside_reasons.get(box, fault)
        work.ended(box, Fate.BY_PERSON, reason=reason)
        work.runtime.change([(f"{box}.taken", False)], "person")
