"""Deliveries emptied in the simulated cell, one row each, and all of them together."""

from collections.abc import Iterator, Sequence

from matplotlib.figure import Figure
from rich.console import RenderableType
from rich.text import Text

from depal.app.files import Json
from depal.app.reports.report import PlainTable, Report, plain_table, verdict
from depal.app.throughput.asked import Asked
from depal.app.throughput.row import Row
from depal.app.throughput.runs import Throughput
from depal.app.throughput.summary import Summary, summary_of
from depal.cell.departures import Fate
from depal.cell.timekeeping import MOTION
from depal.studies.drawing import Emptied, throughput_figure

RATE = 400.0
"""The target of the median rate, without the waiting for people [boxes/h]."""

STORED = 0.99
"""The target of the share of boxes that are stored."""

PLAN, PLAN_P95 = 0.030, 0.200
"""The targets of planning a motion, in the median and for nineteen of twenty [s]."""


def throughput_report(result: Throughput, asked: Asked, seconds: float) -> Report:
    """The report of `depal study throughput`.

    Args:
        result: the runs.
        asked: the options of the study.
        seconds: the wall time of the study.

    Returns:
        The report; it holds when every run ended with nothing lost, hit or booked wrongly.
    """
    summary = summary_of(result.rows)
    shown: list[RenderableType] = [_rows(result.rows, asked), _totals(summary)]
    shown += list(_remarks(result))
    fields: dict[str, Json] = {
        "cell": asked.cell,
        "w": asked.w,
        "seed": asked.seed,
        "seeds": asked.seeds,
        "requests_per_delivery": asked.requests,
        "seconds": seconds,
        "resumed": result.resumed,
        "rows": [row.fields for row in result.rows],
        "failures": [
            {"delivery": failure.delivery, "seed": failure.seed, "reason": failure.reason}
            for failure in result.failures
        ],
        "summary": summary.fields,
    }
    draw = (lambda: _figure(result.rows, summary, asked)) if result.rows else None
    return Report(fields, shown, draw, holds=result.holds)


def _rows(rows: Sequence[Row], asked: Asked) -> PlainTable:
    table = plain_table(
        f"Deliveries emptied in the cell {asked.cell}, w = {asked.w}, "
        f"{asked.requests} random requests each",
        "delivery",
        "seed",
        "boxes",
        "stored",
        "not stored",
        "lost",
        "collisions",
        "misbooked",
        "boxes/h",
        "sim s",
        "wait s",
        "motion",
        "real s",
        "",
    )
    for row in rows:
        table.row(
            row.delivery,
            str(row.seed),
            str(row.boxes),
            str(row.stored),
            str(len(row.exceptions)),
            str(row.lost),
            str(row.collisions),
            str(len(row.referee.disagreements) + row.placed_twice),
            f"{row.boxes_per_hour:.0f}",
            f"{row.sim_seconds:.0f}",
            f"{row.waiting_seconds:.0f}",
            _percent(row.shares.get(MOTION, 0.0) / row.sim_seconds if row.sim_seconds else 0.0),
            f"{row.wall_seconds:.0f}",
            verdict(row.holds, "whole", "WRONG"),
        )
    return table


def _totals(summary: Summary) -> PlainTable:
    table = plain_table("Together", "", "measured", "target", "")

    def line(name: str, measured: str, target: str = "", *, met: bool | None = None) -> None:
        mark = Text("") if met is None else verdict(met, "met", "missed")
        table.row(name, measured, target, mark)

    stored = f"{summary.stored} of {summary.boxes} ({100 * summary.stored_share:.1f} %)"
    line("stored", stored, f">= {100 * STORED:.0f} %", met=summary.stored_share >= STORED)
    line("set aside, taken by a person or left", str(summary.exceptions))
    for name, count in (
        ("lost", summary.lost),
        ("collisions", summary.collisions),
        ("not where the books say", summary.disagreements),
        ("placed twice", summary.placed_twice),
    ):
        line(name, str(count), "0", met=not count)
    line("holds that gave way", str(summary.suction_losses))
    line("requests served", f"{summary.served} of {summary.requests}")
    rate = summary.boxes_per_hour
    said = f"{rate.median:.0f} ({rate.low:.0f} .. {rate.high:.0f})"
    line("boxes per hour, median (range)", said, f">= {RATE:.0f}", met=rate.median >= RATE)
    for name, share in summary.shares.items():
        line(f"  {name}", _percent(share))
    wall = summary.wall
    line("real seconds of a run, median and most", f"{wall.median:.0f}, {wall.high:.0f}")
    plan = summary.planning
    for name, seconds, target in (
        ("planning a motion, median", plan.median, PLAN),
        ("planning a motion, 95th percentile", plan.p95, PLAN_P95),
    ):
        line(name, f"{1e3 * seconds:.1f} ms", f"<= {1e3 * target:.0f} ms", met=seconds <= target)
    line("plans within the simulated clock's charge", _percent(summary.within_charge))
    return table


def _remarks(result: Throughput) -> Sequence[Text]:
    """What went wrong, and why boxes were not stored."""
    said = [
        Text(f"{failure.delivery}, seed {failure.seed}: no end: {failure.reason}", style="red")
        for failure in result.failures
    ]
    for row in result.rows:
        name = f"{row.delivery}, seed {row.seed}"
        said += [Text(f"{name}: {line}", style="red") for line in _wrongs(row)]
        said += [Text(f"{name}: {e.box}: {e.outcome}: {e.reason}") for e in row.exceptions]
    if result.resumed:
        said.append(Text(f"{result.resumed} of the runs had been kept before."))
    return said


def _wrongs(row: Row) -> Iterator[str]:
    """What was lost, hit or booked wrongly in a run."""
    for gone in row.sequence:
        if gone.outcome == Fate.LOST.value:
            yield f"{gone.box}: lost; it left the pallet at {gone.at:.1f} s"
    for hit in row.referee.collisions:
        yield f"{hit.at:.1f} s: {hit.who} against {hit.against}, {hit.force:.0f} N"
    yield from row.referee.disagreements


def _percent(share: float) -> str:
    return f"{100 * share:.1f} %"


def _figure(rows: Sequence[Row], summary: Summary, asked: Asked) -> Figure:
    groups: dict[str, list[Row]] = {}
    for row in rows:
        groups.setdefault(row.delivery, []).append(row)
    seeds = f"seed {asked.seed}"
    if asked.seeds > 1:
        seeds = f"seeds {asked.seed} to {asked.seed + asked.seeds - 1}"
    return throughput_figure(
        [_emptied(name, group) for name, group in groups.items()],
        summary.shares,
        RATE,
        note=f"cell {asked.cell}, w = {asked.w:g}, {asked.requests} requests each, {seeds}",
    )


def _emptied(name: str, rows: Sequence[Row]) -> Emptied:
    boxes = sum(row.boxes for row in rows)
    seconds: dict[str, float] = {}
    for row in rows:
        for part, value in row.shares.items():
            seconds[part] = seconds.get(part, 0.0) + value / boxes
    return Emptied(
        name,
        rows[0].boxes,
        tuple(row.boxes_per_hour for row in rows),
        seconds,
        all(row.holds for row in rows),
    )
