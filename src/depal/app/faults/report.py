"""The table of the faults: what ends as it should, and what does not."""

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass

from matplotlib.figure import Figure
from rich.console import RenderableType
from rich.text import Text

from depal.app.faults.runs import FaultsAsked, Ran
from depal.app.files import Json
from depal.app.reports.report import Report, plain_table, verdict
from depal.simulation.faults import CATALOGUE, End
from depal.studies.drawing.faults import faults_figure

WITHOUT = 0.95
"""Of the faults that need nobody so many end without a person."""


@dataclass(frozen=True, slots=True)
class Row:
    """One fault, all its seeds.

    Attributes:
        fault: its id.
        seeds: how many runs.
        struck: share of them in which it struck.
        ended: share that ended in a state that the catalogue names.
        invariants: share in which the invariants held.
        without_person: share in which nobody was asked.
        ends: how often each end came.
    """

    fault: str
    seeds: int
    struck: float
    ended: float
    invariants: float
    without_person: float
    ends: dict[str, int]

    @classmethod
    def of(cls, fault: str, runs: Sequence[Ran]) -> "Row":
        """Sums up the runs of a fault; one that came to no end counts against everything."""
        said = [run.verdict for run in runs if run.verdict is not None]
        n = max(len(runs), 1)
        return cls(
            fault,
            len(runs),
            sum(one.struck for one in said) / n,
            sum(one.ended for one in said) / n,
            sum(not one.broken for one in said) / n,
            sum(one.without_person for one in said) / n,
            dict(Counter(" and ".join(one.ends) for one in said)),
        )

    @property
    def needs_nobody(self) -> bool:
        """Whether the catalogue names no person for it."""
        return not {End.HELD, End.ABORTED} & set(CATALOGUE[self.fault].ends)

    @property
    def holds(self) -> bool:
        """Whether it meets the figures."""
        alone = self.without_person >= WITHOUT or not self.needs_nobody
        return self.struck > 0 and self.ended == self.invariants == 1.0 and alone


def faults_report(runs: Sequence[Ran], asked: FaultsAsked, seconds: float) -> Report:
    """The report of `depal study faults`; it holds when every row meets the figures."""
    rows = [Row.of(name, [run for run in runs if run.fault == name]) for name in asked.ids]
    table = plain_table(
        "Faults, one in each run",
        "fault",
        "what",
        "seeds",
        "struck",
        "ended",
        "invariants",
        "without a person",
        "how",
        "",
    )
    for row in rows:
        table.row(
            row.fault,
            CATALOGUE[row.fault].what,
            str(row.seeds),
            f"{row.struck:.2f}",
            f"{row.ended:.2f}",
            f"{row.invariants:.2f}",
            f"{row.without_person:.2f}",
            ", ".join(f"{how} {count}" for how, count in sorted(row.ends.items())),
            verdict(row.holds, "met", "missed"),
        )
    shown: list[RenderableType] = [table]
    shown += [Text(line, style="red") for run in runs for line in _wrongs(run)]
    fields: dict[str, Json] = {
        "seed": asked.seed,
        "seeds": asked.seeds,
        "seconds": seconds,
        "rows": [
            {
                "fault": row.fault,
                "seeds": row.seeds,
                "struck": row.struck,
                "ended": row.ended,
                "invariants": row.invariants,
                "without_person": row.without_person,
                "ends": dict(row.ends),
            }
            for row in rows
        ],
        "wrong": [line for run in runs for line in _wrongs(run)],
    }
    return Report(fields, shown, lambda: _figure(rows), holds=all(row.holds for row in rows))


def _wrongs(run: Ran) -> list[str]:
    name = f"{run.fault}, seed {run.seed}"
    if run.verdict is None:
        return [f"{name}: no end: {run.reason}"]
    said = [f"{name}: {line}" for line in run.verdict.broken]
    if not run.verdict.ended:
        said.append(f"{name}: ended otherwise: {' and '.join(run.verdict.ends)}")
    return said


def _figure(rows: Sequence[Row]) -> Figure:
    return faults_figure(
        [row.fault for row in rows],
        {
            "ended as named": [row.ended for row in rows],
            "invariants held": [row.invariants for row in rows],
            "without a person": [row.without_person for row in rows],
        },
    )
