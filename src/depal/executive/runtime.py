"""The rim: writes what the engine decides, then runs primitives as asynchronous functions.

Everything happens in reaction to something: a fact, a report, a timer. Nothing polls, so an
idle executive does not wake up.
"""

import asyncio
from collections import deque
from collections.abc import Awaitable, Callable, Iterable, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, field
from types import MappingProxyType

from depal.errors import JournalError, Problem, TaskError, did_you_mean
from depal.executive import events as ev
from depal.executive.clock import Clock
from depal.executive.commands import Command, Probe, Start, Stop
from depal.executive.conditions import Key, Value
from depal.executive.engine import Call, Engine, Report, Step
from depal.executive.events import Change, Outcome, encode
from depal.executive.journal import Entry, Journal
from depal.executive.limits import Limits, avoided_on, limits_on
from depal.executive.schema import Action, Cancel
from depal.executive.snapshot import freeze

SNAPSHOT_EVERY = 1000
"""Events between snapshots."""


class Stopped(Exception):  # noqa: N818 - it is no error: the primitive was asked to stop
    """Raised in a primitive at its checkpoint when it is to stop."""


@dataclass(slots=True)
class Context:
    """What a primitive is given.

    Attributes:
        attempt: the number of the attempt; messages go out under it.
        action: the schema.
        args: the things that its parameters stand for, by parameter.
        facts: what is the case now; for reading.
        stop_reason: why it is to stop, None while it is not.
        limits: tells what it must not exceed now [base units], quantity by quantity.
        avoids: tells which zones it must not enter now.
    """

    attempt: int
    action: Action
    args: Mapping[str, str]
    facts: Mapping[Key, Value]
    stop_reason: str | None = field(default=None)
    limits: Callable[[], Limits] = field(default=dict)
    avoids: Callable[[], frozenset[str]] = field(default=frozenset)

    async def checkpoint(self) -> None:
        """A moment at which the primitive may be broken off.

        Raises:
            Stopped: it is to stop; let it through after bringing the device to rest.
        """
        await asyncio.sleep(0)
        if self.stop_reason is not None:
            raise Stopped(self.stop_reason)


Primitive = Callable[[Context], Awaitable[Report]]
"""Does a concrete schema's work, and reports the facts that it has changed."""


class Runtime:
    """An engine with a journal, a clock and primitives."""

    def __init__(
        self,
        engine: Engine,
        journal: Journal,
        clock: Clock,
        primitives: Mapping[str, Primitive],
        probes: Mapping[str, Primitive] | None = None,
    ) -> None:
        """Binds primitives and probes by name.

        Args:
            engine: new, or folded from the journal.
            journal: where events are written before commands are carried out.
            clock: the time.
            primitives: one for each action.
            probes: one for each probe that an action names.

        Raises:
            TaskError: an action or a probe without its function.
        """
        self.engine = engine
        self.journal = journal
        self.clock = clock
        self._primitives = dict(primitives)
        self._probes = dict(probes or {})
        self._running: dict[int, tuple[asyncio.Task[None], Context]] = {}
        self._listeners: list[Callable[[int, Sequence[ev.Event]], None]] = []
        self._timer: asyncio.TimerHandle | None = None
        self._failure: JournalError | None = None
        self._told: Callable[[JournalError], None] | None = None
        self._unwritten: Step | None = None
        self._inputs: deque[Callable[[float], Step]] = deque()
        self._unsnapped = 0
        self._check_bindings()

    # Inputs; each returns when it is written and its commands have begun

    def allocate(self, *calls: Call) -> None:
        """Allocates tasks."""
        self._do(lambda at: self.engine.allocate(calls, at))

    def change(self, facts: Iterable[Change], source: str) -> None:
        """Changes facts together."""
        changes = tuple(facts)
        self._do(lambda at: self.engine.change(changes, source, at))

    def prioritise(self, tree: int, priority: float) -> None:
        """Gives a tree another priority."""
        self._do(lambda at: self.engine.prioritise(tree, priority, at))

    def withdraw(self, tree: int, reason: str) -> None:
        """Ends a tree that is no longer wanted."""
        self._do(lambda at: self.engine.withdraw(tree, reason, at))

    def retry(self, tree: int, node: int) -> None:
        """Lets a primitive be tried again."""
        self._do(lambda at: self.engine.retry(tree, node, at))

    def hold(self, source: str) -> None:
        """Nothing starts any more."""
        self._do(lambda at: self.engine.hold(source, at))

    def start(self, source: str) -> None:
        """A person lets the executive go on."""
        self._do(lambda at: self.engine.start(source, at))

    def restart(self) -> None:
        """After folding a journal: held, probing what is in doubt."""
        self._do(self.engine.restart)

    # Watching

    def listen(self, listener: Callable[[int, Sequence[ev.Event]], None]) -> None:
        """Calls a function with the last sequence number and the events of every step."""
        self._listeners.append(listener)

    def wait_to_write(self, told: Callable[[JournalError], None]) -> None:
        """From now on a journal that takes nothing stops the executive, and raises nothing.

        What has been decided and could not be written is not done, and what comes after it waits,
        until `write_again` succeeds.

        Args:
            told: of every write that fails.
        """
        self._told = told

    def write_again(self) -> bool:
        """Writes what could not be written, and goes on with all that has come since.

        Returns:
            Whether everything is written.
        """
        if self._failure is not None and self._unwritten is not None:
            step, self._failure = self._unwritten, None
            self._go_through(step)
            while self._inputs and self._failure is None:
                self._do(self._inputs.popleft())
        return self._failure is None

    @property
    def idle(self) -> bool:
        """Whether nothing runs and no timer is set."""
        return not self._running and self._timer is None

    async def settle(self) -> None:
        """Waits until nothing runs any more; timers may still be set."""
        while self._running:
            await asyncio.wait([task for task, _ in self._running.values()])

    async def close(self) -> None:
        """Breaks off everything that runs, without a report: as a crash would."""
        if self._timer is not None:
            self._timer.cancel()
            self._timer = None
        tasks = [task for task, _ in self._running.values()]
        self._running.clear()
        for task in tasks:
            task.cancel()
        await asyncio.gather(*tasks, return_exceptions=True)

    # Doing

    def _do(self, decide: Callable[[float], Step]) -> None:
        if self._failure is not None:
            if self._told is None:
                raise self._failure
            self._inputs.append(decide)
            return
        self._go_through(decide(self.clock.now()))

    def _go_through(self, step: Step) -> None:
        if step.events and not self._write(step):
            return
        for command in step.commands:
            self._carry_out(command)
        self._set_timer()

    def _write(self, step: Step) -> bool:
        """Writes before anything is done; fully synced where something may move."""
        entries = [Entry(event.at, type(event).__name__, encode(event)) for event in step.events]
        moves = any(
            isinstance(command, Start) and not command.action.idempotent
            for command in step.commands
        )
        try:
            last = self.journal.append(entries, durable=moves)
        except JournalError as error:
            # What is not written must not be done; the engine knows more than the journal now.
            self._failure, self._unwritten = error, step
            if self._told is None:
                raise
            self._told(error)
            return False
        self._unsnapped += len(entries)
        if self._unsnapped >= SNAPSHOT_EVERY:
            self._save_snapshot(last)
        for listener in self._listeners:
            listener(last, step.events)
        return True

    def _save_snapshot(self, last: int) -> None:
        """A restart can do without it: where it cannot be kept, the next step tries again."""
        with suppress(JournalError):
            self.journal.save_snapshot(last, freeze(self.engine.state))
            self._unsnapped = 0

    def _carry_out(self, command: Command) -> None:
        match command:
            case Start(attempt, action, args):
                self._begin(attempt, action, args, self._primitives[action.name])
            case Probe(attempt, action, args):
                self._begin(attempt, action, args, self._probes[str(action.probe)], probing=True)
            case Stop(attempt, policy, reason):
                task, context = self._running.get(attempt, (None, None))
                if task is None or context is None:
                    return  # it has ended while nothing could be written
                if policy is not Cancel.NEVER:
                    context.stop_reason = reason
                if policy is Cancel.IMMEDIATE:
                    task.cancel()

    def _begin(
        self,
        attempt: int,
        action: Action,
        args: tuple[str, ...],
        function: Primitive,
        *,
        probing: bool = False,
    ) -> None:
        names = (param.name for param in action.params)
        facts = MappingProxyType(self.engine.state.facts)
        given = dict(zip(names, args, strict=True))
        context = Context(
            attempt,
            action,
            given,
            facts,
            None,
            lambda: self._limits_on(attempt),
            lambda: self._avoided_on(attempt),
        )
        task = asyncio.get_running_loop().create_task(self._run(context, function, probing=probing))
        self._running[attempt] = (task, context)
        task.add_done_callback(lambda _: self._never_began(context))

    def _limits_on(self, attempt: int) -> Limits:
        """What an attempt must not exceed now; one that has ended moves nothing."""
        state = self.engine.state
        known = state.attempts.get(attempt)
        return {} if known is None else limits_on(known.node, state.facts)

    def _avoided_on(self, attempt: int) -> frozenset[str]:
        """Which zones an attempt must not enter now."""
        state = self.engine.state
        known = state.attempts.get(attempt)
        return frozenset() if known is None else avoided_on(known.node, state.facts)

    async def _run(self, context: Context, function: Primitive, *, probing: bool) -> None:
        try:
            report = await function(context)
        except Stopped as stop:
            report = Report(outcome=Outcome.CANCELLED, reason=str(stop))
        except asyncio.CancelledError:
            if context.stop_reason is None:
                raise  # the runtime itself is closing: nothing is known, nothing is reported
            report = Report(outcome=Outcome.CANCELLED, reason=context.stop_reason)
        except Exception as error:  # noqa: BLE001 - whatever a primitive raises, it has failed
            reason = f"{type(error).__name__}: {error}"
            report = Report(outcome=Outcome.FAILED, reason=reason)
        if not isinstance(report, Report):
            report = Report(outcome=Outcome.FAILED, reason=f"returned {report!r}, not a Report")
        if probing and report.outcome is Outcome.DONE:
            report = Report(report.facts, Outcome.PROBED, report.reason)
        elif probing:
            report = Report((), Outcome.UNKNOWN, report.reason)
        refused = self._failure is not None and self._told is None
        if self._running.pop(context.attempt, None) is not None and not refused:
            self._do(lambda at: self.engine.report(context.attempt, report, at))

    def _never_began(self, context: Context) -> None:
        """A primitive that was cancelled before its first step reports nothing by itself."""
        if self._running.pop(context.attempt, None) is not None and context.stop_reason is not None:
            report = Report(outcome=Outcome.CANCELLED, reason=context.stop_reason)
            self._do(lambda at: self.engine.report(context.attempt, report, at))

    def _set_timer(self) -> None:
        due = self.engine.state.next_timer()
        if self._timer is not None:
            self._timer.cancel()
            self._timer = None
        if due is not None:
            delay = max(0.0, due - self.clock.now())
            self._timer = asyncio.get_running_loop().call_later(delay, self._tick)

    def _tick(self) -> None:
        self._timer = None
        self._do(self.engine.tick)

    def _check_bindings(self) -> None:
        actions = [s for s in self.engine.repository.schemata.values() if isinstance(s, Action)]
        problems = [
            Problem(
                action.name,
                "no primitive is bound to this action",
                exists=did_you_mean(action.name, self._primitives),
            )
            for action in actions
            if action.name not in self._primitives
        ]
        problems += [
            Problem(
                action.name,
                f"no probe is called {action.probe!r}",
                exists=did_you_mean(action.probe, self._probes),
            )
            for action in actions
            if action.probe is not None and action.probe not in self._probes
        ]
        if problems:
            raise TaskError("primitives", problems)
