"""How many boxes must leave before a requested one, with the proven minimum."""

from collections.abc import Sequence
from dataclasses import asdict, dataclass

from rich.console import RenderableType
from rich.text import Text

from depal.app.files import Json
from depal.app.reports.report import Report, mean_and_interval, plain_table, plus_minus, verdict
from depal.app.retrieval import RetrievalAsked, RetrievalResult, worse
from depal.studies.drawing.retrieval import Bar, retrieval_figure
from depal.studies.retrieval import Checked, Row, StackRows
from depal.studies.table1 import FULL_SIZE


def retrieval_report(result: RetrievalResult, asked: RetrievalAsked, seconds: float) -> Report:
    """The report of `depal study retrieval`.

    Args:
        result: what was found.
        asked: the options.
        seconds: the wall time of the study.

    Returns:
        The report; it holds when no request took `access` more actions than `paper` under one
        model, no plan was left unproven, and the second program agreed.
    """
    above, unproven = worse(result.stacks), sum(row.unproven for row in result.rows)
    checks = checks_of(result)
    shown: list[RenderableType] = [_table(result.rows, asked), _stacks(result.stacks)]
    shown.append(
        Text.assemble(
            "access above paper under one model: ",
            verdict(above == 0, "never", f"{above} requests"),
            "; plans not proven to be the smallest: ",
            verdict(unproven == 0, "none", str(unproven)),
        )
    )
    shown += [_refereed(each) for each in result.checked]
    return Report(
        fields={
            "pallets": asked.pallets,
            "cell_pallets": min(asked.cell_pallets, asked.pallets),
            "seed": asked.seed,
            "seconds": seconds,
            "rows": [_fields(row) for row in result.rows],
            "deliveries": [_stack_fields(stack) for stack in result.stacks],
            "above": above,
            "unproven": unproven,
            "checks": [asdict(check) for check in checks],
            "referee": [
                {
                    "pallets": each.pallets,
                    "compared": each.compared,
                    "equal": each.equal,
                    "chosen": each.chosen,
                }
                for each in result.checked
            ],
        },
        shown=shown,
        draw=lambda: retrieval_figure(
            [
                Bar(
                    row.pallets,
                    row.side_only,
                    row.clearance,
                    row.policy,
                    row.actions.mean,
                    row.limit.mean,
                )
                for row in result.rows
            ],
            note=f"{asked.pallets:,} pallets a kind, seed {asked.seed}",
        ),
        holds=all(check.holds for check in checks),
    )


LIMITS = {0.0: 3.3, 0.25: 4.78, 0.5: 5.77, 0.75: 6.55, 1.0: 7.16}
"""Of `guillotine` pallets by the share of side-only boxes, as prototypes measured them."""

ENOUGH = 1_000
"""Fewer pallets say too little of a mean for a check that could fail."""

ERRORS = 3


@dataclass(frozen=True, slots=True)
class Check:
    """Something that must hold.

    Attributes:
        name: what.
        allowed: what it may be, in words.
        measured: what it is, in words.
        holds: whether it does.
    """

    name: str
    allowed: str
    measured: str
    holds: bool


def checks_of(result: RetrievalResult) -> list[Check]:
    """What must hold for the policy to be as good as it can be."""
    above, unproven = worse(result.stacks), sum(row.unproven for row in result.rows)
    checks = [
        Check(
            f"requests of {len({stack.delivery for stack in result.stacks})} real deliveries for "
            "which access takes more actions than paper under one model",
            "0",
            str(above),
            above == 0,
        ),
        Check(
            "plans of access that are not proven to be the smallest",
            "0",
            str(unproven),
            unproven == 0,
        ),
    ]
    checks += [
        Check(
            f"{each.pallets}: another program proves the same minimum",
            f"{each.compared} of {each.compared}",
            f"{each.equal} of {each.compared}, a way chosen on {each.chosen}",
            each.equal == each.compared,
        )
        for each in result.checked
    ]
    for row in result.rows:
        known = row.pallets == "guillotine" and not row.clearance and row.side_only in LIMITS
        if not known or row.policy != "access" or row.actions.n < ENOUGH:
            continue
        slack = 0.0 if row.actions.n >= FULL_SIZE else ERRORS * row.actions.error
        most = LIMITS[row.side_only] + 0.2 + slack
        mean = row.actions.mean
        name = f"guillotine, {row.side_only:.0%} side-only: boxes before the requested one, access"
        checks.append(Check(name, f"<= {most:.2f}", f"{mean:.2f}", mean <= most))
    return checks


def _refereed(each: Checked) -> Text:
    return Text.assemble(
        f"{each.pallets}: another program proves the same minimum on ",
        verdict(each.equal == each.compared, f"{each.equal}", f"{each.equal}"),
        f" of {each.compared} pallets; on {each.chosen} a way had to be chosen",
    )


def _fields(row: Row) -> Json:
    return {
        "pallets": row.pallets,
        "side_only": row.side_only,
        "clearance": row.clearance,
        "policy": row.policy,
        "requests": row.actions.n,
        "actions": mean_and_interval(row.actions),
        "limit": row.limit.mean,
        "gap": row.gap.mean,
        "never": row.never,
        "unproven": row.unproven,
    }


def _stack_fields(stack: StackRows) -> Json:
    return {
        "delivery": stack.delivery,
        "boxes": stack.boxes,
        "above": stack.above,
        "rows": [_fields(row) for row in stack.rows],
    }


def _table(rows: Sequence[Row], asked: RetrievalAsked) -> RenderableType:
    title = (
        f"Boxes stored before the requested one; {asked.pallets:,} pallets a kind, "
        f"{min(asked.cell_pallets, asked.pallets):,} of them in the cell, seed {asked.seed}"
    )
    table = plain_table(
        title, "pallets", "side-only", "clearance", "policy", "actions", "minimum", "gap", "never"
    )
    for number, row in enumerate(rows):
        table.row(
            row.pallets,
            f"{row.side_only:.0%}",
            "and reach" if row.clearance else "no",
            row.policy,
            plus_minus(row.actions),
            f"{row.limit.mean:.2f}",
            f"{row.gap.mean:.2f}",
            str(row.never),
            last=number % 2 == 1,
        )
    table.caption = Text(
        "minimum: proven, under the same rule of what blocks what; gap: above it, in the mean; "
        "never: requests whose box was never free; where one policy has one it is left out of both "
        "means. Side-only boxes are taken from the front alone."
    )
    return table


def _stacks(stacks: Sequence[StackRows]) -> RenderableType:
    title = "Real deliveries, every box requested once: actions (gap)"
    table = plain_table(title, "delivery", "boxes", "clearance", "paper", "access")
    for stack in stacks:
        paper, access = stack.rows
        table.row(
            stack.delivery,
            str(stack.boxes),
            "and reach" if paper.clearance else "no",
            *(f"{row.actions.mean:.2f} ({row.gap.mean:.2f})" for row in (paper, access)),
        )
    return table
