"""Recorded orders of unloading, as choices: who could be taken at each step, and who was."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from depal.domain import BoxId, Perceived, Recognition, Request
from depal.selection.graph import BlockingGraph
from depal.selection.learning.choices import Choice
from depal.selection.relations import PERCEIVED, Tolerances
from depal.selection.score import ScoreRule, geometric_rank
from depal.selection.walks import propagate
from depal.selection.wanted import aims_of, strongest_first

Array = npt.NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class Departure:
    """A box that left.

    Attributes:
        box: which.
        at: when [s]; with requests that arrive later this decides which of them were known.
    """

    box: BoxId
    at: float = 0.0


@dataclass(frozen=True, slots=True)
class Order:
    """One pallet and the order in which its boxes left.

    Attributes:
        pallet: its name.
        boxes: all that stood on it, in the cell frame.
        requests: what was wanted, with the times at which that was known.
        departures: in their order; boxes may be left at the end.
        x_max: the far side of the pallet [m].
        tolerances: how wrong the poses may be.
    """

    pallet: str
    boxes: tuple[Perceived, ...]
    requests: tuple[Request, ...]
    departures: tuple[Departure, ...]
    x_max: float
    tolerances: Tolerances = PERCEIVED


@dataclass(frozen=True, slots=True)
class Steps:
    """The steps of an order.

    Attributes:
        choices: those in which there was a choice that the model knows.
        forced: how many boxes left when nothing else could be taken.
        blocked: boxes that left although another one stood on or before them.
    """

    choices: tuple[Choice, ...]
    forced: int
    blocked: tuple[BoxId, ...]


class Unloading:
    """A pallet while it is taken apart: what can be taken, and what speaks for each box."""

    def __init__(
        self,
        boxes: Sequence[Perceived],
        requests: Sequence[Request],
        x_max: float,
        tolerances: Tolerances = PERCEIVED,
    ) -> None:
        """Nothing has left yet.

        Args:
            boxes: all boxes.
            requests: all requests; each is open from its arrival until a box serves it.
            x_max: the far side of the pallet [m].
            tolerances: how wrong the poses may be.

        Raises:
            PileError: the boxes cannot stand in one world.
        """
        self._graph = BlockingGraph(boxes, tolerances)
        self._waiting = list(requests)
        self._x_max = x_max

    def __len__(self) -> int:
        """How many boxes are left."""
        return len(self._graph)

    def takeable(self, now: float) -> tuple[list[Perceived], Array]:
        """The boxes that nothing blocks, the first by geometry first.

        Args:
            now: requests that arrived later are not known yet [s].

        Returns:
            The boxes, and (k, 4) their l, |y|, x_max - x and z.
        """
        graph = self._graph
        free = np.flatnonzero(graph.links.blockers == 0)
        free = free[np.argsort(geometric_rank(graph.prisms[free]))]
        known = [request for request in self._waiting if request.arrived <= now]
        inherited = propagate(graph.links, *strongest_first(graph, aims_of(graph, known)[0]))
        features = features_of(graph.prisms[free], inherited[free], self._x_max)
        return [graph.at(slot) for slot in free.tolist()], features

    def take(self, box: BoxId, now: float) -> None:
        """A box leaves; it serves the most important request that it can serve.

        Raises:
            PileError: there is no such box.
        """
        taken = self._graph[box]
        gtin = taken.gtin if isinstance(taken, Recognition) else None
        served = [
            request
            for request in self._waiting
            if request.arrived <= now
            and (request.box == box or (gtin is not None and request.gtin == gtin))
        ]
        if served:
            self._waiting.remove(max(served, key=lambda request: request.priority))
        self._graph.remove(box)


def features_of(centres: Array, inherited: Array, x_max: float) -> Array:
    """(n, 4) l, |y|, x_max - x, z of boxes, from (n, 3 or more) centres and (n,) l."""
    x, y, z = centres[:, 0], centres[:, 1], centres[:, 2]
    return np.stack((inherited, np.abs(y), x_max - x, z), axis=1)


def steps_of(order: Order) -> Steps:
    """The choices of a recorded order.

    Raises:
        PileError: the boxes cannot stand in one world, or one that left was not there.
    """
    unloading = Unloading(order.boxes, order.requests, order.x_max, order.tolerances)
    choices: list[Choice] = []
    blocked: list[BoxId] = []
    forced = 0
    for departure in order.departures:
        boxes, features = unloading.takeable(departure.at)
        names = [box.id for box in boxes]
        if departure.box not in names:
            blocked.append(departure.box)
        elif len(names) == 1:
            forced += 1
        else:
            choices.append(Choice(features, names.index(departure.box)))
        unloading.take(departure.box, departure.at)
    return Steps(tuple(choices), forced, tuple(blocked))


def draw_departures(
    unloading: Unloading,
    rule: ScoreRule,
    temperature: float,
    rng: np.random.Generator,
    seconds: float = 0.0,
) -> tuple[Departure, ...]:
    """Takes a pallet apart as a noisy policy would: P(b) ~ exp(s(b) / T) at each step.

    Args:
        unloading: taken apart as far as it goes.
        rule: of the scores.
        temperature: T [m]; at 0 the best score is taken, ties by geometry.
        rng: one draw for each box that could be taken (a Gumbel draw added to s / T).
        seconds: between two boxes.
    """
    weights = rule.weights
    theta = np.array(
        [rule.w, *((1 - rule.w) * a for a in (weights.side, weights.depth, weights.height))]
    )
    departures: list[Departure] = []
    while True:
        now = len(departures) * seconds
        boxes, features = unloading.takeable(now)
        if not boxes:
            return tuple(departures)
        noise = rng.gumbel(size=len(boxes))
        best = int(np.argmax(features @ theta + temperature * noise))
        unloading.take(boxes[best].id, now)
        departures.append(Departure(boxes[best].id, now))
