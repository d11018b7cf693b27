"""From requests to the boxes that they ask for now."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import numpy as np

from depal.domain import BoxId, Gtin, Recognition, Request
from depal.selection.graph import BlockingGraph
from depal.selection.links import Indices
from depal.selection.walks import mark_reachable


@dataclass(frozen=True, slots=True)
class Aim:
    """A request and the perceived box that would serve it with the fewest removals.

    Attributes:
        request: what is wanted.
        box: the perceived box that it aims at.
        removals: |T(box)| - 1, the boxes that must leave before it.
    """

    request: Request
    box: BoxId
    removals: int


def aims_of(
    graph: BlockingGraph, requests: Iterable[Request]
) -> tuple[tuple[Aim, ...], tuple[Request, ...]]:
    """Which perceived box each request asks for.

    A box request asks for that box. A product request asks for the recognised case of the
    product with the smallest T; equals are settled by geometry. What nothing has seen yet stays
    pending.

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
            removals, slot = cases.nearest(candidates)
            aims.append(Aim(request, graph.at(slot).id, removals))
        else:
            pending.append(request)
    return tuple(aims), tuple(pending)


def strongest_first(
    graph: BlockingGraph, aims: Sequence[Aim]
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

    def __init__(self, graph: BlockingGraph) -> None:
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

    def nearest(self, slots: list[int]) -> tuple[int, int]:
        """The fewest removals, and the slot that needs them."""
        links = self._graph.links
        rank = self._graph.geometric_rank() if len(slots) > 1 else None
        stack = np.empty(len(links.blockers), np.int32)
        best: tuple[int, int, int] | None = None
        for slot in slots:
            marked = np.zeros(len(links.blockers), np.bool_)
            removals = int(mark_reachable(links, slot, marked, stack)) - 1
            key = (removals, 0 if rank is None else int(rank[slot]), slot)
            best = key if best is None else min(best, key)
        return (best[0], best[2]) if best else (0, 0)
