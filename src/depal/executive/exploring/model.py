"""An allocated task as a transition system: what may happen in a state, and what comes of it.

Time is left out, and so is emphasis: whatever order priorities and durations could produce is
among the orders that are walked. What the engine promises is kept: claims are all or nothing,
a task that keeps a resource shares it with nobody outside, every change is one event.
"""

from collections.abc import Collection, Iterable, Iterator, Mapping
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import combinations, product
from math import prod

from depal.executive.conditions import Binding, Lasting, Value, at_once, holds, key_of, lasting_of
from depal.executive.exploring.domains import Domains, domains_of, lasting_key
from depal.executive.exploring.grounding import (
    NodeConditions,
    conditions_of,
    declaration_of,
    grounded,
    sorts_of,
)
from depal.executive.schema import Action, FactDeclaration, Repository, Task
from depal.executive.tree import Node, Standing, Tree, sweep

Facts = tuple[Value, ...]
"""The value of every fact of the model, in the order of its keys."""

MOST_FACTS = 2
"""How many facts are set at the most so that a task has something to do."""

LARGEST_EFFECT = 1_024
"""Of an action that sets more combinations, only the facts of its postcondition are varied."""


@dataclass(frozen=True, slots=True)
class Primitive:
    """A concrete node.

    Attributes:
        node: in the tree.
        action: its schema.
        changes: the facts that it may change.
        sets: the places of those that anything in the tree depends on.
    """

    node: Node
    action: Action
    changes: tuple[str, ...]
    sets: tuple[int, ...]


@dataclass(frozen=True, slots=True)
class View:
    """What the conditions say of one valuation.

    Attributes:
        standings: of all nodes.
        open: the primitives that may run, as places in `Model.primitives`.
    """

    standings: tuple[Standing, ...]
    open: frozenset[int]

    @property
    def accomplished(self) -> bool:
        """Whether the root is."""
        return self.standings[0].post


class Model:
    """A tree with everything that is the same in all its states.

    Attributes:
        tree: the allocated task.
        keys: the facts that anything in the tree depends on.
        domains: the values of each.
        primitives: the concrete nodes, in the order of the tree.
        world: the places of the facts that no primitive of the tree sets.
    """

    def __init__(self, repository: Repository, tree: Tree) -> None:
        """Grounds all conditions of the tree, which must have no mistakes in them."""
        self.tree = tree
        self.resources = repository.resources
        self.conditions: list[NodeConditions] = conditions_of(repository, tree)
        self.declared: dict[str, FactDeclaration] = {}
        for condition in (one for node in self.conditions for one in node):
            self.declared |= condition.facts
        every = [one for node in self.conditions for one in node]
        self.domains: Domains = domains_of(every, {})
        self.keys = tuple(self.domains)
        self._place = {key: place for place, key in enumerate(self.keys)}
        self.lasting = {
            self._place[lasting_key(part)]: part
            for one in every
            for part in lasting_of(one.condition)
        }
        self.primitives = tuple(self._primitive(repository, n) for n in tree.nodes if n.concrete)
        set_by_somebody = {place for one in self.primitives for place in one.sets}
        self.world = tuple(
            place
            for place in range(len(self.keys))
            if place not in set_by_somebody and place not in self.lasting
        )
        self._views: dict[Facts, View] = {}
        self._effects: dict[tuple[int, Facts], tuple[Facts, ...]] = {}

    def _primitive(self, repository: Repository, node: Node) -> Primitive:
        action = node.schema
        if not isinstance(action, Action):
            raise TypeError(action.name)
        keys = dict.fromkeys(
            key_of(fact, node.binding)
            for fact in action.sets
            if declaration_of(repository, fact, sorts_of(action)) is not None
        )
        sets = tuple(self._place[key] for key in keys if key in self._place)
        return Primitive(node, action, tuple(keys), sets)

    @cached_property
    def unset(self) -> Facts:
        """Nothing is known and nothing holds."""
        return tuple(values[0] for values in self.domains.values())

    def starts(self) -> list[Facts]:
        """Unset; where that leaves the root nothing to do, with the fewest facts that change it."""
        if not self.view(self.unset).accomplished:
            return [self.unset]
        for size in range(1, MOST_FACTS + 1):
            found = [one for one in self._with(size) if self.view(one).standings[0].gate]
            if found:
                return found
        return [self.unset]

    def _with(self, size: int) -> Iterator[Facts]:
        """Every valuation with so many facts set."""
        places = (place for place in range(len(self.keys)) if place not in self.lasting)
        for chosen in combinations(places, size):
            for values in product(*(self.domains[self.keys[place]][1:] for place in chosen)):
                yield self.settled(changed(self.unset, dict(zip(chosen, values, strict=True))))

    def facts_from(self, given: Mapping[str, Value]) -> Facts:
        """A valuation in which all but the given facts are unset; others are ignored."""
        return self.settled(
            tuple(given.get(k, unset) for k, unset in zip(self.keys, self.unset, strict=True))
        )

    def named(self, facts: Facts) -> dict[str, Value]:
        """A valuation by name."""
        return dict(zip(self.keys, facts, strict=True))

    def place_of(self, key: str) -> int:
        """The place of a fact."""
        return self._place[key]

    def settled(self, facts: Facts) -> Facts:
        """The same valuation where time conditions are off whose part does not hold."""
        for place, part in self.lasting.items():
            if facts[place] and not holds(part.part, self.named(facts), {}, self._lasted(facts)):
                facts = changed(facts, {place: False})
        return facts

    def _lasted(self, facts: Facts) -> "_Lasted":
        return _Lasted(self.named(facts))

    def view(self, facts: Facts) -> View:
        """The standing of every node."""
        found = self._views.get(facts)
        if found is None:
            standings = tuple(sweep(self.tree, self.named(facts), self._lasted(facts)))
            gates = (standings[one.node.index].gate for one in self.primitives)
            found = View(standings, frozenset(place for place, gate in enumerate(gates) if gate))
            self._views[facts] = found
        return found

    def effects(self, place: int, facts: Facts) -> tuple[Facts, ...]:
        """Every way in which a primitive can succeed: what it may set, so that its until holds."""
        found = self._effects.get((place, facts))
        if found is None:
            found = tuple(dict.fromkeys(self._succeed(self.primitives[place], facts)))
            self._effects[place, facts] = found
        return found

    def _succeed(self, primitive: Primitive, facts: Facts) -> Iterator[Facts]:
        until = self.conditions[primitive.node.index].until
        places = primitive.sets
        if prod(len(self.domains[self.keys[place]]) for place in places) > LARGEST_EFFECT:
            places = tuple(place for place in places if self.keys[place] in until.facts)
        choices = [self.settable(place, facts) for place in places]
        times = [self._place[lasting_key(part)] for part in lasting_of(until.condition)]
        for values in product(*choices):
            after = changed(facts, dict(zip(places, values, strict=True)))
            if holds(until.condition, self.named(after), {}, at_once):
                yield self.settled(changed(after, dict.fromkeys(times, True)))

    def settable(self, place: int, facts: Facts) -> tuple[Value, ...]:
        """The values that a fact may be given: empty only where it may become empty."""
        key = self.keys[place]
        optional = self.declared[key].type.optional or facts[place] is None
        return tuple(value for value in self.domains[key] if value is not None or optional)

    def time_passes(self, facts: Facts) -> Iterator[tuple[str, Facts]]:
        """Every time condition whose part holds and whose time is not yet over."""
        for place, part in self.lasting.items():
            if not facts[place] and holds(part.part, self.named(facts), {}, self._lasted(facts)):
                yield self.keys[place], changed(facts, {place: True})

    def difference(self, before: Facts, after: Facts) -> dict[str, Value]:
        """The facts that changed, time conditions left out."""
        return {
            key: new
            for place, (key, old, new) in enumerate(zip(self.keys, before, after, strict=True))
            if old != new and place not in self.lasting
        }

    def keepers_of(self, node: Node, resource: str) -> list[int]:
        """The nodes above one, nearest first, that keep a resource."""
        found = []
        above = node.parent
        while above >= 0:
            schema = self.tree.nodes[above].schema
            if isinstance(schema, Task) and resource in schema.keeps:
                found.append(above)
            above = self.tree.nodes[above].parent
        return found

    def is_within(self, index: int, ancestor: int) -> bool:
        """Whether a node is another one or stands below it."""
        while index > ancestor:
            index = self.tree.nodes[index].parent
        return index == ancestor

    def places_of(self, names: Collection[str]) -> dict[str, list[int]]:
        """The places of facts that are given as in "b1.taken" or, of every thing, "Box.taken"."""
        return {
            name: [
                place
                for place, key in enumerate(self.keys)
                if key == name or (key in self.declared and self.declared[key].name == name)
            ]
            for name in names
        }


class _Lasted:
    """Tells of a time condition what the valuation says of it."""

    def __init__(self, named: Mapping[str, Value]) -> None:
        self.named = named

    def __call__(self, condition: Lasting, binding: Binding) -> bool:
        """Whether its time has passed."""
        inner = replace(condition, part=grounded(condition.part, binding))
        return bool(self.named[lasting_key(inner)])


def changed(facts: Facts, new: Mapping[int, Value]) -> Facts:
    """A valuation with some facts replaced."""
    if not new:
        return facts
    listed = list(facts)
    for place, value in new.items():
        listed[place] = value
    return tuple(listed)


def words(changes: Iterable[tuple[str, Value]]) -> str:
    """Changes as they are read: "b1.taken := true, b1.target := reader"."""
    return ", ".join(f"{key} := {shown(value)}" for key, value in changes)


def shown(value: Value) -> str:
    """A value as it is written."""
    if value is None:
        return "empty"
    if isinstance(value, bool):
        return str(value).lower()
    return f"{value:g}" if isinstance(value, float | int) else value
