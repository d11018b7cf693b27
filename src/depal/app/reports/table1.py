"""Table I beside the paper's."""

from collections.abc import Sequence

from matplotlib.figure import Figure
from rich.console import RenderableType
from rich.table import Table
from rich.text import Text

from depal.app.files import Json
from depal.app.reports.report import (
    Report,
    mean_and_interval,
    mean_and_std,
    plain_table,
    plus_minus,
    verdict,
)
from depal.studies import paper
from depal.studies.drawing import TableRow, table_figure
from depal.studies.table1 import Check, Row, Table1


def table1_report(results: Sequence[Table1], seconds: float) -> Report:
    """The report of `depal study table1`.

    Args:
        results: one per generator.
        seconds: the wall time of the study.

    Returns:
        The report; it holds when every check does.
    """
    shown: list[RenderableType] = []
    for result in results:
        shown += [_table(result), _checks(result.checks)]
        if result.stuck:
            shown.append(f"{result.stuck} pallets with a cycle of blockers are left out.")
    return Report(
        fields={
            "pallets": results[0].pallets,
            "seed": results[0].seed,
            "seconds": seconds,
            "limit": results[0].rows[0].limit.mean if len(results) == 1 else None,
            "rows": [_row_fields(result, row) for result in results for row in result.rows],
            "checks": [
                _check_fields(result, check) for result in results for check in result.checks
            ],
            "stuck": sum(result.stuck for result in results),
        },
        shown=shown,
        draw=(lambda: _figure(results[0])) if len(results) == 1 else None,
        holds=all(check.holds for result in results for check in result.checks),
    )


def _row_fields(result: Table1, row: Row) -> Json:
    return {
        "generator": result.generator,
        "w": row.w,
        "h": mean_and_std(row.h),
        "hl": mean_and_std(row.hl),
        "reduction": mean_and_interval(row.reduction),
        "limit": row.limit.mean,
    }


def _check_fields(result: Table1, check: Check) -> Json:
    return {
        "generator": result.generator,
        "name": check.name,
        "holds": check.holds,
        "measured": check.measured,
        "allowed": check.allowed,
    }


def _table(result: Table1) -> Table:
    """The paper's layout: per weight a row of means and a row of deviations."""
    title = (
        f"Table I: boxes stored before the requested one; {result.pallets:,} {result.generator} "
        f"pallets for every weight and both modalities, seed {result.seed}"
    )
    table = plain_table(
        title, "weight", "", "h(x)-only", "paper", "h(x)+l(x)", "paper", "reduction", "paper"
    )
    for row in result.rows:
        printed = paper.TABLE_1.get(row.w) if result.generator == "guillotine" else None
        h, hl, saved = (
            (f"{printed.h_mean:.2f}", f"{printed.hl_mean:.2f}", f"{printed.reduction:.2f}")
            if printed
            else ("", "", "")
        )
        table.row(
            f"w = {row.w}",
            "avg",
            plus_minus(row.h),
            h,
            plus_minus(row.hl),
            hl,
            plus_minus(row.reduction),
            saved,
        )
        stds = (f"{printed.h_std:.2f}", f"{printed.hl_std:.2f}") if printed else ("", "")
        table.row(
            "",
            "std",
            f"{row.h.std:.2f}",
            stds[0],
            f"{row.hl.std:.2f}",
            stds[1],
            "",
            "",
            last=True,
        )
    limit = plus_minus(result.rows[0].limit)
    table.caption = Text(
        f"± is half a 95 % interval of the mean. No order under G can be below {limit}: "
        "mean |T(r)| - 1. The paper has 50 pallets a weight."
    )
    return table


def _checks(checks: Sequence[Check]) -> RenderableType:
    table = plain_table("What must hold", "", "measured", "allowed", "")
    for check in checks:
        mark = verdict(check.holds, "holds", "BROKEN")
        table.row(check.name, f"{check.measured:.3g}", check.allowed, mark)
    return table


def _drawn(row: Row) -> TableRow:
    return TableRow(row.w, row.h.mean, row.h.std, row.hl.mean, row.hl.std)


def _printed() -> list[TableRow]:
    return [
        TableRow(w, row.h_mean, row.h_std, row.hl_mean, row.hl_std)
        for w, row in paper.TABLE_1.items()
    ]


def _figure(result: Table1) -> Figure:
    return table_figure(
        [_drawn(row) for row in result.rows],
        _printed() if result.generator == "guillotine" else [],
        result.pallets,
        note=f"{result.generator} pallets, seed {result.seed}",
    )
