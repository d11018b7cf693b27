"""The engine: inputs in, events and commands out; no clock, no input, no output of its own.

One input is one atomic change. It is checked, becomes events, the events are applied, and what
follows from them (attempts to stop, trees that have ended, primitives to start) becomes further
events of the same transaction. The rim writes the events and only then carries out the commands.
"""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import NamedTuple

from depal.errors import Problem, TaskError, did_you_mean
from depal.executive import events as ev
from depal.executive.arbitration import arbitrate
from depal.executive.closing import closed_by
from depal.executive.commands import Command, Probe, Start, Stop
from depal.executive.conditions import key_of
from depal.executive.declared import Declared
from depal.executive.emphasis import EmphasisWeights
from depal.executive.events import Change, Outcome
from depal.executive.nodes import Attempt, LiveTree
from depal.executive.schema import Repository
from depal.executive.state import State

TIMED_OUT = "its time is over"

DEFAULT_WEIGHTS = EmphasisWeights()


@dataclass(frozen=True, slots=True)
class Call:
    """A task to allocate.

    Attributes:
        schema: its name.
        args: the things that its parameters stand for.
        priority: of the request that it serves.
    """

    schema: str
    args: tuple[str, ...] = ()
    priority: float = 0.0


@dataclass(frozen=True, slots=True)
class Report:
    """What a primitive says when it ends.

    Attributes:
        facts: what it has changed; only facts that its schema `sets`.
        outcome: how it ended; the facts decide whether it did what it is for.
        reason: in words, for people.
        allocate: tasks that follow from it.
    """

    facts: tuple[Change, ...] = ()
    outcome: Outcome = Outcome.DONE
    reason: str = ""
    allocate: tuple[Call, ...] = ()


class Step(NamedTuple):
    """What one input has led to.

    Attributes:
        events: to be written, in one transaction, before any command is carried out.
        commands: to be carried out then, in order.
    """

    events: tuple[ev.Event, ...]
    commands: tuple[Command, ...]


class Engine:
    """Decides; `state` holds everything that it knows."""

    def __init__(self, repository: Repository, weights: EmphasisWeights = DEFAULT_WEIGHTS) -> None:
        """An engine without trees or facts.

        Args:
            repository: the schemata, already checked.
            weights: of the emphasis.
        """
        self.repository = repository
        self.state = State(repository, weights)
        self._declared = Declared(repository)
        self._uncontested = (0, -1, -1)

    # Inputs

    def allocate(self, calls: Sequence[Call], at: float) -> Step:
        """Allocates tasks.

        Raises:
            TaskError: an unknown task or a wrong number of arguments; nothing is allocated.
        """
        return self._commit(self._allocations(calls, at, self.state.next_tree), at)

    def change(self, facts: Iterable[Change], source: str, at: float) -> Step:
        """Changes facts together.

        Args:
            facts: keys such as "b1.taken" and their values; None empties a fact.
            source: who says so.
            at: the time [s].

        Raises:
            TaskError: a fact that is not declared, or a value of another kind.
        """
        changes = tuple(facts)
        problems = [problem for change in changes if (problem := self._declared.misfit(change))]
        if problems:
            raise TaskError(source, problems)
        return self._commit([ev.Changed(at, changes, source)], at)

    def report(self, attempt: int, report: Report, at: float) -> Step:
        """A primitive has ended; what it says and what follows from it is one change.

        A report about an attempt that has ended already is late and changes nothing.
        """
        known = self.state.attempts.get(attempt)
        if known is None:
            return Step((), ())
        facts, outcome, reason = self._believed(known, report)
        events: list[ev.Event] = [ev.Ended(at, attempt, outcome, facts, reason)]
        if outcome is Outcome.DONE:
            try:
                events += self._allocations(report.allocate, at, self.state.next_tree)
            except TaskError as error:
                events = [ev.Ended(at, attempt, Outcome.FAILED, facts, str(error))]
        return self._commit(events, at)

    def prioritise(self, tree: int, priority: float, at: float) -> Step:
        """Gives a tree another priority."""
        return self._commit([ev.Prioritised(at, self._tree(tree).number, float(priority))], at)

    def withdraw(self, tree: int, reason: str, at: float) -> Step:
        """Ends a tree that is no longer wanted, once nothing of it runs."""
        return self._commit([ev.Withdrawn(at, self._tree(tree).number, reason)], at)

    def retry(self, tree: int, node: int, at: float) -> Step:
        """Lets a primitive be tried again after it had used up its retries."""
        return self._commit([ev.Retried(at, self._tree(tree).number, node)], at)

    def tick(self, at: float) -> Step:
        """Time has come; nothing happens where nothing was due."""
        return self._commit([], at) if self.state.is_due(at) else Step((), ())

    def hold(self, source: str, at: float) -> Step:
        """Nothing starts any more; what runs goes on."""
        return self._commit([ev.ModeChanged(at, held=True, source=source)], at)

    def start(self, source: str, at: float) -> Step:
        """A person lets the executive go on.

        Raises:
            TaskError: attempts are still in doubt after a restart.
        """
        doubtful = [attempt for attempt in self.state.attempts.values() if attempt.in_doubt]
        if doubtful:
            names = ", ".join(attempt.node.node.label for attempt in doubtful)
            what = "what these attempts have done is not known yet"
            raise TaskError(source, [Problem("start", f"{what}: {names}", "a probe of each")])
        return self._commit([ev.ModeChanged(at, held=False, source=source)], at)

    def restart(self, at: float) -> Step:
        """The controller is back: held, and every attempt in doubt is probed or sent again.

        A motion is never run again; an idempotent message goes out under its old number. An
        attempt without either is a fault that a person must clear.
        """
        events: list[ev.Event] = [ev.Restarted(at)]
        self._apply(events)
        commands: list[Command] = []
        unknown: list[ev.Event] = []
        for attempt in list(self.state.attempts.values()):
            action, args = attempt.node.action, attempt.node.node.args
            if action.idempotent:
                commands.append(Start(attempt.number, action, args))
            elif action.probe is not None:
                commands.append(Probe(attempt.number, action, args))
            else:
                reason = "interrupted by a restart, and nothing can tell what it did"
                unknown.append(ev.Ended(at, attempt.number, Outcome.UNKNOWN, (), reason))
        self._apply(unknown)
        followed, more = self.consequences(at)
        return Step((*events, *unknown, *followed), (*commands, *more))

    # How an input becomes a step

    def _commit(self, events: Sequence[ev.Event], at: float) -> Step:
        # What was due before comes first, whether or not somebody ticked.
        happened = [ev.Ticked(at), *events] if self.state.is_due(at) else events
        self._apply(happened)
        followed, commands = self.consequences(at)
        return Step((*happened, *followed), tuple(commands))

    def _apply(self, events: Iterable[ev.Event]) -> None:
        for event in events:
            self.state.apply(event)

    def consequences(self, at: float) -> tuple[list[ev.Event], list[Command]]:
        """Everything that follows, until nothing more does."""
        events: list[ev.Event] = []
        commands: list[Command] = []
        while True:
            self._tidy(at, events, commands)
            if self.state.held or not self._contest(at, events, commands):
                return events, commands

    def _tidy(self, at: float, events: list[ev.Event], commands: list[Command]) -> None:
        """Stops what has lost its gate or its time, and archives what has ended."""
        state = self.state
        if state.overdue or state.orphans:
            for attempt in list(state.overdue.values()):
                self._stop(attempt, TIMED_OUT, at, events, commands)
            for attempt in list(state.orphans.values()):
                self._stop(attempt, closed_by(attempt.node), at, events, commands)
        if state.touched:
            touched = sorted(state.touched)
            state.touched.clear()
            for number in touched:
                tree = state.trees.get(number)
                if tree is not None and tree.ended:
                    self._then(ev.Archived(at, number, self.state.accomplished(tree.root)), events)

    def _contest(self, at: float, events: list[ev.Event], commands: list[Command]) -> bool:
        """Starts one primitive, or has some give way; whether one was started."""
        state = self.state
        moment = (id(state), state.waiting.version, state.holdings.version)
        if moment == self._uncontested:
            return False  # nothing has changed since a look that found nobody to decide about
        verdict = arbitrate(state.waiting, state.holdings, state.attempts, state.weights, at)
        if verdict.start is None and not verdict.contested:
            self._uncontested = moment
        for attempt, challenger in verdict.displace:
            if attempt.cancel is None:
                reason = f"{challenger.node.label} is more urgent"
                self._stop(attempt, reason, at, events, commands)
        if verdict.start is None:
            return False
        node, number = verdict.start, state.next_attempt
        self._then(ev.Started(at, number, *node.place), events)
        commands.append(Start(number, node.action, node.node.args))
        return True

    def _stop(
        self,
        attempt: Attempt,
        reason: str,
        at: float,
        events: list[ev.Event],
        commands: list[Command],
    ) -> None:
        self._then(ev.CancelAsked(at, attempt.number, reason), events)
        commands.append(Stop(attempt.number, attempt.node.action.cancel, reason))

    def _then(self, event: ev.Event, events: list[ev.Event]) -> None:
        self.state.apply(event)
        events.append(event)

    def _allocations(self, calls: Sequence[Call], at: float, first: int) -> list[ev.Event]:
        for call in calls:
            self.state.plan(call.schema, call.args)  # refuses before anything changes
        digest = self.repository.digest
        return [
            ev.Allocated(
                at, first + offset, call.schema, tuple(call.args), float(call.priority), digest
            )
            for offset, call in enumerate(calls)
        ]

    # What may be believed

    def _believed(
        self, attempt: Attempt, report: Report
    ) -> tuple[tuple[Change, ...], Outcome, str]:
        action, binding = attempt.node.action, attempt.node.node.binding
        declared = [key_of(fact, binding) for fact in action.sets]
        foreign = [key for key, _ in report.facts if key not in declared]
        if foreign:
            reason = f"changed facts that it does not declare: {', '.join(foreign)}"
            return (), Outcome.UNDECLARED, reason
        wrong = [problem for change in report.facts if (problem := self._declared.misfit(change))]
        if wrong:
            return (), Outcome.UNDECLARED, "; ".join(map(str, wrong))
        outcome = report.outcome
        if outcome is Outcome.CANCELLED and attempt.cancel == TIMED_OUT:
            outcome = Outcome.TIMEOUT
        return tuple(report.facts), outcome, report.reason

    def _tree(self, number: int) -> LiveTree:
        tree = self.state.trees.get(number)
        if tree is None:
            exists = did_you_mean(str(number), map(str, self.state.trees))
            raise TaskError("", [Problem("trees", f"no tree {number}", exists=exists)])
        return tree
