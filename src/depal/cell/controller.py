"""The controller: tasks bound to devices, faults answered by tasks, a pallet emptied."""

import asyncio
from collections.abc import Mapping, Sequence

from depal.cell.departures import Fate
from depal.cell.guards import Guards
from depal.cell.planning.desk import Desk
from depal.cell.primitives.checking import Checking
from depal.cell.primitives.exchanging import Exchanging
from depal.cell.primitives.leaving import Leaving
from depal.cell.primitives.minding import Minding
from depal.cell.primitives.moving import Moving
from depal.cell.primitives.querying import Querying
from depal.cell.primitives.seeing import Seeing
from depal.cell.primitives.taking import Taking
from depal.cell.reporting import Journalist
from depal.cell.workplace import PALLET, Workplace
from depal.domain import BoxId, Request
from depal.executive import events as ev
from depal.executive.engine import Call, Engine
from depal.executive.journal import Journal
from depal.executive.runtime import Primitive, Runtime
from depal.executive.schema import Repository
from depal.ports import TAKEN, Question

STORE, ASIDE, EMPTY = "store", "set_aside", "depalletize"

FIRST = 10.0
"""A priority above that of any request."""


class Controller:
    """One cell at work."""

    def __init__(
        self, work: Workplace, desk: Desk, notes: Journalist, tasks: Repository, journal: Journal
    ) -> None:
        """Binds every action of the task files to its primitive.

        Raises:
            TaskError: the task files name an action that this cell does not know.
        """
        self.work = work
        self.desk = desk
        primitives, probes = bindings(work, desk, notes)
        self.runtime = Runtime(Engine(tasks), journal, work.ports.clock, primitives, probes)
        work.bind(self.runtime)
        self._notes = notes
        self._ended = asyncio.Event()
        self._later: set[asyncio.Task[None]] = set()
        self.runtime.listen(self._heard)

    async def empty_pallet(self, requests: Sequence[Request] = ()) -> None:
        """Runs `depalletize` to its end.

        Args:
            requests: each is known from its own time on.
        """
        for request in requests:
            self.work.wishes.add(request)
        self.runtime.allocate(Call(EMPTY, (PALLET,)))
        await self._ended.wait()
        await self.runtime.close()

    # What happens beside the plan

    def _heard(self, last: int, events: Sequence[ev.Event]) -> None:
        """Every step of the executive: notes it, and answers faults once the step is over."""
        self._notes.heard(last, events)
        loop = asyncio.get_running_loop()
        for event in events:
            if isinstance(event, ev.Ended):
                loop.call_soon(self._answer_faults)
            if isinstance(event, ev.Archived):
                loop.call_soon(self._end_if_done)

    def _end_if_done(self) -> None:
        if not self.runtime.engine.state.trees and not self._later:
            self._ended.set()

    def _answer_faults(self) -> None:
        """A box whose action gave up: set aside from the hand, or left on the pallet."""
        state = self.runtime.engine.state
        for number, tree in list(state.trees.items()):
            schema, args = tree.root.node.schema.name, tree.root.node.args
            if tree.withdrawn is not None:
                continue
            if schema == EMPTY and state.facts.get(f"{args[0]}.fault"):
                # Nobody can see or choose any more: what has begun ends, then the run does.
                self.runtime.withdraw(number, str(state.facts[f"{args[0]}.fault"]))
            if schema not in {STORE, ASIDE}:
                continue
            box = BoxId(args[0])
            if state.facts.get(f"{box}.on_floor"):
                self._recover(number, box)
                continue
            fault = state.facts.get(f"{box}.fault")
            if fault:
                self._give_up(number, schema, box, str(fault))

    def _recover(self, number: int, box: BoxId) -> None:
        self.runtime.withdraw(number, "it lies on the floor")
        self.desk.promises.forget_carry(box)
        self.runtime.allocate(Call("recover", (box,)))

    def _give_up(self, number: int, schema: str, box: BoxId, fault: str) -> None:
        work, runtime = self.work, self.runtime
        taken = runtime.engine.state.facts.get(f"{box}.taken")
        if taken and schema == STORE:
            # First of all its successor: the arm goes from the one to the other.
            work.aside_reasons[box] = fault
            runtime.allocate(Call(ASIDE, (box,), FIRST))
        runtime.withdraw(number, fault)
        runtime.change([(f"{box}.fault", None), (f"{box}.attempts", 0)], "cell")
        if not taken:
            self.desk.promises.forget_pick(box)
            work.left_behind[box] = fault
            work.gone(box).set()
        elif schema == STORE:
            return
        else:
            task = asyncio.get_running_loop().create_task(self._hand_over(box, fault))
            self._later.add(task)
            task.add_done_callback(self._handed_over)

    def _handed_over(self, task: asyncio.Task[None]) -> None:
        self._later.discard(task)
        self._end_if_done()

    async def _hand_over(self, box: BoxId, fault: str) -> None:
        """A person takes the box out of the gripper."""
        question = Question(
            f"hand/{box}",
            f"The arm cannot put box {box} down: {fault}. Please take it out of the gripper.",
            (TAKEN,),
            str(box),
        )
        await self.work.questions.ask(question)
        await self.work.ports.gripper.release()
        reason = self.work.aside_reasons.get(box, fault)
        self.work.ended(box, Fate.BY_PERSON, reason=reason)
        self.runtime.change([(f"{box}.taken", False)], "person")


def bindings(
    work: Workplace, desk: Desk, notes: Journalist
) -> tuple[Mapping[str, Primitive], Mapping[str, Primitive]]:
    """The primitive of every action, and the probes."""
    guards = Guards(work.ports.arm, work.ports.gripper, work.ports.safety)
    seeing, taking = Seeing(work, desk, notes), Taking(work, desk, guards)
    checking, leaving = Checking(work, desk, guards), Leaving(work, desk, guards)
    querying, exchanging = Querying(work, desk), Exchanging(work, desk)
    minding, moving = Minding(work), Moving(work, desk, guards)
    primitives: dict[str, Primitive] = {
        "look": seeing.look,
        "select_box": seeing.select_box,
        "await_box": seeing.await_box,
        "kr60_reach": taking.reach,
        "kr60_grasp": taking.grasp,
        "kr60_show": checking.show,
        "read_barcode": checking.read,
        "ask_target": querying.ask_target,
        "kr60_carry": leaving.carry,
        "kr60_release": leaving.release,
        "kr60_bring": leaving.carry,
        "kr60_put": leaving.put,
        "kr60_reach_into": moving.reach_into,
        "inspect_bay": exchanging.inspect,
        "call_for_exchange": exchanging.call,
        "await_trolley": exchanging.await_new,
        "show_question": minding.show_question,
        "await_answer": minding.await_answer,
        "look_again": minding.look_again,
        "ask_decision": minding.ask_decision,
        "carry_on": minding.carry_on,
    }
    probes: dict[str, Primitive] = {"arm": taking.probe_arm, "gripper": taking.probe_gripper}
    return primitives, probes
