"""Continuous evaluation: facts, trees, and which nodes may run.

A tree knows which of its atoms are true; its task's plan knows what that means. A change of facts
tests the atoms that wait for it, looks up what the new set means, and passes on which gates have
moved. Atoms that a tree shares with others, such as those about the arm, are watched only while a
node mentions them whose parent may run. So a change costs what it touches.

What follows for primitives is for the subclass.
"""

from collections.abc import Iterable
from typing import cast

from depal.executive.atoms import members
from depal.executive.conditions import Key, Value
from depal.executive.events import Change
from depal.executive.nodes import LiveNode, LiveTree
from depal.executive.plan import SHUT, Gates, Plan
from depal.executive.schema import Action, Repository
from depal.executive.spans import Span, Spans
from depal.executive.tree import Standing, Tree, ground, sweep
from depal.executive.watching import Move, Watchers


class Evaluation:
    """Facts and trees, evaluated incrementally.

    Attributes:
        repository: the schemata.
        facts: what is the case; empty and false facts may be left out.
        changed_at: since when each fact is as it is [s].
        trees: what is allocated, by number.
        spans: the time conditions of the trees.
        now: the time of the last event [s].
        touched: trees that may have ended since somebody took them.
    """

    def __init__(self, repository: Repository) -> None:
        """Nothing is allocated and nothing is the case."""
        self.repository = repository
        self.facts: dict[Key, Value] = {}
        self.changed_at: dict[Key, float] = {}
        self.trees: dict[int, LiveTree] = {}
        self.spans = Spans(self.facts)
        self.now = 0.0
        self.touched: dict[int, None] = {}
        self._watchers: Watchers[LiveTree] = Watchers()
        self._plans: dict[str, Plan] = {}

    # What the subclass does about it

    def _primitive_opened(self, node: LiveNode) -> None:
        """A concrete node's gate has opened."""
        raise NotImplementedError

    def _primitive_closed(self, node: LiveNode) -> None:
        """A concrete node's gate has closed."""
        raise NotImplementedError

    def _keeper_opened(self, node: LiveNode) -> None:
        """A task that keeps resources may begin to."""
        raise NotImplementedError

    def _keeper_closed(self, node: LiveNode) -> None:
        """A task that keeps resources must let them go."""
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
        return sweep(plain, self.facts, self.spans.has_lasted)

    def accomplished(self, node: LiveNode) -> bool:
        """Whether a node's postcondition holds, whoever watches it."""
        part = node.tree.plan.parts[node.place[1]]
        return part.post(self._tested(node.tree, part.decisive))

    def plan(self, schema: str, args: tuple[str, ...]) -> Plan:
        """The plan of a task.

        Raises:
            TaskError: an unknown task or a wrong number of arguments.
        """
        plan = self._plans.get(schema)
        if plan is None or plan.arity != len(args):
            ground(self.repository, schema, args)  # says what is wrong, if anything is
            plan = self._plans[schema] = Plan(self.repository, schema, self.facts)
        return plan

    # Trees

    def _plant(
        self, number: int, schema: str, args: tuple[str, ...], priority: float, digest: str
    ) -> None:
        """Grounds a task and watches over it."""
        plan = self.plan(schema, args)
        plain = plan.stamp.nodes(args)
        spans = [
            self.spans.use(lasting, plain[at].edge_binding if on_edge else plain[at].binding)
            for lasting, at, on_edge in plan.timed
        ]
        for span in spans:
            self._measure(span)
        nodes: list[LiveNode] = []
        tree = LiveTree(number, plan, plan.subject(args, spans), nodes, priority, digest)
        for node in plain:
            parent = nodes[node.parent] if node.parent >= 0 else None
            action = cast("Action", node.schema)
            nodes.append(LiveNode(node, action, tree, (number, node.index), parent))
        self.trees[number] = tree
        self.touched[number] = None
        self._watch(tree, plan.own)
        self._turn(tree, self._tested(tree, plan.own))

    def _uproot(self, tree: LiveTree) -> None:
        """Takes a tree away."""
        self._shut(tree)
        self.spans.release(tree.subject.spans)
        del self.trees[tree.number]
        tree.nodes.clear()  # they point back to it, and would be garbage for a collector only

    def _shut(self, tree: LiveTree) -> None:
        """Nothing of a tree may run any more."""
        self._unwatch(tree, tree.watched)
        self._move(tree, SHUT)

    # Gates

    def _turn(self, tree: LiveTree, true: int) -> None:
        """Other atoms of a tree are true: watches what matters now, and moves the gates."""
        plan = tree.plan
        gates = plan.gates(true)
        fulfilled = gates.accomplished & tree.gates.awake & ~tree.gates.accomplished
        for index in members(fulfilled & plan.concrete):
            tree.nodes[index].failures = 0
        needed = plan.own | gates.needed
        while tree.watched != needed:
            # What is new may open more gates; only then is it known what is not needed any more.
            fresh = needed & ~tree.watched
            if fresh:
                self._watch(tree, fresh)
                true |= self._tested(tree, fresh)
            else:
                self._unwatch(tree, tree.watched & ~needed)
                true &= needed
            gates = plan.gates(true)
            needed = plan.own | gates.needed
        tree.true = true
        self._move(tree, gates)

    def _move(self, tree: LiveTree, gates: Gates) -> None:
        """The gates of a tree become others, and whom it concerns is told."""
        moves = tree.plan.moves(tree.gates, gates)
        tree.gates = gates
        for index, opened, concrete in moves:
            node = tree.nodes[index]
            if concrete:
                (self._primitive_opened if opened else self._primitive_closed)(node)
            else:
                (self._keeper_opened if opened else self._keeper_closed)(node)

    def _tested(self, tree: LiveTree, atoms: int) -> int:
        """Those of the atoms that are true now."""
        found, subject = 0, tree.subject
        for number in members(atoms):
            if tree.plan.atoms[number].test(subject):
                found |= 1 << number
        return found

    def _watch(self, tree: LiveTree, atoms: int) -> None:
        watches = tree.subject.watches
        for number in members(atoms):
            self._watchers.watch(watches[number], (tree.number, number), tree)
        tree.watched |= atoms

    def _unwatch(self, tree: LiveTree, atoms: int) -> None:
        watches = tree.subject.watches
        for number in members(atoms):
            self._watchers.unwatch(watches[number], (tree.number, number))
        tree.watched &= ~atoms

    # Facts

    def _change(self, changes: Iterable[Change]) -> None:
        """Changes facts together, then evaluates what they can have changed."""
        moves: list[Move] = []
        facts = self.facts
        for key, value in changes:
            before = facts.get(key)
            if before == value and type(before) is type(value):
                continue
            if value is None:
                del facts[key]
            else:
                facts[key] = value
            self.changed_at[key] = self.now
            moves.append(Move(key, before, value))
        if moves:
            self._settle(moves)
            for key, _, after in moves:
                if after is None:
                    self._fact_emptied(key)

    def _settle(self, moves: list[Move]) -> None:
        """Tests what changes of facts can have changed."""
        if self.spans:
            moves += self._measured(moves)
        turned: dict[LiveTree, int] = {}
        for (_, number), tree in self._watchers.told(moves):
            true = turned.get(tree, tree.true) & ~(1 << number)
            if tree.plan.atoms[number].test(tree.subject):
                true |= 1 << number
            turned[tree] = true
        for tree, true in turned.items():
            if true != tree.true:
                self.touched[tree.number] = None
                self._turn(tree, true)

    def _measured(self, moves: list[Move]) -> list[Move]:
        """The time conditions that have another value, and those that stand around them."""
        found: list[Move] = []
        while moves:
            moves = [Move(s.key) for s in self.spans.concerned(moves) if self._measure(s)]
            found += moves
        return found

    def _measure(self, span: Span) -> bool:
        """Brings a time condition up to date; whether its value has changed."""
        before = span.value
        if not self.spans.holds(span):
            span.since, span.value = None, False
        else:
            if span.since is None:
                span.since = self.now
            due = span.since + span.condition.seconds
            span.value = self.now >= due
            if not span.value and span.due != due:
                span.due = due
                self._call_at(due, span)
        return span.value != before
