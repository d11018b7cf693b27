"""Speed and memory of the selection, from perceived boxes to a decision."""

import time
from collections.abc import Callable
from statistics import median

import numpy as np

from depal.domain import BoxId, Detection, Request
from depal.geometry import OrientedBox
from depal.selection import EXACT, BlockingGraph, ScoreRule, leaf_alone, select
from depal.studies.bench.figure import Figure, median_seconds, peers_of
from depal.studies.bench.peers import networkx_selection
from depal.studies.pallets import X_MAX, guillotine_boxes
from depal.studies.paper import WEIGHTS
from depal.studies.sweep import Progress, no_progress
from depal.studies.table1 import table1

SMALLEST = 0.02
"""Smallest side of the boxes [m]."""

_TARGET_MS = {50: 0.2, 200: 1.0, 1000: 20.0, 5000: 500.0}
_REPETITIONS = {50: 200, 200: 100, 1000: 30, 5000: 7}
_PEER_UP_TO = 1000
_RULE = ScoreRule(w=0.5, x_max=X_MAX)
_EXECUTIONS = 500


def bench_selection(seed: int = 0, progress: Progress = no_progress) -> list[Figure]:
    """Measures every figure of the selection.

    Args:
        seed: of the pallets.
        progress: told how far it is.

    Returns:
        The figures, medians over repetitions.
    """
    measures: list[Callable[[], Figure]] = [
        *(lambda n=n: _one_selection(n, seed) for n in _TARGET_MS),
        lambda: _update(seed),
        lambda: _memory(seed),
        lambda: _executions(seed),
    ]
    figures = []
    for done, measure in enumerate(measures):
        progress(done, len(measures))
        figures.append(measure())
    progress(len(measures), len(measures))
    return figures


def perceived_pallet(n: int, seed: int) -> tuple[Detection, ...]:
    """A guillotine pallet of n boxes as perceived, smallest side 2 cm."""
    pallet = guillotine_boxes(np.random.default_rng(seed), n, smallest=SMALLEST)
    corners = zip(pallet.low.tolist(), pallet.sizes.tolist(), strict=True)
    return tuple(
        Detection(BoxId(f"b{index}"), OrientedBox.from_corner(tuple(low), tuple(size)))
        for index, (low, size) in enumerate(corners)
    )


def _one_selection(n: int, seed: int) -> Figure:
    boxes = perceived_pallet(n, seed)
    requests = (Request(priority=0.7, box=boxes[n // 2].id),)

    def work() -> object:
        return select(BlockingGraph(boxes, EXACT), requests, _RULE, leaf_alone)

    repetitions = _REPETITIONS[n]
    seconds = median_seconds(work, repetitions)
    peer = networkx_selection(boxes, requests[0], _RULE) if n <= _PEER_UP_TO else None
    return Figure(
        name=f"one selection with its graph, n = {n}",
        value=seconds * 1e3,
        unit="ms",
        target=_TARGET_MS[n],
        better="lower",
        n=repetitions,
        peers=peers_of({"networkx": peer}, 1e3),
    )


def _update(seed: int, n: int = 1000) -> Figure:
    graph = BlockingGraph(perceived_pallet(n, seed), EXACT)
    seconds = []
    while len(graph):
        decision = select(graph, (), _RULE, leaf_alone)
        if decision.target is None:
            break
        start = time.perf_counter()
        graph.remove(decision.target.id)
        seconds.append(time.perf_counter() - start)
    return Figure(
        name=f"update of the graph after one box left, n = {n}",
        value=median(seconds) * 1e3,
        unit="ms",
        target=0.1,
        better="lower",
        n=len(seconds),
    )


def _memory(seed: int, small: int = 500, large: int = 5000) -> Figure:
    """Bytes an edge costs when the graph grows tenfold: constant where memory is linear."""
    of_small, of_large = (BlockingGraph(perceived_pallet(n, seed), EXACT) for n in (small, large))
    added_bytes = of_large.nbytes - of_small.nbytes
    return Figure(
        name=f"memory per edge of the graph, from n = {small} to {large}",
        value=added_bytes / (of_large.edges - of_small.edges),
        unit="byte",
        target=200.0,
        better="lower",
        n=1,
    )


def _executions(seed: int) -> Figure:
    pallets = _EXECUTIONS // (2 * len(WEIGHTS))

    def work() -> object:
        return [table1(pallets, seed + offset) for offset in range(len(WEIGHTS))]

    return Figure(
        name=f"{_EXECUTIONS} executions of case study 1, once compiled",
        value=median_seconds(work, 5),
        unit="s",
        target=0.5,
        better="lower",
        n=5,
    )
