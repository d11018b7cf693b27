"""Real deliveries taken apart on geometry alone: every box known, every leaf graspable."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from depal.domain import (
    STACK_TOLERANCE,
    BoxId,
    Delivery,
    Recognition,
    Request,
    cell_from_pallet,
)
from depal.errors import DeliveryError, Problem
from depal.selection import BlockingGraph, Outcome, ScoreRule, Tolerances, leaf_alone, select

STACKED = Tolerances(overlap=STACK_TOLERANCE, slack=2 * STACK_TOLERANCE)
"""For the stacks of deliveries, which are believed to a millimetre."""


@dataclass(frozen=True, slots=True)
class Unloading:
    """One delivery, taken apart.

    Attributes:
        delivery: its id.
        boxes: how many cases it has.
        sequence: the indices in the delivery's stack, in the order of storing.
        outcome: how the last selection ended.
        cycle: the boxes that block one another, where that is why.
        burdened: indices that were taken while a box lay on them, by the stack's own geometry.
        requests: what was asked for.
        served: per request the number of boxes stored before it was served, None where never.
    """

    delivery: str
    boxes: int
    sequence: tuple[int, ...]
    outcome: Outcome
    cycle: tuple[BoxId, ...]
    burdened: tuple[int, ...]
    requests: tuple[Request, ...]
    served: tuple[int | None, ...]

    @property
    def complete(self) -> bool:
        """Whether every box was taken, and none with a box on it."""
        return len(self.sequence) == self.boxes and not self.burdened


def perceived_stack(delivery: Delivery) -> tuple[Recognition, ...]:
    """The stack as perfect perception would give it, in the default cell's frame.

    Raises:
        DeliveryError: only the note is known.
    """
    if delivery.stack is None:
        what = f"delivery {delivery.id!r} is a note without a stack"
        raise DeliveryError("", [Problem("stack", what, "where every case stands")])
    cell_from = cell_from_pallet(delivery.pallet_size)
    return tuple(
        Recognition(BoxId(f"b{index}"), case.in_pallet.seen_from(cell_from), case.gtin)
        for index, case in enumerate(delivery.stack)
    )


def far_side(delivery: Delivery) -> float:
    """x_max of Eq. (1): the far side of the delivery's pallet in the default cell [m]."""
    return cell_from_pallet(delivery.pallet_size).translation[0] + delivery.pallet_size[1]


def unload_delivery(delivery: Delivery, requests: Sequence[Request], w: float) -> Unloading:
    """Stores every box of a delivery by Algorithm 1; a request counts until it is served.

    Args:
        delivery: with its stack.
        requests: all known from the start.
        w: the weight of Eq. (3).

    Returns:
        The sequence and what a referee says of it.

    Raises:
        DeliveryError: only the note is known.
        SettingError: w is not in [0, 1].
    """
    boxes = perceived_stack(delivery)
    index_of = {box.id: index for index, box in enumerate(boxes)}
    rule = ScoreRule(w=w, x_max=far_side(delivery))
    graph = BlockingGraph(boxes, STACKED)
    served: list[int | None] = [None] * len(requests)
    sequence: list[int] = []
    while True:
        waiting = [request for request, at in zip(requests, served, strict=True) if at is None]
        decision = select(graph, waiting, rule, leaf_alone)
        target = decision.target
        if not isinstance(target, Recognition):
            break
        number = _first_served(requests, served, target)
        if number is not None:
            served[number] = len(sequence)
        graph.remove(target.id)
        sequence.append(index_of[target.id])
    return Unloading(
        delivery=delivery.id,
        boxes=len(boxes),
        sequence=tuple(sequence),
        outcome=decision.outcome,
        cycle=decision.cycle,
        burdened=tuple(burdened_picks(delivery, sequence)),
        requests=tuple(requests),
        served=tuple(served),
    )


def _first_served(
    requests: Sequence[Request], served: Sequence[int | None], box: Recognition
) -> int | None:
    """The most important open request that this box serves; one case serves one request."""
    fitting = [
        number
        for number, request in enumerate(requests)
        if served[number] is None and (request.box == box.id or request.gtin == box.gtin)
    ]
    return max(fitting, key=lambda number: requests[number].priority, default=None)


def burdened_picks(delivery: Delivery, sequence: Iterable[int]) -> list[int]:
    """A referee of its own: the picks of a sequence that took a box with a box on it.

    Args:
        delivery: with its stack.
        sequence: indices in the stack.

    Returns:
        The indices that were taken too early.
    """
    stack = delivery.stack or ()
    left = set(range(len(stack)))
    early = []
    for index in sequence:
        left.discard(index)
        (x, y, z), (a, b, c) = stack[index].corner, stack[index].size
        for other in left:
            (u, v, t), (k, m, _) = stack[other].corner, stack[other].size
            over = _reach(x, a, u, k) > STACK_TOLERANCE and _reach(y, b, v, m) > STACK_TOLERANCE
            if over and t > z + c - 2 * STACK_TOLERANCE:
                early.append(index)
                break
    return early


def _reach(low: float, length: float, other: float, other_length: float) -> float:
    """How long two intervals overlap [m]."""
    return min(low + length, other + other_length) - max(low, other)
