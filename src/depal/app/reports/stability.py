"""Stability: margins beside MuJoCo's word, and unloadings with and without the guard."""

from dataclasses import dataclass

from matplotlib.figure import Figure
from rich.table import Table

from depal.app.files import Json
from depal.app.reports.report import (
    Report,
    mean_and_interval,
    plain_table,
    plus_minus,
    verdict,
)
from depal.studies.drawing import Agreed, Along, stability_figure
from depal.studies.stability import LOOSE, Paired, Row, Stability
from depal.studies.stability.unloading import LOOKED_AT
from depal.studies.statistics import Share


@dataclass(frozen=True, slots=True)
class _Check:
    """A figure of the study and whether it is met."""

    name: str
    allowed: str
    measured: str
    holds: bool


def stability_report(result: Stability, seed: int, seconds: float) -> Report:
    """The report of `depal study stability`.

    Args:
        result: what was measured.
        seed: of the sweep.
        seconds: the wall time of the study.

    Returns:
        The report. That few pallets and states say too little is shown, and is no failure; it
        fails where a full packing collapses or a state above the looked-at margin falls.
    """
    checks = _checks(result)
    agreement = result.agreement
    return Report(
        fields={
            "seed": seed,
            "seconds": seconds,
            "w": result.w,
            "threshold": result.threshold,
            "rows": [_row_fields(row) for row in result.rows],
            "pairs": [_pair_fields(pair) for pair in result.paired],
            "agreement": {
                "states": agreement.states,
                "unstable": agreement.unstable,
                "agree": _share_fields(agreement.agree),
                "unstable_called_stable": _share_fields(agreement.missed),
                "stable_called_unstable": _share_fields(agreement.alarms),
                "highest_quick_margin_that_fell": agreement.highest,
            },
            "milliseconds": {
                "candidate": [1e3 * value for value in result.candidate],
                "decision": [1e3 * value for value in result.decision],
                "decisions": result.decisions,
            },
            "checks": [
                {
                    "name": check.name,
                    "allowed": check.allowed,
                    "measured": check.measured,
                    "holds": check.holds,
                }
                for check in checks
            ],
        },
        shown=[_table(result, seed), _checks_table(checks)],
        draw=lambda: _figure(result, seed),
        holds=agreement.highest < LOOKED_AT and not _packings(result, guard=True).count,
    )


def _packings(result: Stability, *, guard: bool) -> Share:
    """How many full packings collapse, all generators together."""
    rows = [row for row in result.rows if row.pallets != LOOSE and row.guard == guard]
    return sum((row.collapse for row in rows), Share())


def _checks(result: Stability) -> list[_Check]:
    agreement = result.agreement
    loose = next(pair for pair in result.paired if pair.pallets == LOOSE)
    saved = next(row.collapse for row in result.rows if row.pallets == LOOSE and not row.guard)
    kept = next(row.collapse for row in result.rows if row.pallets == LOOSE and row.guard)
    packed = _packings(result, guard=True)
    missed = agreement.missed.count / max(1, agreement.states)
    checks = [
        _Check(
            f"linear program and MuJoCo agree, {agreement.states} states, "
            f"{agreement.unstable} unstable",
            ">= 97 %",
            f"{100 * agreement.agree.value:.1f} %",
            agreement.agree.value >= 0.97,  # noqa: PLR2004 - the figure
        ),
        _Check(
            "an unstable state called stable, of all states",
            "<= 1 %",
            f"{100 * missed:.1f} % ({100 * agreement.missed.value:.1f} % of the unstable ones)",
            missed <= 0.01,  # noqa: PLR2004 - the figure
        ),
        _Check(
            "greatest margin without side faces of a state that fell",
            f"< {LOOKED_AT:g} g",
            f"{agreement.highest:.3f} g",
            agreement.highest < LOOKED_AT,
        ),
        _Check(
            f"guard, {saved.of} pairs: collapses without and with it, p (McNemar)",
            "fewer, p < 0.05",
            f"{saved.count} and {kept.count}, p = {loose.p:.2g}",
            kept.count < saved.count and loose.p < 0.05,  # noqa: PLR2004 - the figure
        ),
        _Check(
            "guard: extra actions",
            "<= 0.3",
            plus_minus(loose.extra),
            loose.extra.mean <= 0.3,  # noqa: PLR2004 - the figure
        ),
        _Check(
            f"guard: collapses in {packed.of} full packings",
            "0",
            str(packed.count),
            not packed.count,
        ),
    ]
    if result.candidate:
        checks += [
            _Check(
                "guard: a candidate of about 40 boxes, median",
                "<= 10 ms",
                f"{1e3 * result.candidate[0]:.2f} ms",
                result.candidate[0] <= 0.01,  # noqa: PLR2004 - the figure
            ),
            _Check(
                f"guard: a decision of about 40 boxes, longest of {result.decisions}",
                "<= 100 ms",
                f"{1e3 * result.decision[-1]:.0f} ms",
                result.decision[-1] <= 0.1,  # noqa: PLR2004 - the figure
            ),
        ]
    return checks


def _table(result: Stability, seed: int) -> Table:
    table = plain_table(
        f"Unloadings with and without a guard at {result.threshold:g} g; policy paper, "
        f"w = {result.w:g}, seed {seed}",
        "pallets",
        "guard",
        "unloadings",
        "collapse",
        "actions",
        "least margin [g]",
    )
    for row in result.rows:
        table.row(
            row.pallets,
            "yes" if row.guard else "no",
            f"{row.collapse.of}",
            f"{100 * row.collapse.value:.1f} %",
            plus_minus(row.actions),
            plus_minus(row.margin, 3),
            last=row.guard,
        )
    return table


def _checks_table(checks: list[_Check]) -> Table:
    table = plain_table("Figures", "", "measured", "allowed", "")
    for check in checks:
        mark = verdict(check.holds, "met", "missed")
        table.row(check.name, check.measured, check.allowed, mark)
    return table


def _row_fields(row: Row) -> Json:
    return {
        "pallets": row.pallets,
        "policy": "paper",
        "guard": row.guard,
        "collapse_rate": {"mean": row.collapse.value, "ci95": list(row.collapse.ci95)},
        "actions": mean_and_interval(row.actions),
        "margin": mean_and_interval(row.margin),
        "margin_along": list(row.along),
    }


def _pair_fields(pair: Paired) -> Json:
    return {
        "pallets": pair.pallets,
        "collapse_only_without": pair.saved,
        "collapse_only_with": pair.spoilt,
        "mcnemar_p": pair.p,
        "extra_actions": mean_and_interval(pair.extra),
        "put_later": pair.later,
        "forced": pair.forced,
    }


def _share_fields(share: Share) -> Json:
    return {"count": share.count, "of": share.of, "mean": share.value, "ci95": list(share.ci95)}


def _figure(result: Stability, seed: int) -> Figure:
    without, guarded = (
        Along(row.along, row.collapse.value) for row in result.rows if row.pallets == LOOSE
    )
    agreement = result.agreement
    alarms, missed = agreement.alarms, agreement.missed
    agreed = Agreed(
        stood=(alarms.of - alarms.count, alarms.count),
        fell=(missed.count, missed.of - missed.count),
    )
    note = f"w = {result.w:g}, seed {seed}"
    return stability_figure(without, guarded, agreed, result.threshold, note)
