"""Speed of the executive: one event, allocation, and what checks a task before it runs."""

from collections.abc import Callable, Iterator
from itertools import islice

from depal.executive.checking import check
from depal.executive.engine import Call, Engine
from depal.executive.exploring import explore
from depal.studies.bench.executive_cpp import behaviortree_cpp_tick
from depal.studies.bench.executive_peers import gtpyhop_plan, py_trees_tick
from depal.studies.bench.executive_restart import restart_figures
from depal.studies.bench.executive_rim import (
    append_figures,
    command_figures,
    simulated_figure,
)
from depal.studies.bench.executive_work import Shift, percentile, store_tasks
from depal.studies.bench.figure import Figure, median_seconds, peers_of
from depal.studies.sweep import Progress, no_progress

STORES = (1, 60, 600, 2000)
"""How many stores are allocated."""

_PEER_TICKS = {1: 300, 60: 60, 600: 7}
_INPUTS = 5000
_WARM = 500


def bench_executive(progress: Progress = no_progress) -> list[Figure]:
    """Measures every figure of the executive.

    Args:
        progress: told how far it is.

    Returns:
        The figures, medians over repetitions where the name says nothing else.
    """
    measures: list[Callable[[], list[Figure]]] = [
        event_figures,
        lambda: [_allocation()],
        command_figures,
        append_figures,
        restart_figures,
        lambda: [simulated_figure()],
        lambda: [_check(), _exploration()],
    ]
    figures: list[Figure] = []
    for done, measure in enumerate(measures):
        progress(done, len(measures))
        figures += measure()
    progress(len(measures), len(measures))
    return figures


def event_figures(inputs: int = _INPUTS) -> list[Figure]:
    """The cost of one journal event for each number of stores, and how it grows.

    Args:
        inputs: that are measured, for each number.
    """
    found = {n: _event(n, inputs) for n in STORES}
    slope = found[2000][0].value / found[60][0].value
    name = "slope of one event from 60 to 2,000 stores"
    return [
        *(figure for pair in found.values() for figure in pair),
        Figure(name, slope, "ratio", 1.5, "lower", 2 * inputs),
    ]


def _event(n: int, inputs: int) -> tuple[Figure, Figure]:
    """An input's time divided by the events that it leads to, its median and 99th percentile."""
    costs = [1e6 * cost for cost in islice(_costs(n), _WARM, _WARM + inputs)]
    name = f"one event, {n:,} allocated store{'s' if n > 1 else ''}"
    ticks = _PEER_TICKS.get(n, 0)
    ticking = {
        "py_trees": py_trees_tick(n, ticks) if ticks else None,
        "BehaviorTree.CPP": behaviortree_cpp_tick(n, ticks) if ticks else None,
    }
    return (
        Figure(name, percentile(costs, 50), "us", 20.0, "lower", inputs, peers_of(ticking, 1e6)),
        Figure(f"{name}, p99", percentile(costs, 99), "us", 100.0, "lower", inputs),
    )


def _costs(n: int) -> Iterator[float]:
    """Seconds an event, input by input, without the allocations."""
    for timed in Shift(n).inputs():
        if timed.step.events and not timed.allocation:
            yield timed.seconds / len(timed.step.events)


def _allocation(allocations: int = 600) -> Figure:
    """One more store beside up to 600 others; GTPyhop plans one."""
    engine = Engine(store_tasks())
    calls = ([Call("store", (f"b{number}",))] for number in range(allocations + 1))
    seconds = median_seconds(lambda: engine.allocate(next(calls), 0.0), allocations)
    peers = peers_of({"GTPyhop": gtpyhop_plan(boxes=1)}, 1e6)
    return Figure("allocate one store", 1e6 * seconds, "us", 250.0, "lower", allocations, peers)


def _check() -> Figure:
    tasks = store_tasks()
    seconds = median_seconds(lambda: check(tasks), 5)
    return Figure("check of store.task", 1e3 * seconds, "ms", 100.0, "lower", 5)


def _exploration() -> Figure:
    tasks = store_tasks()
    seconds = median_seconds(lambda: explore(tasks, "store", ("b1",)), 3)
    return Figure("exploration of store(Box)", seconds, "s", 1.0, "lower", 3)
