"""Continuous evaluation: facts, trees, and which nodes may run.

A node is awake, its conditions watched, while its parent's gate is open. Below a closed gate
nothing can run, so nothing is watched there; what is shown there is swept when somebody looks.
So a change of facts costs what it touches. What follows for primitives is for the subclass.
"""

from collections.abc import Iterable
from typing import cast

from depal.executive.compiled import Compiler, Grounded, Span, Watch, always
from depal.executive.conditions import ALWAYS, Binding, Key, Lasting, Value, lasting_of
from depal.executive.events import Change
from depal.executive.nodes import LiveNode, LiveTree
from depal.executive.schema import Action, Repository, Task
from depal.executive.spans import Spans
from depal.executive.tree import Standing, Tree, ground, sweep
from depal.executive.watching import POST, PRE, Watchers

NEVER_FALSE: Grounded = (always, ())


class Evaluation:
    """Facts and trees, evaluated incrementally.

    Attributes:
        repository: the schemata.
        facts: what is the case; empty and false facts may be left out.
        changed_at: since when each fact is as it is [s].
        trees: what is allocated, by number.
        spans: the time conditions of the trees.
        now: the time of the last event [s].
        touched: trees of which something has changed since somebody took them.
    """

    def __init__(self, repository: Repository) -> None:
        """Nothing is allocated and nothing is the case."""
        self.repository = repository
        self.facts: dict[Key, Value] = {}
        self.changed_at: dict[Key, float] = {}
        self.trees: dict[int, LiveTree] = {}
        self.spans = Spans()
        self.now = 0.0
        self.touched: dict[int, None] = {}
        self._watchers = Watchers()
        self._compiler = Compiler(self.facts, self.spans.of)
        self.spans.compiler = self._compiler
        self._timed, self._timed_edges = _time_conditions(repository)

    # What the subclass does about it

    def _primitive_opened(self, node: LiveNode) -> None:
        """A concrete node's gate has opened."""
        raise NotImplementedError

    def _primitive_closed(self, node: LiveNode) -> None:
        """A concrete node's gate has closed."""
        raise NotImplementedError

    def _task_opened(self, node: LiveNode) -> None:
        """An abstract node's gate has opened."""
        raise NotImplementedError

    def _task_closed(self, node: LiveNode) -> None:
        """An abstract node's gate has closed."""
        raise NotImplementedError

    def _fact_emptied(self, key: Key) -> None:
        """A fact has become empty."""
        raise NotImplementedError

    def _call_at(self, at: float, span: Span) -> None:
        """A time condition wants to be measured again at a moment [s]."""
        raise NotImplementedError

    # Reading

    def standings(self, tree: LiveTree) -> list[Standing]:
        """The states of a tree's nodes, swept from scratch."""
        plain = Tree(tuple(node.node for node in tree.nodes))
        return sweep(plain, self.facts, self.has_lasted)

    def has_lasted(self, condition: Lasting, binding: Binding) -> bool:
        """Whether a time condition's part has held for long enough."""
        span = self.spans.find(condition, binding)
        return span is not None and span.value

    # Trees

    def _plant(
        self, number: int, schema: str, args: tuple[str, ...], priority: float, digest: str
    ) -> None:
        """Grounds a task and wakes its root."""
        plain = ground(self.repository, schema, args)
        tree = LiveTree(number, [], priority, digest)
        for node in plain.nodes:
            parent = tree.nodes[node.parent] if node.parent >= 0 else None
            action = cast("Action", node.schema)
            live = LiveNode(node, action, tree, (number, node.index), parent)
            tree.nodes.append(live)
            if parent is not None:
                parent.children.append(live)
            if node.schema.name in self._timed:
                for lasting in self._timed[node.schema.name]:
                    self._measure(self.spans.use(tree, lasting, node.binding))
            if id(node.edge) in self._timed_edges:
                for lasting in self._timed_edges[id(node.edge)]:
                    self._measure(self.spans.use(tree, lasting, node.edge_binding))
        self.trees[number] = tree
        self.touched[number] = None
        self._wake(tree.root)

    def _uproot(self, tree: LiveTree) -> None:
        """Takes a tree away."""
        self._sleep(tree.root)
        self.touched[tree.number] = None
        self.spans.release(tree)
        del self.trees[tree.number]

    # Gates

    def _wake(self, node: LiveNode) -> None:
        if node.entries is None:
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
        node.post, post_watches = ground(plain.schema.until, plain.binding)
        edge, edge_watches = NEVER_FALSE
        if plain.edge is not ALWAYS:
            edge, edge_watches = ground(plain.edge, plain.edge_binding)
        node.pre = edge
        if plain.schema.when is not ALWAYS:
            own, own_watches = ground(plain.schema.when, plain.binding)
            node.pre = own if edge is always else lambda: edge() and own()
            edge_watches += own_watches
        before, after = (*node.place, PRE), (*node.place, POST)
        entries = [(watch, before) for watch in edge_watches]
        entries += [(watch, after) for watch in post_watches]
        node.entries = tuple(entries)

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
            self._primitive_opened(node)
            return
        self._task_opened(node)
        for child in node.children:
            self._wake(child)

    def _closed(self, node: LiveNode) -> None:
        if node.node.concrete:
            self._primitive_closed(node)
            return
        self._task_closed(node)
        for child in node.children:
            self._sleep(child)

    # Facts

    def _change(self, changes: Iterable[Change]) -> None:
        """Changes facts together, then evaluates what they can have changed."""
        watches: dict[Watch, None] = {}
        emptied: list[Key] = []
        for key, value in changes:
            before = self.facts.get(key)
            if before == value and type(before) is type(value):
                continue
            if value is None:
                self.facts.pop(key, None)
            else:
                self.facts[key] = value
            self.changed_at[key] = self.now
            watches[key] = watches[key, before] = watches[key, value] = None
            if value is None:
                emptied.append(key)
        if watches:
            self._settle(watches)
        for key in emptied:
            self._fact_emptied(key)

    def _settle(self, watches: dict[Watch, None]) -> None:
        todo: list[Watch] = list(watches) if self.spans else []
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

    def _measure(self, span: Span) -> bool:
        """Brings a time condition up to date; whether its value has changed."""
        before = span.value
        if not span.part():
            span.since, span.value = None, False
        else:
            if span.since is None:
                span.since = self.now
            span.value = self.now >= span.since + span.seconds
            due = span.since + span.seconds
            if not span.value and span.due != due:
                span.due = due
                self._call_at(due, span)
        return span.value != before


def _time_conditions(
    repository: Repository,
) -> tuple[dict[str, tuple[Lasting, ...]], dict[int, tuple[Lasting, ...]]]:
    """The schemata, by name, and the edges, by identity, that mention time; most do not."""
    own: dict[str, tuple[Lasting, ...]] = {}
    edges: dict[int, tuple[Lasting, ...]] = {}
    for name, schema in repository.schemata.items():
        found = (*lasting_of(schema.when), *lasting_of(schema.until))
        if found:
            own[name] = found
        for step in schema.steps if isinstance(schema, Task) else ():
            timed = tuple(lasting_of(step.when))
            if timed:
                edges[id(step.when)] = timed
    return own, edges
