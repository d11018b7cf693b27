"""What can go wrong in a space of states."""

from collections.abc import Iterator, Sequence

from depal.executive.exploring.model import changed
from depal.executive.exploring.moves import Move, Moves, State
from depal.executive.exploring.reasons import reason
from depal.executive.exploring.result import Hazard, HazardKind, TraceStep
from depal.executive.exploring.traces import Graph, Traces

NAMED = 4
"""How many primitives of a livelock are named."""


def hazards_of(
    rules: Moves,
    states: Sequence[State],
    moves: Graph,
    stuck: Sequence[Sequence[int]],
    traces: Traces,
) -> list[Hazard]:
    """All hazards, by kind, then the nearest first; the same sentence only once.

    Args:
        rules: of the moves.
        states: all that were seen.
        moves: out of each.
        stuck: components that are never left without the root being accomplished.
        traces: the shortest ways.
    """
    found = [
        _stuck(rules, states, moves, component, traces.to(min(component, key=traces.distance)))
        for component in stuck
    ]
    hasty = {
        (here, move.started): what
        for here, state in enumerate(states)
        for move, what in _half_changes(rules, state, moves[here] or ())
    }
    careful = Traces(rules, moves, traces.starts, hasty.keys()) if hasty else traces
    clashes: dict[str, int] = {}
    for here in careful.reached():
        for what in rules.claims.clashes(states[here].running):
            clashes.setdefault(what, here)
    found += [
        Hazard(HazardKind.EXCLUSION, what, careful.to(here)) for what, here in clashes.items()
    ]
    named: set[int] = set()
    for here in careful.reached():
        for move, _ in moves[here] or ():
            if (here, move.started) in hasty and move.started not in named:
                named.add(move.started)
                what = hasty[here, move.started]
                found.append(Hazard(HazardKind.HALF_CHANGE, what, careful.to(here, move)))
    return _nearest(found)


def _nearest(found: Sequence[Hazard]) -> list[Hazard]:
    """By kind, then by distance; of those that say the same, the nearest."""
    order = list(HazardKind)
    unique: dict[tuple[HazardKind, str], Hazard] = {}
    for hazard in sorted(found, key=lambda one: (order.index(one.kind), len(one.trace))):
        unique.setdefault((hazard.kind, hazard.what), hazard)
    return list(unique.values())


def _stuck(
    rules: Moves,
    states: Sequence[State],
    moves: Graph,
    component: Sequence[int],
    trace: tuple[TraceStep, ...],
) -> Hazard:
    """A dead end where nothing starts any more, else a livelock."""
    inside = set(component)
    names = sorted(
        {
            rules.labels[move.started]
            for here in component
            for move, after in moves[here] or ()
            if move.started >= 0 and after in inside
        }
    )
    if not names:
        return Hazard(HazardKind.DEAD_END, reason(rules, states[component[0]]), trace)
    more = f" and {len(names) - NAMED} more" if len(names) > NAMED else ""
    root = rules.model.tree.root.label
    what = f"{', '.join(names[:NAMED])}{more} run on and on, and {root} is never accomplished"
    return Hazard(HazardKind.LIVELOCK, what, trace)


def _half_changes(
    rules: Moves, state: State, moves: Sequence[tuple[Move, int]]
) -> Iterator[tuple[Move, str]]:
    """Primitives that start though what is still to arrive closes their gates."""
    if not state.pending:
        return
    model = rules.model
    whole = model.settled(changed(state.facts, dict(state.pending)))
    for move, _ in moves:
        if move.started >= 0 and move.started not in model.view(whole).open:
            late = ", ".join(model.keys[place] for place, _ in state.pending)
            yield move, f"{rules.labels[move.started]} starts before {late} has arrived"
