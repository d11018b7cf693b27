"""Fig. 8 beside the paper's."""

from rich.text import Text

from depal.app.files import Json
from depal.app.reports.report import Report, mean_and_interval, plain_table, plus_minus
from depal.studies import paper
from depal.studies.drawing import Reduction, reduction_over_weight
from depal.studies.table1 import Table1


def fig8_report(result: Table1, seconds: float) -> Report:
    """The report of `depal study fig8`.

    Args:
        result: case study 1 over the paper's weights.
        seconds: the wall time of the study.

    Returns:
        The report; it holds when every check of case study 1 does.
    """
    title = (
        f"Fig. 8: actions saved by the request; {result.pallets:,} {result.generator} pallets, "
        f"seed {result.seed}"
    )
    table = plain_table(title, "weight", "reduction", "95 % interval", "paper")
    fields: list[Json] = []
    for row in result.rows:
        printed = paper.TABLE_1.get(row.w)
        low, high = row.reduction.ci95
        table.row(
            f"w = {row.w}",
            plus_minus(row.reduction),
            f"{low:.2f} .. {high:.2f}",
            f"{printed.reduction:.2f}" if printed else "",
        )
        fields.append(
            {
                "w": row.w,
                "reduction": mean_and_interval(row.reduction),
                "paper": printed.reduction if printed else None,
            }
        )
    broken = [check.name for check in result.checks if not check.holds]
    return Report(
        fields={
            "pallets": result.pallets,
            "seed": result.seed,
            "seconds": seconds,
            "rows": fields,
            "broken": [*broken],
        },
        shown=[table, *(Text(f"BROKEN: {name}", style="red") for name in broken)],
        draw=lambda: reduction_over_weight(
            [Reduction(row.w, row.reduction.mean, *row.reduction.ci95) for row in result.rows],
            [(w, row.reduction) for w, row in paper.TABLE_1.items()],
            note=f"{result.pallets:,} {result.generator} pallets, seed {result.seed}",
        ),
        holds=not broken,
    )
