"""Speed of what surrounds the engine: the runtime, the journal, a simulated day."""

import asyncio
import time
from collections.abc import Awaitable, Callable, Mapping
from functools import partial
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Final

from depal.executive.clock import Clock, LoopClock, RealClock, run_simulated
from depal.executive.engine import Call, Engine, Report
from depal.executive.journal import Entry, Journal, MemoryJournal, SqliteJournal
from depal.executive.runtime import Context, Primitive, Runtime
from depal.studies.bench.executive_work import actions_of, effect, percentile, store_tasks
from depal.studies.bench.figure import Figure, median_seconds

_PAUSE = 0.001
_DURATIONS: Final[Mapping[str, float]] = {
    "kr60_reach": 40.0,
    "kr60_grasp": 2.0,
    "kr60_show": 40.0,
    "read_barcode": 1.0,
    "ask_target": 1.0,
    "kr60_carry": 52.0,
    "kr60_release": 8.0,
}
"""How long each primitive takes in simulated time [s]; one store takes 144 s."""


def command_figures(stores: int = 60) -> list[Figure]:
    """From a fact that a primitive reports to the first line of the next primitive.

    In between the runtime decides and writes, fully synced where the next one moves the arm.

    Args:
        stores: that are done; each has seven primitives.
    """
    with TemporaryDirectory() as folder, SqliteJournal(Path(folder) / "cell.journal") as journal:
        seconds = asyncio.run(_latencies(journal, stores))
    times = [1e3 * second for second in seconds]
    name = "fact to command through the runtime"
    return [
        Figure(name, percentile(times, 50), "ms", 1.0, "lower", len(times)),
        Figure(f"{name}, p99", percentile(times, 99), "ms", 5.0, "lower", len(times)),
    ]


async def _latencies(journal: Journal, stores: int) -> list[float]:
    """Seconds between one primitive's fact and the next primitive, without the very first one."""
    begun: list[float] = []
    told: list[float] = []

    async def run(context: Context) -> Report:
        begun.append(time.perf_counter())
        await asyncio.sleep(_PAUSE)  # the loop goes to sleep, as it does in a cell
        report = Report(effect(context.action.name, context.args["Box"], context.facts))
        told.append(time.perf_counter())
        return report

    await _store_all(journal, RealClock(), run, stores)
    return [begin - tell for tell, begin in zip(told, begun[1:], strict=False)]


async def _store_all(
    journal: Journal, clock: Clock, run: Callable[[Context], Awaitable[Report]], stores: int
) -> None:
    """Allocates stores and waits until all of them are done."""
    tasks = store_tasks()
    primitives: dict[str, Primitive] = {action.name: run for action in actions_of(tasks)}
    probes = {str(action.probe): run for action in actions_of(tasks) if action.probe}
    runtime = Runtime(Engine(tasks), journal, clock, primitives, probes)
    done = asyncio.Event()
    runtime.listen(lambda _, __: None if runtime.engine.state.trees else done.set())
    runtime.allocate(*(Call("store", (f"b{number}",)) for number in range(stores)))
    await done.wait()
    await runtime.settle()
    await runtime.close()


def append_figures(normal: int = 2000, synced: int = 200) -> list[Figure]:
    """One event into the journal.

    Args:
        normal: how often it survives the process.
        synced: how often it survives a power cut.
    """
    figures = []
    entries = [Entry(1.0, "Changed", '{"facts":[["b1.taken",true]],"source":"gripper"}')]
    with TemporaryDirectory() as folder, SqliteJournal(Path(folder) / "cell.journal") as journal:
        for name, target, durable, n in (
            ("journal append, normal", 50.0, False, normal),
            ("journal append, fully synced", 2000.0, True, synced),
        ):
            seconds = median_seconds(partial(journal.append, entries, durable=durable), n)
            figures.append(Figure(name, 1e6 * seconds, "us", target, "lower", n))
    return figures


def simulated_figure(stores: int = 200) -> Figure:
    """A day's work in simulated time, through the runtime.

    Args:
        stores: that are done; 200 take eight hours.
    """

    async def run(context: Context) -> Report:
        await asyncio.sleep(_DURATIONS[context.action.name])
        return Report(effect(context.action.name, context.args["Box"], context.facts))

    seconds = median_seconds(
        lambda: run_simulated(_store_all(MemoryJournal(), LoopClock(), run, stores)), 1
    )
    hours = stores * sum(_DURATIONS.values()) / 3600
    name = f"{hours:g} hours of simulated work, {stores} stores"
    return Figure(name, seconds, "s", 5.0, "lower", 1)
