"""Measured figures beside their targets."""

import math
from collections.abc import Sequence

from depal.app.files import Json
from depal.app.reports.report import Report, plain_table, verdict
from depal.studies.bench import Figure

_SIGNS = {"lower": "<=", "higher": ">="}


def bench_report(part: str, figures: Sequence[Figure]) -> Report:
    """The report of `depal bench`.

    Args:
        part: what was measured.
        figures: the figures.

    Returns:
        The report; it holds when every target is met.
    """
    table = plain_table(f"{part}: medians", "figure", "value", "target", "unit", "n", "peers", "")
    fields: list[Json] = []
    for figure in figures:
        aim = f"{_SIGNS[figure.better]} {figure.target:g}"
        table.row(
            figure.name,
            f"{figure.value:.3g}",
            "" if math.isnan(figure.target) else aim,
            figure.unit,
            str(figure.n),
            ", ".join(f"{peer.name} {peer.value:.3g}" for peer in figure.peers),
            verdict(figure.met, "met", "missed"),
        )
        fields.append(
            {
                "name": figure.name,
                "value": figure.value,
                "unit": figure.unit,
                "target": figure.target,
                "better": figure.better,
                "n": figure.n,
                "peer": figure.peer,
                "peers": {peer.name: peer.value for peer in figure.peers},
            }
        )
    return Report(
        fields={"part": part, "figures": fields},
        shown=[table],
        holds=all(figure.met for figure in figures),
    )
