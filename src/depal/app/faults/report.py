"""The table of the faults: what ends as it should, and what does not."""

from collections.abc import Sequence

from matplotlib.figure import Figure
from rich.console import RenderableType
from rich.text import Text

from depal.app.faults.rows import RECOVERED, Pairs, RecoveryRow, Row, wrongs
from depal.app.faults.runs import FaultsAsked, Ran
from depal.app.files import Json
from depal.app.reports.report import Report, plain_table, verdict
from depal.simulation.faults import CATALOGUE
from depal.studies.drawing.faults import faults_figure

HEADS = ("fault", "what", "seeds", "struck", "ended", "invariants", "without a person", "how", "")


def faults_report(runs: Sequence[Ran], asked: FaultsAsked, seconds: float) -> Report:
    """The report of `depal study faults`; it holds when everything meets the figures."""
    rows = [Row.of(name, [run for run in runs if run.piece.ids == (name,)]) for name in asked.ids]
    pairs, recovery = Pairs.of(runs), RecoveryRow.of(runs)
    table = plain_table("Faults, one in each run", *HEADS)
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
    if pairs.n:
        shown.append(Text(f"pairs: {pairs.n}, of which {len(pairs.broken)} broke an invariant"))
    shown.append(
        Text(
            f"recovery, the software's part: {recovery.n}, median {recovery.median:.2f} s, "
            f"95 % within {recovery.p95:.2f} s"
        )
    )
    shown.append(Text(f"{seconds / max(len(runs), 1):.2f} s a run"))
    shown += [Text(line, style="red") for run in runs for line in wrongs(run)]
    holds = all(row.holds for row in rows) and not pairs.broken and recovery.p95 <= RECOVERED
    fields = _fields(runs, asked, rows, pairs, recovery)
    return Report({**fields, "seconds": seconds}, shown, lambda: _figure(rows), holds=holds)


def replay_report(run: Ran) -> Report:
    """The report of one run that was run again."""
    said = run.verdict
    table = plain_table(str(run.piece), "", "")
    table.row("events", run.events_sha256)
    table.row("checks", str(run.checks))
    table.row("ended", "no end" if said is None else " and ".join(said.ends))
    shown: list[RenderableType] = [table]
    shown += [Text(line, style="red") for line in wrongs(run)]
    fields: dict[str, Json] = {
        "replayed": str(run.piece),
        "events_sha256": run.events_sha256,
        "ended": said is not None and said.ended,
        "ends": [] if said is None else list(said.ends),
        "wrong": list(wrongs(run)),
    }
    return Report(fields, shown, holds=not wrongs(run))


def _fields(
    runs: Sequence[Ran],
    asked: FaultsAsked,
    rows: Sequence[Row],
    pairs: Pairs,
    recovery: RecoveryRow,
) -> dict[str, Json]:
    """What `--json` writes."""
    return {
        "seed": asked.seed,
        "seeds": asked.seeds,
        "runs": len(runs),
        "checks": sum(run.checks for run in runs),
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
        "pairs": {
            "n": pairs.n,
            "broken": [
                {"faults": list(run.piece.ids), "seed": run.piece.seed, "wrong": list(wrongs(run))}
                for run in pairs.broken
            ],
        },
        "recovery": {"n": recovery.n, "median": recovery.median, "p95": recovery.p95},
        "wrong": [line for run in runs for line in wrongs(run)],
    }


def _figure(rows: Sequence[Row]) -> Figure:
    return faults_figure(
        [row.fault for row in rows],
        {
            "ended as named": [row.ended for row in rows],
            "invariants held": [row.invariants for row in rows],
            "without a person": [row.without_person for row in rows],
        },
    )
