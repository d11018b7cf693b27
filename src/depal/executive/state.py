"""The executive's state: what folding the events gives.

`State.apply` alone changes it, and depends on nothing but the event; so the running engine and
a restart that folds the journal agree, event by event.
"""

from collections.abc import Callable

from depal.executive import events as ev
from depal.executive.conditions import Key, Value
from depal.executive.emphasis import EmphasisWeights, rank
from depal.executive.evaluation import Evaluation
from depal.executive.events import Outcome
from depal.executive.faults import ATTEMPTS, FAULT, Faults, own_key
from depal.executive.holdings import Holdings
from depal.executive.nodes import Attempt, LiveNode
from depal.executive.schema import Cancel, Repository
from depal.executive.spans import Span
from depal.executive.timers import Timers
from depal.executive.waiting import Waiting
from depal.executive.watching import Move

CANCEL_GRACE = 10.0
"""So long may an attempt take to stop before that is a fault [s]."""


class State(Evaluation):
    """Facts, trees and attempts.

    Attributes:
        weights: of the emphasis.
        attempts: what runs, by number.
        waiting: what may run and does not.
        holdings: who uses what.
        faults: what is not tried again until somebody clears its fault.
        held: whether nothing may start.
        next_tree: the number of the next tree.
        next_attempt: the number of the next attempt.
        orphans: running attempts whose gate has closed and that were not asked to stop.
        overdue: running attempts whose time-out has passed and that were not asked to stop.
    """

    def __init__(self, repository: Repository, weights: EmphasisWeights) -> None:
        """Nothing is allocated and nothing is the case."""
        super().__init__(repository)
        self.weights = weights
        self.attempts: dict[int, Attempt] = {}
        self.waiting = Waiting()
        self.holdings = Holdings(repository.resources)
        self.held = False
        self.next_tree = 1
        self.next_attempt = 1
        self.orphans: dict[int, Attempt] = {}
        self.overdue: dict[int, Attempt] = {}
        self.faults = Faults()
        self._timers: Timers[Span | LiveNode | Attempt] = Timers(self._is_stale)
        self._fold = self._folders()
        self._own_facts = {
            declaration.attribute
            for declaration in repository.facts.values()
            if declaration.attribute in {FAULT, ATTEMPTS}
        }

    def next_timer(self) -> float | None:
        """When the next `Ticked` is due [s]; None where nothing waits for time."""
        return self._timers.next()

    def is_due(self, now: float) -> bool:
        """Whether a `Ticked` is due."""
        return self._timers.any_due(now)

    # Changing

    def apply(self, event: ev.Event) -> None:
        """Folds one event in."""
        self.now = event.at
        self._fold[type(event)](event)

    def _folders(self) -> dict[type[ev.Event], Callable[..., None]]:
        return {
            ev.Changed: lambda event: self._change(event.facts),
            ev.Started: self._start,
            ev.Ended: self._end,
            ev.Allocated: self._allocate,
            ev.CancelAsked: self._ask_to_stop,
            ev.Prioritised: self._prioritise,
            ev.Withdrawn: self._withdraw,
            ev.Archived: self._archive,
            ev.Retried: lambda event: self._forgive(self.trees[event.tree].nodes[event.node]),
            ev.Ticked: self._tick,
            ev.ModeChanged: self._set_mode,
            ev.Restarted: self._restart,
        }

    def _set_mode(self, event: ev.ModeChanged) -> None:
        self.held = event.held

    def _restart(self, _: ev.Restarted) -> None:
        self.held = True
        for attempt in self.attempts.values():
            self._doubt(attempt)

    # Trees

    def _allocate(self, event: ev.Allocated) -> None:
        self._plant(event.tree, event.schema, event.args, event.priority, event.digest)
        self.next_tree = event.tree + 1

    def _withdraw(self, event: ev.Withdrawn) -> None:
        tree = self.trees[event.tree]
        tree.withdrawn = event.reason
        self.touched[tree.number] = None
        self._shut(tree)

    def _archive(self, event: ev.Archived) -> None:
        tree = self.trees[event.tree]
        self.faults.forget(tree)
        self._uproot(tree)

    def _prioritise(self, event: ev.Prioritised) -> None:
        tree = self.trees[event.tree]
        tree.priority = event.priority
        for node in self.waiting.of_tree(tree.number):
            self.waiting.put(node, rank(node, self.weights))

    # What follows from evaluation

    def _primitive_opened(self, node: LiveNode) -> None:
        if node.attempt is not None:
            attempt = self.attempts[node.attempt]
            self.orphans.pop(attempt.number, None)
            if attempt.cancel is None and node.action.timeout is not None:
                # Time in which it may not go on is not its own.
                self.set_deadline(attempt, self.now + node.action.timeout)
        self.wait(node)

    def _primitive_closed(self, node: LiveNode) -> None:
        self.waiting.drop(node)
        if node.attempt is not None:
            attempt = self.attempts[node.attempt]
            if attempt.cancel is None and node.action.cancel is not Cancel.NEVER:
                self.orphans[attempt.number] = attempt

    def _keeper_opened(self, node: LiveNode) -> None:
        self.holdings.keep_again(node)

    def _keeper_closed(self, node: LiveNode) -> None:
        self.holdings.stop_keeping(node)

    def _fact_emptied(self, key: Key) -> None:
        for node in self.faults.cleared(key):
            self._forgive(node)

    def _call_at(self, at: float, span: Span) -> None:
        self._timers.set(at, span)

    def wait(self, node: LiveNode) -> None:
        """A primitive may run, unless it runs already or must not be tried again yet."""
        if node.attempt is not None or node.faulted:
            return
        if node.retry_at > self.now:
            self._timers.set(node.retry_at, node)
            return
        node.waiting_since = self.now
        self.waiting.put(node, rank(node, self.weights))

    # Time

    def _is_stale(self, at: float, what: Span | LiveNode | Attempt) -> bool:
        """Whether a timer waits for something that has gone."""
        if isinstance(what, Span):
            if not what.users or what.since is None or what.value:
                return True
            return what.elapsed_at() != at
        if isinstance(what, LiveNode):
            idle = what.gate and what.attempt is None and not what.faulted
            return not idle or what.retry_at != at or self.waiting.waits(what)
        return self.attempts.get(what.number) is not what or what.deadline != at

    def _tick(self, _: ev.Ticked) -> None:
        changed: list[Move] = []
        for what in self._timers.due(self.now):
            if isinstance(what, LiveNode):
                self.wait(what)
            elif isinstance(what, Attempt):
                self._late(what)
            elif self._measure(what):
                changed.append(Move(what.key))
        if changed:
            self._settle(changed)

    def _doubt(self, attempt: Attempt) -> None:
        action = attempt.node.action
        attempt.in_doubt = not action.idempotent
        if action.timeout is not None:
            self.set_deadline(attempt, self.now + action.timeout)

    def set_deadline(self, attempt: Attempt, at: float) -> None:
        """An attempt is to end until a moment [s]."""
        attempt.deadline = at
        self._timers.set(at, attempt)

    def _late(self, attempt: Attempt) -> None:
        attempt.deadline = None
        if attempt.cancel is None and attempt.node.kept and not attempt.node.gate:
            return  # it is suspended, and has its whole time again when it may go on
        if attempt.cancel is None:
            self.overdue[attempt.number] = attempt
        else:
            self._raise_fault(attempt.node)

    # Attempts

    def _start(self, event: ev.Started) -> None:
        node = self.trees[event.tree].nodes[event.node]
        action = node.action
        attempt = Attempt(event.attempt, node, self.now, None)
        self.attempts[event.attempt] = attempt
        self.next_attempt = event.attempt + 1
        node.attempt = event.attempt
        node.tree.running[event.attempt] = node
        self.waiting.drop(node)
        self.holdings.take(event.attempt, node)
        if action.timeout is not None:
            self.set_deadline(attempt, self.now + action.timeout)

    def _ask_to_stop(self, event: ev.CancelAsked) -> None:
        attempt = self.attempts[event.attempt]
        attempt.cancel = event.reason
        self.orphans.pop(event.attempt, None)
        self.overdue.pop(event.attempt, None)
        if attempt.node.action.cancel is Cancel.NEVER:
            self._raise_fault(attempt.node)
        else:
            self.set_deadline(attempt, self.now + CANCEL_GRACE)

    def _end(self, event: ev.Ended) -> None:
        attempt = self.attempts.pop(event.attempt)
        self.orphans.pop(event.attempt, None)
        self.overdue.pop(event.attempt, None)
        node = attempt.node
        node.attempt = None
        node.tree.running.pop(event.attempt)
        self.touched[node.tree.number] = None
        self.holdings.give_back(event.attempt, node)
        self._change(event.facts)
        succeeded = self.accomplished(node)
        if event.outcome is Outcome.UNKNOWN:
            self._raise_fault(node)
        elif succeeded:
            node.failures = 0
            self._write(node, ATTEMPTS, None)
        elif event.outcome not in {Outcome.CANCELLED, Outcome.PROBED}:
            self._fail(node)
        if node.gate:
            self.wait(node)

    def _fail(self, node: LiveNode) -> None:
        node.failures += 1
        self._write(node, ATTEMPTS, float(node.failures))
        if node.failures > node.action.retries:
            self._raise_fault(node)
        else:
            node.retry_at = self.now + node.action.backoff * 2 ** (node.failures - 1)

    def _raise_fault(self, node: LiveNode) -> None:
        self.faults.add(node)
        self.waiting.drop(node)
        self._write(node, FAULT, node.action.name)

    def _forgive(self, node: LiveNode) -> None:
        node.faulted, node.failures, node.retry_at = False, 0, 0.0
        if node.gate:
            self.wait(node)

    def _write(self, node: LiveNode, attribute: str, value: Value) -> None:
        if attribute not in self._own_facts:
            return
        key = own_key(node, attribute)
        if self.facts.get(key) != value:
            self._change(((key, value),))
