"""How many boxes must leave before one that nobody has seen."""

from collections.abc import Sequence

from rich.text import Text

from depal.app.files import Json
from depal.app.reports.report import Report, mean_and_interval, plain_table, plus_minus, verdict
from depal.studies.drawing.policies import Measured, policies_figure
from depal.studies.hidden import HiddenRow

REGION = (0.75, 0.85)
"""The region that is to hold 80 % of the belief holds the box in such a share of pallets."""


def hidden_report(rows: Sequence[HiddenRow], pallets: int, seed: int, seconds: float) -> Report:
    """The report of `depal study hidden`.

    Args:
        rows: per kind of pallets one for each policy; those of all together last.
        pallets: how many of each kind were drawn.
        seed: of the study.
        seconds: the wall time.

    Returns:
        The report.
    """
    table = plain_table(
        f"Boxes stored before one that nobody had seen; {pallets:,} pallets a kind, seed {seed}",
        "pallets", "policy", "n", "actions", "saved", "known place", "80 % region", "its size",
        "never",
    )  # fmt: skip
    for number, row in enumerate(rows):
        table.row(
            row.pallets,
            row.policy,
            str(row.actions.n),
            plus_minus(row.actions),
            plus_minus(row.saved),
            f"{row.limit.mean:.2f}",
            f"{row.region.mean:.1%}",
            f"{row.size.mean:.1%}",
            str(row.never),
            last=number % 3 == 2,  # noqa: PLR2004 - policies
        )
    table.caption = Text(
        "saved: paper less the policy, pallet by pallet; known place: the fewest removals of one "
        "who knows where the box is; 80 % region: how often it holds the box after the first look; "
        "its size: of all places where the box could be; never: left out of the means"
    )
    last = rows[-1]
    better, within = last.saved.ci95[0] > 0, REGION[0] <= last.region.mean <= REGION[1]
    said = Text.assemble(
        "searching against the paper's rule: ",
        verdict(better, "better", "not better"),
        f", {plus_minus(last.saved)} boxes fewer; the 80 % region holds the box in ",
        verdict(within, f"{last.region.mean:.1%}", f"{last.region.mean:.1%}"),
    )
    return Report(
        fields={
            "pallets": pallets,
            "seed": seed,
            "seconds": seconds,
            "hidden": [_fields(row) for row in rows],
        },
        shown=[table, said],
        draw=lambda: policies_figure(
            [Measured(row.pallets, row.policy, row.actions.mean, row.limit.mean) for row in rows],
            f"A box that nobody has seen: {_mean(rows, 'paper')} boxes before it by the paper's "
            f"rule, {_mean(rows, 'searches')} by searching",
            "Boxes stored before it, in the mean; stroke: the fewest of one who knows where it is.",
            f"{pallets:,} pallets a kind, seed {seed}",
            "boxes",
        ),
    )


def _mean(rows: Sequence[HiddenRow], policy: str) -> str:
    return f"{[row.actions.mean for row in rows if row.policy == policy][-1]:.1f}"


def _fields(row: HiddenRow) -> Json:
    return {
        "pallets": row.pallets,
        "policy": row.policy,
        "requests": row.actions.n,
        "actions": mean_and_interval(row.actions),
        "saved": mean_and_interval(row.saved),
        "limit": row.limit.mean,
        "region": mean_and_interval(row.region),
        "size": row.size.mean,
        "never": row.never,
    }
