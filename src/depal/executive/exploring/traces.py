"""The shortest way to each state."""

from collections import deque
from collections.abc import Sequence
from collections.abc import Set as AbstractSet

from depal.executive.exploring.moves import Move, Moves
from depal.executive.exploring.result import TraceStep

Graph = Sequence[Sequence[tuple[Move, int]] | None]
"""The moves out of each state, each with the state that it leads to."""


class Traces:
    """Breadth first from the starts.

    Attributes:
        starts: how many of the first states are starts.
    """

    def __init__(
        self,
        rules: Moves,
        moves: Graph,
        starts: int,
        avoided: AbstractSet[tuple[int, int]] = frozenset(),
    ) -> None:
        """Finds how far every state is and from where it is reached.

        Args:
            rules: of the moves.
            moves: out of each state.
            starts: how many of the first states are starts.
            avoided: pairs of a state and the primitive that must not start in it.
        """
        self._rules = rules
        self.starts = starts
        self._distance = dict.fromkeys(range(starts), 0)
        self._from: dict[int, tuple[int, Move]] = {}
        frontier = deque(range(starts))
        while frontier:
            here = frontier.popleft()
            for move, after in moves[here] or ():
                if after not in self._distance and (here, move.started) not in avoided:
                    self._distance[after] = self._distance[here] + 1
                    self._from[after] = (here, move)
                    frontier.append(after)

    def reached(self) -> list[int]:
        """The states that can be reached, the nearest first."""
        return list(self._distance)

    def distance(self, state: int) -> int:
        """How many moves it takes."""
        return self._distance[state]

    def to(self, state: int, *more: Move) -> tuple[TraceStep, ...]:
        """The moves to a state, and more after it."""
        moves: list[Move] = []
        while state in self._from:
            state, move = self._from[state]
            moves.append(move)
        return tuple(self._step(move) for move in [*reversed(moves), *more])

    def _step(self, move: Move) -> TraceStep:
        model = self._rules.model
        facts = {
            key: value
            for place, (key, value) in enumerate(model.named(move.after.facts).items())
            if value is not None and value is not False and place not in model.lasting
        }
        running = tuple(self._rules.labels[place] for place in move.after.running)
        return TraceStep(move.what, facts, running)
