"""Case study 2 beside Fig. 10."""

from collections.abc import Sequence

from depal.app.files import Json
from depal.app.reports.report import Report, plain_table
from depal.studies import paper
from depal.studies.case2 import REQUESTED, LayoutResult
from depal.studies.drawing import ScoredLayout, SeenBox, scored_front

ROBUST_SHARE = 0.95
ROBUST_LAYOUTS = ("5-5", "3-3-2-2")
"""The layouts whose share under jitter is a figure of the project."""


def case2_report(results: Sequence[LayoutResult], w: float, seed: int, seconds: float) -> Report:
    """The report of `depal study case2`.

    Args:
        results: one per layout.
        w: the weight of Eq. (3).
        seed: of the jitter.
        seconds: the wall time of the study.

    Returns:
        The report; it holds when b1 comes as in the paper, at the paper's weight.
    """
    title = f"Case study 2: which box b1 is; w = {w}, p(b1) = {paper.CASE_2_PRIORITY}"
    table = plain_table(
        title,
        "layout",
        "without",
        "paper",
        "with",
        "paper",
        "as in the paper under jitter",
        "draws",
    )
    fields: list[Json] = []
    for result in results:
        run = result.nominal
        table.row(
            result.layout.name,
            f"{run.rank_without}.",
            f"{paper.CASE_2_RANK_WITHOUT}.",
            f"{run.rank_with}.",
            f"{paper.CASE_2_RANK_WITH}.",
            f"{100 * result.robust:.1f} %" if result.draws else "",
            f"{result.draws:,}",
        )
        fields.append(
            {
                "layout": result.layout.name,
                "without": run.rank_without,
                "with": run.rank_with,
                "robust": result.robust if result.draws else None,
                "draws": result.draws,
                "sequence_without": [*run.before],
                "sequence_with": [*run.after],
            }
        )
    return Report(
        fields={"w": w, "seed": seed, "seconds": seconds, "layouts": fields},
        shown=[table],
        draw=lambda: scored_front(
            [_drawn(result) for result in results],
            note=f"w = {w}, p(b1) = {paper.CASE_2_PRIORITY}",
        ),
        holds=w != paper.CASE_2_WEIGHT or all(map(_as_printed, results)),
    )


def _as_printed(result: LayoutResult) -> bool:
    run = result.nominal
    nominal = (run.rank_without, run.rank_with)
    if nominal != (paper.CASE_2_RANK_WITHOUT, paper.CASE_2_RANK_WITH):
        return False
    must_be_robust = result.draws and result.layout.name in ROBUST_LAYOUTS
    return not must_be_robust or result.robust >= ROBUST_SHARE


def _drawn(result: LayoutResult) -> ScoredLayout:
    run = result.nominal
    names = [box.id for box in run.boxes]
    return ScoredLayout(
        boxes=tuple(
            SeenBox(box.id, box.shape.centre, box.shape.size, run.h[box.id], run.s[box.id])
            for box in run.boxes
        ),
        requested=names.index(REQUESTED),
        before=tuple(names.index(name) for name in run.before),
        after=tuple(names.index(name) for name in run.after),
        name=result.layout.name,
    )
