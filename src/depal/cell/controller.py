"""The controller: a pallet is emptied, requests are known, faults are answered."""

import asyncio
from collections.abc import Sequence

from depal.cell.answers import EMPTY, Answers
from depal.cell.bindings import bindings
from depal.cell.bookkeeping import Bookkeeping
from depal.cell.halting import HaltingArm
from depal.cell.planning.desk import Desk
from depal.cell.quantities import refuse_unknown
from depal.cell.reporting import Journalist
from depal.cell.safety import SafetyWatch
from depal.cell.workplace import PALLET, Workplace
from depal.domain import Request
from depal.errors import UnwrittenError
from depal.executive import events as ev
from depal.executive.engine import Call, Engine
from depal.executive.journal import Journal
from depal.executive.runtime import Runtime
from depal.executive.schema import Repository

PATIENCE = 600.0
"""A run that is over waits so long for the store's system to have been told of it [s]."""


class Controller:
    """One cell at work."""

    def __init__(
        self,
        work: Workplace,
        desk: Desk,
        notes: Journalist,
        tasks: Repository,
        journal: Journal,
        engine: Engine | None = None,
        books: Bookkeeping | None = None,
        arm: HaltingArm | None = None,
    ) -> None:
        """Binds every action of the task files to its primitive.

        Args:
            work: what the cell believes.
            desk: plans its motions.
            notes: told what happens.
            tasks: what the cell can do.
            journal: written before anything is done.
            engine: folded from that journal; None for one that knows nothing.
            books: asked by the arm and the gripper whether all is written; None for new ones.
            arm: that goes on after a stop when `restart_arm` lets it; None where none stops.

        Raises:
            TaskError: the task files name an action that this cell does not know, limit what
                it does not keep, or avoid a zone that it does not have.
        """
        refuse_unknown(tasks, [zone.name for zone in work.layout.zones])
        self.work = work
        self.desk = desk
        primitives, probes = bindings(work, desk, notes, arm)
        self.runtime = Runtime(
            engine or Engine(tasks), journal, work.ports.clock, primitives, probes
        )
        work.bind(self.runtime)
        self.safety = SafetyWatch(work)
        self.books = books or Bookkeeping(work.questions)
        self.books.bind(self.runtime, self._fail)
        self._failure: UnwrittenError | None = None
        self._notes = notes
        self._ended = asyncio.Event()
        self._answers = Answers(work, desk.promises, self._end_if_done)
        self.runtime.listen(self._heard)

    async def empty_pallet(self, requests: Sequence[Request] = ()) -> None:
        """Runs `depalletize` to its end.

        Args:
            requests: each is known from its own time on.
        """
        for request in requests:
            self.work.wishes.add(request)
        self.begin()
        await self.finish()

    def begin(self) -> None:
        """Allocates `depalletize`, unless it is allocated; the safety inputs are read before."""
        self.safety.look()
        trees = self.runtime.engine.state.trees.values()
        if not any(tree.root.node.schema.name == EMPTY for tree in trees):
            self.runtime.allocate(Call(EMPTY, (PALLET,)))

    async def finish(self) -> None:
        """Waits until the pallet is empty and everything that was begun has ended.

        Raises:
            UnwrittenError: the journal or the ledger takes nothing; all has stopped where it was.
        """
        watching = asyncio.create_task(self.safety.keep())
        try:
            await self._ended.wait()
        finally:
            watching.cancel()
        if self._failure is not None:
            await self.runtime.close()
            raise self._failure
        await self.work.outbox.emptied(PATIENCE)
        await self.runtime.close()

    def _fail(self, error: UnwrittenError) -> None:
        self._failure = error
        self._ended.set()

    def _heard(self, last: int, events: Sequence[ev.Event]) -> None:
        """Every step of the executive: notes it, and answers faults once the step is over."""
        self._notes.heard(last, events)
        self._answers.hear(events)
        if any(isinstance(event, ev.Changed | ev.Ended) for event in events):
            self.work.bounds.refresh()
        loop = asyncio.get_running_loop()
        for event in events:
            if isinstance(event, ev.Ended):
                loop.call_soon(self._answers.look)
            if isinstance(event, ev.Archived):
                loop.call_soon(self._end_if_done)

    def _end_if_done(self) -> None:
        if not self.runtime.engine.state.trees and not self._answers.pending:
            self._ended.set()
