"""What the host of a cell works with."""

from collections.abc import Callable, Coroutine
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from depal.app.serve.outside import Connect, Records
from depal.domain import CellLayout
from depal.executive.schema import Repository
from depal.ports import StoreSystem

Wrote = Callable[[int, int], None]

RunLoop = Callable[[Callable[[], Coroutine[Any, Any, None]]], None]
"""Runs a coroutine function to its end on an event loop of the cell's time."""


@dataclass(frozen=True, slots=True)
class Means:
    """What a host works with.

    Attributes:
        layout: the cell.
        folder: the data folder; each run has a folder of its own below it.
        connect: finds or starts the world.
        store: makes the store's system for a run, on the cell's thread.
        records: made on the cell's thread.
        run_loop: brings the cell's time.
        perception: "camera" or "truth".
        severity: how far simulated cameras and boxes are from ideal.
        wrote: told the number of each last event of a run's journal.
        tasks: what the cell can do; None for the shipped tasks.
    """

    layout: CellLayout
    folder: Path
    connect: Connect
    store: Callable[[int], StoreSystem]
    records: Callable[[], Records]
    run_loop: RunLoop
    perception: str = "camera"
    severity: str = "normal"
    wrote: Wrote = lambda _run, _sequence: None
    tasks: Repository | None = None
