"""Everything that `depal study faults` can be asked for, one part after the other."""

import time
from collections.abc import Callable
from concurrent.futures import Executor
from contextlib import AbstractContextManager
from dataclasses import dataclass, field
from pathlib import Path

from depal.app.faults.report import faults_report
from depal.app.faults.runs import FaultsAsked, faults_rows
from depal.app.faults.shift import shift_report, shift_with_physics
from depal.app.light import Storm, storm, storm_report
from depal.app.reports.report import Report, together
from depal.errors import SettingError
from depal.studies.sweep import Progress

Bar = Callable[[str], AbstractContextManager[Progress]]
"""Shows how far a part is, under its title."""


@dataclass(frozen=True, slots=True)
class Whole:
    """What is to be run.

    Attributes:
        faults: each alone, and pairs.
        light: cuts and a shift in light worlds.
        physics: boxes of a shift with physics.
        keep: a folder for finished runs; those that it has already are not run again.
    """

    faults: FaultsAsked = field(default_factory=FaultsAsked)
    light: Storm = field(default_factory=Storm)
    physics: int = 0
    keep: Path | None = None


def whole_report(asked: Whole, executor: Executor | None, bar: Bar) -> Report:
    """Runs every part that is asked for.

    Raises:
        SettingError: none is, or a fault is not in the catalogue.
    """
    reports = []
    if asked.faults.seeds or asked.faults.pairs:
        start = time.perf_counter()
        with bar("Faults") as progress:
            runs = faults_rows(asked.faults, executor, progress, asked.keep)
        reports.append(faults_report(runs, asked.faults, time.perf_counter() - start))
    if asked.light.cuts or asked.light.shift:
        start = time.perf_counter()
        with bar("Light worlds") as progress:
            done = storm(asked.light, executor, progress, asked.keep)
        reports.append(storm_report(done, asked.light, time.perf_counter() - start))
    if asked.physics:
        start = time.perf_counter()
        with bar("A shift") as progress:
            emptied = shift_with_physics(
                asked.physics, asked.faults.seed, executor, progress, asked.keep
            )
        seconds = time.perf_counter() - start
        reports.append(shift_report(emptied, asked.faults.seed, seconds))
    if not reports:
        wanted = "1 or more, or --pairs, --cuts or --shift"
        raise SettingError("--seeds", "nothing is to be run", wanted)
    return together(*reports)
