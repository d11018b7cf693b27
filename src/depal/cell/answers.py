"""Answers to faults: a box whose action gave up is set aside, left behind, or handed over."""

import asyncio
from collections import Counter
from collections.abc import Callable, Sequence

from depal.cell.planning.promises import Promises
from depal.cell.workplace import FIRST, Workplace
from depal.domain import BoxId
from depal.executive import events as ev
from depal.executive.engine import Call
from depal.ports import Question

STORE, ASIDE, HAND_OVER = "store", "set_aside", "hand_over"
EMPTY, RECOVER = "depalletize", "recover"

OF_BOXES = frozenset({STORE, ASIDE, HAND_OVER})
"""Tasks that end with their box."""

STEPS = frozenset({"look_again", "carry_on"})
"""Actions of `recover` that need the cameras; from any other fault of a box it recovers."""

SEEN_TO, HOPELESS = "I have seen to it", "that cannot be helped now"

HELP = 2
"""A person is asked so often to see to the same thing before the run ends."""


class Answers:
    """Looks for faults after a step of the executive, and answers them by tasks."""

    def __init__(self, work: Workplace, promises: Promises, answered: Callable[[], None]) -> None:
        """Nothing is wrong yet.

        Args:
            work: whose runtime is watched.
            promises: broken for boxes that go another way.
            answered: called when a person has seen to something.
        """
        self._work = work
        self._promises = promises
        self._answered = answered
        self._help: Counter[str] = Counter()
        self._waiting = False
        self._asked: set[asyncio.Task[None]] = set()
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
        return bool(self._asked)

    def look(self) -> None:
        """A box whose action gave up: set aside from the hand, or left on the pallet."""
        runtime = self._work.runtime
        state = runtime.engine.state
        for number, tree in list(state.trees.items()):
            schema, args = tree.root.node.schema.name, tree.root.node.args
            if tree.withdrawn is not None:
                continue
            blind = schema == EMPTY or (schema == RECOVER and self._cannot_recover(args[0]))
            if blind and state.facts.get(f"{args[0]}.fault"):
                self._held(number, args[0], str(state.facts[f"{args[0]}.fault"]))
            if schema not in OF_BOXES:
                continue
            box = BoxId(args[0])
            if state.facts.get(f"{box}.on_floor"):
                self._let_lie(number, box)
                continue
            fault = state.facts.get(f"{box}.fault")
            if box in self._work.passed_over:
                self._pass_over(number, box)
            elif fault:
                self._give_up(number, schema, box, self._why.pop(number, str(fault)))

    def _cannot_recover(self, box: str) -> bool:
        """Whether what should answer a box's fault has itself given up."""
        return self._work.runtime.engine.state.facts.get(f"{box}.fault") in STEPS

    def _held(self, number: int, about: str, fault: str) -> None:
        """Nobody can see or choose any more: nothing is grasped until a person has seen to it.

        What stays so, or what the person cannot change, ends the run once what has begun is done.
        """
        if self._waiting:
            return
        if self._help[about] >= HELP:
            self._work.runtime.withdraw(number, fault)
            return
        self._help[about] += 1
        self._waiting = True
        why = self._why.pop(number, fault)
        task = asyncio.get_running_loop().create_task(self._have_seen_to(number, about, why))
        self._asked.add(task)
        task.add_done_callback(self._seen_to)

    async def _have_seen_to(self, number: int, about: str, why: str) -> None:
        question = Question(
            f"sight/{about}/{self._help[about]}",
            f"The cell is held: {why}. Please see to it.",
            (SEEN_TO, HOPELESS),
            about,
        )
        answer = await self._work.questions.ask(question)
        self._waiting = False
        if answer == SEEN_TO:
            facts = [(f"{about}.fault", None), (f"{about}.attempts", 0)]
            self._work.runtime.change(facts, "person")
        else:
            self._help[about] = HELP
            self._work.runtime.withdraw(number, why)

    def _pass_over(self, number: int, box: BoxId) -> None:
        """It is not there by this name any more, or there is no way to it now: chosen anew."""
        work = self._work
        work.passed_over.discard(box)
        work.runtime.withdraw(number, self._why.pop(number, "it is not seen any more"))
        work.runtime.change([(f"{box}.fault", None), (f"{box}.attempts", 0)], "cell")
        self._promises.forget_pick(box)
        work.gone(box).set()

    def _let_lie(self, number: int, box: BoxId) -> None:
        self._work.runtime.withdraw(number, "it lies on the floor")
        self._promises.forget_carry(box)

    def _give_up(self, number: int, schema: str, box: BoxId, fault: str) -> None:
        work, runtime = self._work, self._work.runtime
        taken = runtime.engine.state.facts.get(f"{box}.taken")
        # Of two boxes, or of one that ends nobody knows where, none comes into a place.
        placeable = schema == STORE and box not in work.unplaceable
        aside = placeable and bool(taken or box in work.homeless)
        # First of all its successor: the arm goes from the one to the other.
        if aside:
            work.aside_reasons[box] = fault
            runtime.allocate(Call(ASIDE, (box,), FIRST))
        elif taken:
            work.stranded[box] = fault
            runtime.allocate(Call(HAND_OVER, (box,), FIRST))
        runtime.withdraw(number, fault)
        runtime.change([(f"{box}.fault", None), (f"{box}.attempts", 0)], "cell")
        if not aside and not taken:
            self._promises.forget_pick(box)
            work.left_behind[box] = fault
            work.gone(box).set()

    def _seen_to(self, task: asyncio.Task[None]) -> None:
        self._asked.discard(task)
        self._answered()
