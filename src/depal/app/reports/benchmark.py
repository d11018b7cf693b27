"""The benchmark's table, for people, for programs and for docs/benchmark.md."""

from collections.abc import Sequence
from pathlib import Path

from depal.app.files import Json
from depal.app.reports.report import Report, mean_and_interval, plain_table, plus_minus
from depal.errors import SettingError
from depal.studies.benchmark import BenchmarkRow

BEGIN, END = "<!-- benchmark: begin -->", "<!-- benchmark: end -->"
HEAD = ("pallets", "policy", "actions", "gap", "lateness", "collapses", "margin", "decision")


def benchmark_report(
    rows: Sequence[BenchmarkRow], pallets: int, seed: int, seconds: float
) -> Report:
    """The report of `depal study benchmark`.

    Args:
        rows: per kind of pallets one for each policy.
        pallets: of each kind.
        seed: of every random number.
        seconds: the wall time of the study.
    """
    title = f"{pallets:,} pallets of each kind, the same for every policy; seed {seed}"
    table = plain_table(title, *HEAD)
    for number, row in enumerate(rows):
        last = number + 1 == len(rows) or rows[number + 1].pallets != row.pallets
        table.row(*_cells(row), last=last)
    return Report(
        fields={
            "pallets": pallets,
            "seed": seed,
            "seconds": seconds,
            "rows": [_fields(row) for row in rows],
        },
        shown=[table],
    )


def checked_page(page: Path) -> tuple[str, str]:
    """What stands before and after the table of a page.

    Raises:
        SettingError: the page cannot be read, or has no marks for a table.
    """
    try:
        text = page.read_text(encoding="utf-8")
    except OSError as error:
        raise SettingError("--into", f"{page}: {error.strerror}", "a page with marks") from error
    before, begin, rest = text.partition(BEGIN)
    _, end, after = rest.partition(END)
    if not (begin and end):
        raise SettingError("--into", f"{page} has no marks", f"{BEGIN} and, below it, {END}")
    return before, after


def write_into(page: Path, rows: Sequence[BenchmarkRow], pallets: int, seed: int) -> None:
    """Puts the table between the two marks of a page.

    Raises:
        SettingError: the page cannot be read, or has no such marks.
    """
    before, after = checked_page(page)
    table = "\n".join(
        [_line(HEAD), _line(["---"] * len(HEAD)), *(_line(_cells(row)) for row in rows)]
    )
    note = f"{pallets:,} pallets of each kind, the same for every policy; seed {seed}."
    page.write_text(f"{before}{BEGIN}\n{note}\n\n{table}\n{END}{after}", encoding="utf-8")


def _line(cells: Sequence[str]) -> str:
    return f"| {' | '.join(cells)} |"


def _cells(row: BenchmarkRow) -> tuple[str, ...]:
    low, high = row.collapse.ci95
    return (
        row.pallets,
        row.policy,
        plus_minus(row.actions),
        f"{row.gap.mean:.2f}",
        plus_minus(row.lateness, 1),
        f"{100 * row.collapse.value:.1f} % ({100 * low:.1f} .. {100 * high:.1f})",
        f"{row.margin.mean:.3f} g",
        f"{row.milliseconds.mean:.1f} ms",
    )


def _fields(row: BenchmarkRow) -> Json:
    return {
        "pallets": row.pallets,
        "policy": row.policy,
        "actions": mean_and_interval(row.actions),
        "gap": row.gap.mean,
        "lateness": mean_and_interval(row.lateness),
        "collapse_rate": {"mean": row.collapse.value, "ci95": list(row.collapse.ci95)},
        "margin": row.margin.mean,
        "milliseconds": row.milliseconds.mean,
    }
