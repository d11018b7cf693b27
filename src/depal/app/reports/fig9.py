"""Fig. 9, and what is true of it on average."""

from matplotlib.figure import Figure
from rich.text import Text

from depal.app.files import Json
from depal.app.reports.report import (
    Report,
    mean_and_interval,
    mean_and_std,
    plain_table,
    plus_minus,
)
from depal.studies.drawing import PileState, Stack, three_piles
from depal.studies.fig9 import Fig9, Slots
from depal.studies.pillars import NARROW


def fig9_report(result: Fig9, pallets: int, seed: int, seconds: float) -> Report:
    """The report of `depal study fig9`.

    Args:
        result: the measurements and the pallet of the picture.
        pallets: how many were measured.
        seed: of the sweep.
        seconds: the wall time of the study.

    Returns:
        The report.
    """
    table = plain_table(
        f"Fig. 9: share of the pile that stands in pillars narrower than {NARROW:.1f} m after "
        f"{result.steps} steps; {pallets:,} pallets, seed {seed}",
        "requests",
        "h(x)-only",
        "h(x)+l(x)",
        "increase",
    )
    fields: list[Json] = []
    for row in result.rows:
        table.row(
            str(row.requests),
            plus_minus(row.h, 3),
            plus_minus(row.hl, 3),
            plus_minus(row.increase, 3),
        )
        fields.append(
            {
                "requests": row.requests,
                "h": mean_and_std(row.h),
                "hl": mean_and_std(row.hl),
                "increase": mean_and_interval(row.increase),
            }
        )
    table.caption = Text(
        f"w = {result.w}. An increase is real where its interval does not hold 0. The paper shows "
        "one pallet; so does the picture, and it is the plainest of 200."
    )
    return Report(
        fields={
            "pallets": pallets,
            "seed": seed,
            "seconds": seconds,
            "steps": result.steps,
            "w": result.w,
            "narrow": NARROW,
            "rows": fields,
        },
        shown=[table],
        draw=lambda: _figure(result, seed),
    )


def _figure(result: Fig9, seed: int) -> Figure:
    piles = result.example
    stack = Stack(piles.pallet.centres, piles.pallet.sizes, int(piles.wanted[0]), piles.blockers)

    def state(heading: str, left: Slots) -> PileState:
        numbers = (("in pillars", f"{100 * piles.pillars(left):.0f} %"),)
        return PileState(heading, left.tolist(), numbers)

    return three_piles(
        stack,
        (
            state("random configuration", piles.everything),
            state(f"h(x) only, {result.steps} steps", piles.left_h),
            state(f"h(x) + l(x), {result.steps} steps", piles.left_hl),
        ),
        result.steps,
        note=f"w = {result.w}, seed {seed}; the plainest of 200 pallets",
    )
