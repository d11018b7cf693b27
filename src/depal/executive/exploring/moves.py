"""What may happen next in a state of an allocated task."""

from collections.abc import Collection, Iterator, Mapping
from dataclasses import dataclass, replace
from itertools import combinations, product
from math import prod

from depal.executive.conditions import Value
from depal.executive.exploring.claims import Claims
from depal.executive.exploring.model import Facts, Model, changed, shown, words
from depal.executive.schema import Cancel

LARGEST_WORLD = 4_096
"""Where the world may change more combinations of facts at once, it changes one at a time."""


@dataclass(frozen=True, slots=True)
class State:
    """Where a task stands.

    Attributes:
        facts: what is the case.
        running: primitives that run, in order.
        failures: how often each primitive has failed in a row.
        keepers: pairs of a task's node and a resource that it keeps.
        pending: changes that are reported but not yet in, where changes are split.
    """

    facts: Facts
    running: tuple[int, ...] = ()
    failures: tuple[int, ...] = ()
    keepers: tuple[tuple[int, str], ...] = ()
    pending: tuple[tuple[int, Value], ...] = ()


@dataclass(frozen=True, slots=True)
class Move:
    """One thing that happens.

    Attributes:
        what: as a phrase.
        after: the state that it leads to.
        started: the primitive that it starts, -1 for none.
        fault: whether it is a failure, a crash or a disturbance, which nobody may count on.
    """

    what: str
    after: State
    started: int = -1
    fault: bool = False


@dataclass(frozen=True, slots=True)
class Rules:
    """What is walked beside the normal run.

    Attributes:
        attempts: how many failures in a row are told apart at the most.
        atomic: whether a primitive's changes come as one event.
        crashes: whether the controller may stop at any moment and start again.
        disturbances: facts that change by themselves, each with the values that they take.
    """

    attempts: int = 2
    atomic: bool = True
    crashes: bool = True
    disturbances: Mapping[int, tuple[Value, ...]] | None = None


class Moves:
    """The transition relation of a model under some rules."""

    def __init__(self, model: Model, rules: Rules) -> None:
        """Looks up what is the same in all states."""
        self.model = model
        self.rules = rules
        self.claims = Claims(model)
        self.labels = tuple(one.node.label for one in model.primitives)
        self.limits = tuple(min(one.action.retries + 1, rules.attempts) for one in model.primitives)

    def first(self, facts: Facts) -> State:
        """Nothing runs."""
        return State(facts, (), (0,) * len(self.labels))

    def after(self, state: State) -> list[Move]:
        """What may happen next while the world waits; nothing once the root is accomplished."""
        if self.model.view(state.facts).accomplished:
            return []
        moves = [*self._starts(state), *self._ends(state), *self._arrivals(state)]
        moves += self._times(state)
        moves += self._person(state)
        moves += self._disturbances(state)
        if self.rules.crashes and state.running:
            moves += self._crashes(state)
        return moves

    def startable(self, state: State) -> list[int]:
        """The primitives that may start now."""
        return [
            place
            for place in sorted(self.model.view(state.facts).open)
            if place not in state.running
            and state.failures[place] < self.limits[place]
            and self.claims.missing(place, state.running, state.keepers) is None
        ]

    def _starts(self, state: State) -> Iterator[Move]:
        for place in self.startable(state):
            running = tuple(sorted((*state.running, place)))
            keepers = self.claims.keepers_after(place, state.keepers)
            after = replace(state, running=running, keepers=keepers)
            yield Move(f"{self.labels[place]} starts", after, started=place)

    def _ends(self, state: State) -> Iterator[Move]:
        gates = self.model.view(state.facts).open
        for place in state.running:
            rest = replace(state, running=tuple(one for one in state.running if one != place))
            for facts in self.model.effects(place, state.facts):
                yield from self._success(place, rest, facts)
            if place in gates:
                failures = list(state.failures)
                failures[place] = min(failures[place] + 1, self.limits[place])
                after = replace(rest, failures=tuple(failures))
                yield Move(f"{self.labels[place]} fails", after, fault=True)
            else:
                yield Move(f"{self.labels[place]} is broken off", rest)

    def _success(self, place: int, rest: State, facts: Facts) -> Iterator[Move]:
        """A primitive ends with all its changes, or with any one of them and the others late."""
        failures = tuple(0 if one == place else n for one, n in enumerate(rest.failures))
        rest = replace(rest, failures=failures)
        changes = self.model.difference(rest.facts, facts)
        said = f"{self.labels[place]} ends"
        if self.rules.atomic or len(changes) < 2:  # noqa: PLR2004 - one change is atomic anyhow
            said += f": {words(changes.items())}" if changes else ""
            yield Move(*self._commit(said, rest, facts))
            return
        late = dict(rest.pending) | {self.model.place_of(key): new for key, new in changes.items()}
        for key, value in changes.items():
            first = self.model.place_of(key)
            pending = tuple(sorted((at, new) for at, new in late.items() if at != first))
            after = self.model.settled(changed(rest.facts, {first: value}))
            what = f"{said}: {words([(key, value)])}, the rest is late"
            yield Move(*self._commit(what, replace(rest, pending=pending), after))

    def _arrivals(self, state: State) -> Iterator[Move]:
        for event in state.pending:
            rest = replace(state, pending=tuple(one for one in state.pending if one != event))
            facts = self.model.settled(changed(state.facts, dict([event])))
            said = f"at last {self.model.keys[event[0]]} := {shown(event[1])}"
            yield Move(*self._commit(said, rest, facts))

    def _times(self, state: State) -> Iterator[Move]:
        for key, facts in self.model.time_passes(state.facts):
            yield Move(*self._commit(f"time passes: {key}", state, facts))

    def _person(self, state: State) -> Iterator[Move]:
        given_up = self.exhausted(state)
        if given_up:
            failures = tuple(
                0 if place in given_up else count for place, count in enumerate(state.failures)
            )
            names = ", ".join(self.labels[place] for place in given_up)
            said = f"a person lets {names} be tried again"
            yield Move(said, replace(state, failures=failures))

    def exhausted(self, state: State) -> list[int]:
        """Primitives that could run had they not used up their retries."""
        gates = self.model.view(state.facts).open
        return [
            place
            for place in sorted(gates)
            if place not in state.running and state.failures[place] >= self.limits[place]
        ]

    def by_the_world(self, state: State) -> Iterator[Move]:
        """The fewest facts from outside that let something go on."""
        seen: list[Mapping[int, Value]] = []
        for new in self._outside(state.facts):
            if any(old.items() <= new.items() for old in seen):
                continue
            facts = self.model.settled(changed(state.facts, new))
            changes = words(self.model.difference(state.facts, facts).items())
            said, after = self._commit(f"the world: {changes}", state, facts)
            if after.running or self.startable(after) or self.model.view(facts).accomplished:
                seen.append(new)
                yield Move(said, after)

    def _outside(self, facts: Facts) -> Iterator[dict[int, Value]]:
        choices = {
            place: [value for value in self.model.settable(place, facts) if value != facts[place]]
            for place in self.model.world
        }
        many = prod(len(values) + 1 for values in choices.values()) > LARGEST_WORLD
        for size in range(1, 2 if many else len(choices) + 1):
            for places in combinations(choices, size):
                for values in product(*(choices[place] for place in places)):
                    yield dict(zip(places, values, strict=True))

    def _disturbances(self, state: State) -> Iterator[Move]:
        for place, values in (self.rules.disturbances or {}).items():
            for value in values:
                if value != state.facts[place]:
                    facts = self.model.settled(changed(state.facts, {place: value}))
                    said = f"disturbed: {self.model.keys[place]} := {shown(value)}"
                    what, after = self._commit(said, state, facts)
                    yield Move(what, after, fault=True)

    def _crashes(self, state: State) -> Iterator[Move]:
        """Every way in which the primitives in doubt turn out after a restart."""
        again = tuple(p for p in state.running if self.model.primitives[p].action.idempotent)
        doubt = [place for place in state.running if place not in again]
        found = {state.facts: "not done"}
        for place in doubt:
            for facts, _ in list(found.items()):
                for after in self.model.effects(place, facts):
                    found.setdefault(after, "done")
        if not doubt:
            return
        names = ", ".join(self.labels[place] for place in doubt)
        rest = replace(state, running=again)
        for facts, outcome in found.items():
            changes = words(self.model.difference(state.facts, facts).items())
            said = f"crash and restart; {names}: {outcome}" + (f", {changes}" if changes else "")
            yield Move(*self._commit(said, rest, facts), fault=True)

    def _commit(self, said: str, state: State, facts: Facts) -> tuple[str, State]:
        """New facts, and what the engine does about them before anything else happens."""
        if facts == state.facts:
            return said, state
        view = self.model.view(facts)
        cancelled = [
            place
            for place in state.running
            if place not in view.open
            and self.model.primitives[place].action.cancel is Cancel.IMMEDIATE
        ]
        if cancelled:
            said += f"; breaks off {', '.join(self.labels[place] for place in cancelled)}"
        running = tuple(place for place in state.running if place not in cancelled)
        failures = tuple(
            count if place in view.open else 0 for place, count in enumerate(state.failures)
        )
        keepers = self.claims.still_kept(state.keepers, view.standings)
        return said, State(facts, running, failures, keepers, state.pending)


def values_of(
    model: Model, wanted: Mapping[str, Collection[Value]]
) -> dict[int, tuple[Value, ...]]:
    """Disturbances by place, from facts by name; where no values are given, all of them."""
    found: dict[int, tuple[Value, ...]] = {}
    for name, places in model.places_of(wanted).items():
        for place in places:
            found[place] = tuple(wanted[name]) or model.domains[model.keys[place]]
    return found
