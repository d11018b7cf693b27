"""The executive's state: what folding the events gives.

`State.apply` alone changes it, and depends on nothing but the event; so the running engine and
a restart that folds the journal agree, event by event.
"""

from collections.abc import Callable, Iterable
from typing import cast

from depal.executive import events as ev
from depal.executive.compiled import Compiler, Span, Watch, always
from depal.executive.conditions import Binding, Key, Lasting, Value, lasting_of
from depal.executive.emphasis import EmphasisWeights, rank
from depal.executive.events import Change, Outcome
from depal.executive.holdings import Holdings
from depal.executive.nodes import Attempt, LiveNode, LiveTree
from depal.executive.schema import Action, Cancel, Repository, Schema
from depal.executive.spans import Spans
from depal.executive.timers import Timers
from depal.executive.tree import Standing, Tree, ground, sweep
from depal.executive.waiting import Waiting
from depal.executive.watching import POST, PRE, Watchers

FAULT, ATTEMPTS = "fault", "attempts"
"""Facts that the engine itself writes, where they are declared."""

CANCEL_GRACE = 10.0
"""So long may an attempt take to stop before that is a fault [s]."""


class State:
    """Facts, trees and attempts.

    Attributes:
        repository: the schemata.
        weights: of the emphasis.
        facts: what is the case; empty and false facts may be left out.
        changed_at: since when each fact is as it is [s].
        trees: what is allocated, by number.
        attempts: what runs, by number.
        waiting: what may run and does not.
        holdings: who uses what.
        held: whether nothing may start.
        now: the time of the last event [s].
        next_tree: the number of the next tree.
        next_attempt: the number of the next attempt.
        orphans: running attempts whose gate has closed and that were not asked to stop.
        overdue: running attempts whose time-out has passed and that were not asked to stop.
        spans: the time conditions of the trees.
        touched: trees of which something has changed since somebody took them.
    """

    def __init__(self, repository: Repository, weights: EmphasisWeights) -> None:
        """Nothing is allocated and nothing is the case."""
        self.repository = repository
        self.weights = weights
        self.facts: dict[Key, Value] = {}
        self.changed_at: dict[Key, float] = {}
        self.trees: dict[int, LiveTree] = {}
        self.attempts: dict[int, Attempt] = {}
        self.waiting = Waiting()
        self.holdings = Holdings(repository.resources)
        self.held = False
        self.now = 0.0
        self.next_tree = 1
        self.next_attempt = 1
        self.orphans: dict[int, Attempt] = {}
        self.overdue: dict[int, Attempt] = {}
        self.touched: dict[int, None] = {}
        self._watchers = Watchers()
        self._faulted: dict[Key, list[LiveNode]] = {}
        self._timers: Timers[Span | LiveNode | Attempt] = Timers(self._is_stale)
        self._timed_schemata: dict[str, tuple[Lasting, ...]] = {}
        self._fold = self._folders()
        self.spans = Spans()
        self._compiler = Compiler(self.facts, self.spans.of)
        self.spans.compiler = self._compiler
        self._own_facts = {
            declaration.attribute
            for declaration in repository.facts.values()
            if declaration.attribute in {FAULT, ATTEMPTS}
        }

    # Reading

    def standings(self, tree: LiveTree) -> list[Standing]:
        """The states of a tree's nodes, swept from scratch."""
        plain = Tree(tuple(node.node for node in tree.nodes))
        return sweep(plain, self.facts, self.has_lasted)

    def has_lasted(self, condition: Lasting, binding: Binding) -> bool:
        """Whether a time condition's part has held for long enough."""
        span = self.spans.find(condition, binding)
        return span is not None and span.value

    def next_timer(self) -> float | None:
        """When the next `Ticked` is due [s]; None where nothing waits for time."""
        return self._timers.next()

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

    # Recalling a snapshot

    def recall(
        self, node: LiveNode, failures: int, retry_at: float, since: float, *, faulted: bool
    ) -> None:
        """Gives a node back what a snapshot kept of it."""
        node.failures, node.retry_at, node.faulted = failures, retry_at, faulted
        self.waiting.drop(node)
        if faulted:
            self._faulted.setdefault(self._own_key(node, FAULT), []).append(node)
        elif node.gate:
            self._wait(node)
        node.waiting_since = since
        if self.waiting.waits(node):
            self.waiting.put(node, rank(node, self.weights))

    def adopt(self, attempt: Attempt) -> None:
        """Gives a node back the attempt that ran."""
        node = attempt.node
        self.waiting.drop(node)
        self.attempts[attempt.number] = attempt
        node.attempt = attempt.number
        node.tree.running[attempt.number] = node
        self.holdings.use(attempt.number, node)
        if attempt.deadline is not None:
            self._timers.set(attempt.deadline, attempt)

    # Trees

    def _allocate(self, event: ev.Allocated) -> None:
        plain = ground(self.repository, event.schema, event.args)
        tree = LiveTree(event.tree, [], event.priority, event.digest)
        for node in plain.nodes:
            parent = tree.nodes[node.parent] if node.parent >= 0 else None
            action = cast("Action", node.schema)
            live = LiveNode(node, action, tree, (event.tree, node.index), parent)
            tree.nodes.append(live)
            if parent is not None:
                parent.children.append(live)
            for lasting in self._timed(node.schema):
                self._measure(self.spans.use(tree, lasting, node.binding))
            for lasting in lasting_of(node.edge):
                self._measure(self.spans.use(tree, lasting, node.edge_binding))
        self.trees[event.tree] = tree
        self.next_tree = event.tree + 1
        self.touched[event.tree] = None
        self._wake(tree.root)

    def _withdraw(self, event: ev.Withdrawn) -> None:
        tree = self.trees[event.tree]
        tree.withdrawn = event.reason
        self.touched[tree.number] = None
        self._regate(tree.root)

    def _archive(self, event: ev.Archived) -> None:
        tree = self.trees[event.tree]
        self._sleep(tree.root)
        self.touched[tree.number] = None
        self.spans.release(tree)
        for nodes in self._faulted.values():
            nodes[:] = [node for node in nodes if node.tree is not tree]
        del self.trees[tree.number]

    def _prioritise(self, event: ev.Prioritised) -> None:
        tree = self.trees[event.tree]
        tree.priority = event.priority
        self.touched[tree.number] = None
        for node in self.waiting.of_tree(tree.number):
            self.waiting.put(node, rank(node, self.weights))

    def _timed(self, schema: Schema) -> tuple[Lasting, ...]:
        """The time conditions of a schema itself."""
        found = self._timed_schemata.get(schema.name)
        if found is None:
            found = (*lasting_of(schema.when), *lasting_of(schema.until))
            self._timed_schemata[schema.name] = found
        return found

    # Gates

    def _wake(self, node: LiveNode) -> None:
        if not node.watches[1]:
            self._compile(node)
        node.awake = True
        self._watchers.watch(node)
        node.holds_pre, node.holds_post = node.pre(), node.post()
        self._regate(node)

    def _sleep(self, node: LiveNode) -> None:
        if not node.awake:
            return
        node.awake = False
        self._watchers.unwatch(node)
        if node.gate:
            node.gate = False
            self._closed(node)

    def _compile(self, node: LiveNode) -> None:
        plain, ground = node.node, self._compiler.ground
        edge, edge_watches = ground(plain.edge, plain.edge_binding)
        own, own_watches = ground(plain.schema.when, plain.binding)
        if own is always:
            node.pre = edge
        else:
            node.pre = own if edge is always else lambda: edge() and own()
        node.post, post_watches = ground(plain.schema.until, plain.binding)
        node.watches = (edge_watches + own_watches, post_watches)

    def _regate(self, node: LiveNode) -> None:
        gate = (
            node.awake
            and node.holds_pre
            and not node.holds_post
            and (node.parent is None or node.parent.gate)
            and node.tree.withdrawn is None
        )
        if gate == node.gate:
            return
        node.gate = gate
        if gate:
            self._opened(node)
        else:
            self._closed(node)

    def _opened(self, node: LiveNode) -> None:
        if node.node.concrete:
            if node.attempt is not None:
                self.orphans.pop(node.attempt, None)
            self._wait(node)
        for child in node.children:
            self._wake(child)

    def _closed(self, node: LiveNode) -> None:
        if node.node.concrete:
            self.waiting.drop(node)
            if node.attempt is not None:
                attempt = self.attempts[node.attempt]
                if attempt.cancel is None and node.action.cancel is not Cancel.NEVER:
                    self.orphans[attempt.number] = attempt
            return
        self.holdings.stop_keeping(node)
        for child in node.children:
            self._sleep(child)

    def _wait(self, node: LiveNode) -> None:
        if node.attempt is not None or node.faulted:
            return
        if node.retry_at > self.now:
            self._timers.set(node.retry_at, node)
            return
        node.waiting_since = self.now
        self.waiting.put(node, rank(node, self.weights))

    # Facts

    def _change(self, changes: Iterable[Change]) -> None:
        """Changes facts together, then evaluates what they can have changed."""
        watches: dict[Watch, None] = {}
        cleared: list[Key] = []
        for key, value in changes:
            before = self.facts.get(key)
            if before == value and type(before) is type(value):
                continue
            self.facts[key] = value
            self.changed_at[key] = self.now
            watches[key] = watches[key, before] = watches[key, value] = None
            if value is None and key in self._faulted:
                cleared.append(key)
        if watches:
            self._settle(watches)
        for key in cleared:
            for node in self._faulted.pop(key):
                self._forgive(node)

    def _settle(self, watches: dict[Watch, None]) -> None:
        todo: list[Watch] = list(watches)
        while todo:
            # A time condition may stand inside another: inner ones first, then who waits.
            spans = self.spans.concerned(todo)
            todo = [span.key for span in spans if self._measure(span)]
            watches.update(dict.fromkeys(todo))
        stirred: dict[tuple[int, int], LiveNode] = {}
        for (tree, index, side), node in self._watchers.nodes(watches):
            if side == PRE:
                value = node.pre()
                changed, node.holds_pre = value != node.holds_pre, value
            elif side == POST:
                value = node.post()
                changed, node.holds_post = value != node.holds_post, value
                if changed and value:
                    node.failures = 0
            else:
                continue
            if changed:
                stirred[tree, index] = node
                self.touched[tree] = None
        for node in stirred.values():
            if node.awake:
                self._regate(node)

    # Time

    def _measure(self, span: Span) -> bool:
        """Brings a time condition up to date; whether its value has changed."""
        before = span.value
        if not span.part():
            span.since, span.value = None, False
        else:
            if span.since is None:
                span.since = self.now
            span.value = self.now >= span.since + span.seconds
            if not span.value:
                self._timers.set(span.since + span.seconds, span)
        return span.value != before

    def _is_stale(self, at: float, what: Span | LiveNode | Attempt) -> bool:
        """Whether a timer waits for something that has gone."""
        if isinstance(what, Span):
            if not what.users or what.since is None or what.value:
                return True
            return what.since + what.seconds != at
        if isinstance(what, LiveNode):
            idle = what.gate and what.attempt is None and not what.faulted
            return not idle or what.retry_at != at or self.waiting.waits(what)
        return self.attempts.get(what.number) is not what or what.deadline != at

    def _tick(self, _: ev.Ticked) -> None:
        changed: dict[Watch, None] = {}
        for what in self._timers.due(self.now):
            if isinstance(what, LiveNode):
                self._wait(what)
            elif isinstance(what, Attempt):
                self._late(what)
            elif self._measure(what):
                changed[what.key] = None
        if changed:
            self._settle(changed)

    def _doubt(self, attempt: Attempt) -> None:
        action = attempt.node.action
        attempt.in_doubt = not action.idempotent
        if action.timeout is not None:
            self._set_deadline(attempt, self.now + action.timeout)

    def _set_deadline(self, attempt: Attempt, at: float) -> None:
        attempt.deadline = at
        self._timers.set(at, attempt)

    def _late(self, attempt: Attempt) -> None:
        attempt.deadline = None
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
        self.touched[event.tree] = None
        self.waiting.drop(node)
        self.holdings.take(event.attempt, node)
        if action.timeout is not None:
            self._set_deadline(attempt, self.now + action.timeout)

    def _ask_to_stop(self, event: ev.CancelAsked) -> None:
        attempt = self.attempts[event.attempt]
        attempt.cancel = event.reason
        self.orphans.pop(event.attempt, None)
        self.overdue.pop(event.attempt, None)
        if attempt.node.action.cancel is Cancel.NEVER:
            self._raise_fault(attempt.node)
        else:
            self._set_deadline(attempt, self.now + CANCEL_GRACE)

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
        succeeded = node.post()
        if event.outcome is Outcome.UNKNOWN:
            self._raise_fault(node)
        elif succeeded:
            node.failures = 0
            self._write(node, ATTEMPTS, None)
        elif event.outcome not in {Outcome.CANCELLED, Outcome.PROBED}:
            self._fail(node)
        if node.gate:
            self._wait(node)

    def _fail(self, node: LiveNode) -> None:
        node.failures += 1
        self._write(node, ATTEMPTS, float(node.failures))
        if node.failures > node.action.retries:
            self._raise_fault(node)
        else:
            node.retry_at = self.now + node.action.backoff * 2 ** (node.failures - 1)

    def _raise_fault(self, node: LiveNode) -> None:
        node.faulted = True
        self.waiting.drop(node)
        self._faulted.setdefault(self._own_key(node, FAULT), []).append(node)
        self._write(node, FAULT, node.action.name)

    def _forgive(self, node: LiveNode) -> None:
        node.faulted, node.failures, node.retry_at = False, 0, 0.0
        if node.gate:
            self._wait(node)

    def _own_key(self, node: LiveNode, attribute: str) -> Key:
        return f"{node.node.args[0] if node.node.args else node.action.name}.{attribute}"

    def _write(self, node: LiveNode, attribute: str, value: Value) -> None:
        key = self._own_key(node, attribute)
        if attribute in self._own_facts and self.facts.get(key) != value:
            self._change(((key, value),))
