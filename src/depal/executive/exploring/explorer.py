"""Walks every state of an allocated task and reports what can go wrong in it."""

from collections import deque
from collections.abc import Collection, Iterable, Mapping, Sequence

from depal.errors import Problem, TaskError, did_you_mean
from depal.executive.conditions import Value
from depal.executive.exploring.components import last_components, reaching
from depal.executive.exploring.hazards import hazards_of
from depal.executive.exploring.model import Facts, Model
from depal.executive.exploring.moves import Move, Moves, Rules, State, values_of
from depal.executive.exploring.result import Exploration, Wait
from depal.executive.exploring.traces import Traces
from depal.executive.schema import Repository
from depal.executive.tree import ground

Disturbances = Mapping[str, Collection[Value]]
"""Facts that the world changes by itself, with the values that they take; none means all."""


def explore(  # noqa: PLR0913 - what is walked beside the normal run, by name
    repository: Repository,
    task: str,
    args: Sequence[str],
    limit: int = 100_000,
    *,
    facts: Mapping[str, Value] | None = None,
    disturbances: Disturbances | Iterable[str] = (),
    atomic: bool = True,
    crashes: bool = True,
    attempts: int = 2,
) -> Exploration:
    """Walks every state of an allocated task.

    A state is the value of every fact that the tree depends on, what runs, and what has failed.
    A primitive may start when its gate is open and its resources are free; it may succeed in
    every way that its `sets` allow, fail, be broken off, or be in doubt after a crash. Facts
    that no primitive of the tree sets change only where the task cannot go on without them.

    Args:
        repository: without mistakes, see `check`.
        task: to allocate.
        args: the things that its parameters stand for.
        limit: of the number of states.
        facts: what is the case at first; all others are unset.
        disturbances: facts that may change at any moment, as in "Box.taken" or "b1.taken".
        atomic: whether a primitive's changes come as one event; if not, in any order.
        crashes: whether the controller may stop and start again at any moment.
        attempts: how many failures in a row are told apart.

    Returns:
        The number of states and all hazards, each with a shortest way to it.

    Raises:
        TaskError: an unknown task, a wrong call, or a disturbance that the tree does not know.
    """
    model = Model(repository, ground(repository, task, args))
    wanted = disturbances if isinstance(disturbances, Mapping) else dict.fromkeys(disturbances, ())
    _refuse_unknown(model, wanted)
    rules = Rules(attempts, atomic, crashes, values_of(model, wanted))
    space = Space(Moves(model, rules), limit)
    space.walk([model.facts_from(facts)] if facts else model.starts())
    return space.report(model.tree.root.label)


def _refuse_unknown(model: Model, wanted: Disturbances) -> None:
    problems = []
    for name, places in model.places_of(wanted).items():
        known = [*model.declared, *(fact.name for fact in model.declared.values())]
        if not places:
            what = f"no condition of {model.tree.root.label} mentions {name!r}"
            problems.append(Problem("disturbances", what, exists=did_you_mean(name, known)))
            continue
        for value in wanted[name]:
            domain = model.domains[model.keys[places[0]]]
            if value not in domain:
                exists = did_you_mean(str(value), [str(one) for one in domain])
                what = f"{name} is never told apart as {value!r}"
                problems.append(Problem("disturbances", what, exists=exists))
    if problems:
        raise TaskError("", problems)


class Space:
    """The states seen so far and the moves between them.

    Attributes:
        states: in the order in which they were found.
        moves: of each state that was opened; None for one beyond the limit.
        waiting: the moves of the world, of each state in which it had to act.
        starts: how many states are starts; they are the first ones.
    """

    def __init__(self, rules: Moves, limit: int) -> None:
        """Nothing is seen yet."""
        self.rules = rules
        self.limit = limit
        self.states: list[State] = []
        self.moves: list[list[tuple[Move, int]] | None] = []
        self.waiting: dict[int, list[Move]] = {}
        self.starts = 0
        self._index: dict[State, int] = {}
        self._frontier: deque[int] = deque()

    def walk(self, starts: Sequence[Facts]) -> None:
        """Opens every state; where all that is left leads nowhere, the world acts."""
        for facts in starts:
            self._add(self.rules.first(facts))
        self.starts = len(self.states)
        self._open_all()
        while self._let_the_world_act():
            self._open_all()

    def _add(self, state: State) -> int:
        found = self._index.get(state)
        if found is None:
            found = self._index[state] = len(self.states)
            self.states.append(state)
            self.moves.append(None)
            self._frontier.append(found)
        return found

    def _open_all(self) -> None:
        while self._frontier and len(self.states) < self.limit:
            here = self._frontier.popleft()
            self.moves[here] = [
                (m, self._add(m.after)) for m in self.rules.after(self.states[here])
            ]

    def _let_the_world_act(self) -> bool:
        acted = False
        for component in self.stuck():
            for here in component:
                if here not in self.waiting:
                    found = list(self.rules.by_the_world(self.states[here]))
                    self.waiting[here] = found
                    opened = self.moves[here]
                    if found and opened is not None:
                        opened += [(move, self._add(move.after)) for move in found]
                        acted = True
        return acted

    def stuck(self) -> list[list[int]]:
        """Components that are never left and in which the root is never accomplished."""
        counted = [
            {after for move, after in moves if not move.fault} if moves else set()
            for moves in self.moves
        ]
        hopeful = [
            here
            for here, moves in enumerate(self.moves)
            if moves is None or self.rules.model.view(self.states[here].facts).accomplished
        ]
        reached = reaching(counted, hopeful)
        doomed = [here for here, yes in enumerate(reached) if not yes]
        return last_components(counted, doomed) if doomed else []

    def report(self, task: str) -> Exploration:
        """What there is to say about all of it."""
        traces = Traces(self.rules, self.moves, self.starts)
        waits: dict[str, Wait] = {}
        for here in sorted(self.waiting, key=traces.distance):
            for move in self.waiting[here]:
                what = self._awaited(self.states[here], move)
                waits.setdefault(what, Wait(what, traces.to(here)))
        started = {move.started for moves in self.moves for move, _ in moves or ()}
        return Exploration(
            task=task,
            states=len(self.states),
            valuations=len({state.facts for state in self.states}),
            transitions=sum(len(moves) for moves in self.moves if moves),
            complete=not self._frontier,
            hazards=tuple(hazards_of(self.rules, self.states, self.moves, self.stuck(), traces)),
            waits=tuple(waits.values()),
            idle=tuple(
                label for place, label in enumerate(self.rules.labels) if place not in started
            ),
            attended=sum(bool(self.rules.exhausted(state)) for state in self.states),
        )

    def _awaited(self, state: State, move: Move) -> str:
        """What the world does in a move; of a name or a number, only that it is told."""
        changes = self.rules.model.difference(state.facts, move.after.facts)
        told = (f"{'not ' * (not new)}{key}" for key, new in changes.items())
        return " and ".join(told)
