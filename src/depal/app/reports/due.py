"""How late several requests are served."""

from collections.abc import Sequence

from rich.text import Text

from depal.app.files import Json
from depal.app.reports.report import Report, mean_and_interval, plain_table, plus_minus
from depal.studies.drawing.policies import Measured, policies_figure
from depal.studies.due import POLICIES, SMALL, DueRow


def due_report(
    rows: Sequence[DueRow], pallets: int, small: int, seed: int, seconds: float
) -> Report:
    """The report of `depal study due`.

    Args:
        rows: one per policy, kind by kind.
        pallets: how many of each kind.
        small: how many with at most ten boxes, beside the exact optimum.
        seed: of the study.
        seconds: the wall time.

    Returns:
        The report.
    """
    table = plain_table(
        f"Weighted lateness in actions; {pallets:,} pallets a kind, {small:,} of at most {SMALL} "
        f"boxes, seed {seed}",
        "pallets", "side-only", "arrivals", "policy", "n", "lateness", "saved", "optimum", "above",
        "never",
    )  # fmt: skip
    for number, row in enumerate(rows):
        table.row(
            _size(row),
            f"{row.side_only:.0%}",
            row.arrivals,
            row.policy,
            str(row.lateness.n),
            plus_minus(row.lateness),
            plus_minus(row.saved),
            "" if row.optimum is None else f"{row.optimum.mean:.2f}",
            "" if row.above is None else f"{row.above:.1%}",
            str(row.never),
            last=(number + 1) % len(POLICIES) == 0,
        )
    table.caption = Text(
        "lateness: priority times actions after due, summed over the requests of a pallet; saved: "
        "paper less the policy, pallet by pallet; optimum: exact, over all orders of all boxes"
    )
    return Report(
        fields={
            "pallets": pallets,
            "small": small,
            "seed": seed,
            "seconds": seconds,
            "due": [_fields(row) for row in rows],
        },
        shown=[table],
        draw=lambda: policies_figure(
            [
                Measured(
                    _kind(row),
                    row.policy,
                    row.lateness.mean,
                    None if row.optimum is None else row.optimum.mean,
                )
                for row in rows
            ],
            f"Weighted lateness ({_kind(rows[0])}): "
            + ", ".join(f"{row.lateness.mean:.1f} by {row.policy}" for row in rows[:3]),
            "Priority times actions after due, per pallet; stroke: the exact minimum, where it is "
            "known.",
            f"{pallets:,} pallets a kind, seed {seed}",
            "actions",
        ),
    )


def _size(row: DueRow) -> str:
    return f"{row.pallets}, <= {SMALL} boxes" if row.small else row.pallets


def _kind(row: DueRow) -> str:
    parts = [_size(row), f"{row.side_only:.0%} side-only" if row.side_only else ""]
    parts.append("random arrivals" if row.arrivals == "random" else "")
    return ", ".join(part for part in parts if part)


def _fields(row: DueRow) -> Json:
    return {
        "pallets": row.pallets,
        "side_only": row.side_only,
        "arrivals": row.arrivals,
        "small": row.small,
        "policy": row.policy,
        "requests": row.lateness.n,
        "lateness": mean_and_interval(row.lateness),
        "saved": mean_and_interval(row.saved),
        "optimum": None if row.optimum is None else row.optimum.mean,
        "above": row.above,
        "never": row.never,
    }
