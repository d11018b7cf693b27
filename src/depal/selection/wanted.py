"""From requests to the boxes that they ask for now."""

from collections.abc import Iterable, Sequence

import numpy as np

from depal.domain import Gtin, Recognition, Request
from depal.selection.blocking import Aim, Blocking
from depal.selection.links import Indices


def aims_of(
    graph: Blocking, requests: Iterable[Request]
) -> tuple[tuple[Aim, ...], tuple[Request, ...]]:
    """Which perceived box each request asks for.

    A box request asks for that box. A product request asks for the recognised case of the
    product with the fewest removals; equals are settled by geometry. What nothing has seen yet
    stays pending.

    Args:
        graph: the perceived boxes.
        requests: what is wanted now.

    Returns:
        The aims, in the order of the requests, and the requests that are pending.
    """
    aims: list[Aim] = []
    pending: list[Request] = []
    cases = _Cases(graph)
    for request in requests:
        if request.box is not None:
            slot = graph.slot_of(request.box)
            candidates = [] if slot is None else [slot]
        else:
            candidates = cases.of(request.gtin)
        if candidates:
            slot = cases.nearest(candidates)
            aims.append(Aim(request, graph.at(slot).id, *graph.removals(slot)))
        else:
            pending.append(request)
    return tuple(aims), tuple(pending)


def strongest_first(
    graph: Blocking, aims: Sequence[Aim]
) -> tuple[Indices, np.ndarray[tuple[int], np.dtype[np.float64]]]:
    """The slots that are aimed at and their priorities, (m,) each, by falling priority."""
    ordered = sorted(aims, key=lambda aim: -aim.request.priority)
    slots = [graph.slot_of(aim.box) for aim in ordered]
    return (
        np.array(slots, np.int32),
        np.array([aim.request.priority for aim in ordered], np.float64),
    )


class _Cases:
    """The recognised cases by product, found once per call and only when asked for."""

    def __init__(self, graph: Blocking) -> None:
        self._graph = graph
        self._by_gtin: dict[Gtin, list[int]] | None = None

    def of(self, gtin: Gtin | None) -> list[int]:
        if self._by_gtin is None:
            self._by_gtin = {}
            for slot in self._graph.used_slots.tolist():
                box = self._graph.at(slot)
                if isinstance(box, Recognition):
                    self._by_gtin.setdefault(box.gtin, []).append(slot)
        return self._by_gtin.get(gtin, []) if gtin is not None else []

    def nearest(self, slots: list[int]) -> int:
        """The slot that needs the fewest removals; of equals the first by geometry."""
        if len(slots) == 1:
            return slots[0]
        rank = self._graph.geometric_rank()
        return min(slots, key=lambda slot: (self._graph.removals(slot)[0], int(rank[slot])))
