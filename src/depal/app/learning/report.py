"""What was learned, as a table, a picture and JSON."""

import math
from collections.abc import Sequence

from matplotlib.figure import Figure
from rich.console import RenderableType
from rich.text import Text

from depal.app.files import Json
from depal.app.learning.job import Lesson
from depal.app.reports.report import Report, plain_table
from depal.selection import PAPER_WEIGHTS
from depal.selection.learning import Estimate, Finding, Learned
from depal.studies.drawing.weights import DrawnWeight, weights_figure
from depal.studies.learning import HeldOut, Recovery, Teacher

NAMES = {
    "w": "w, of the requests",
    "side": "side, of |y| in h",
    "depth": "depth, of x_max - x in h",
    "height": "height, of z in h",
}
PAPER: dict[str, float] = {
    "side": PAPER_WEIGHTS.side,
    "depth": PAPER_WEIGHTS.depth,
    "height": PAPER_WEIGHTS.height,
}

RECOVERED = 0.05
"""A weight is recovered when it is within this share of the true one."""


def learn_report(lesson: Lesson, seconds: float) -> Report:
    """The report of `depal learn`."""
    learned = lesson.learned
    title = f"{learned.choices:,} choices at {lesson.pallets} pallets: {learned.finding.value}"
    table = plain_table(title, "", "learned", "95 % interval", "paper")
    for name, words in NAMES.items():
        estimate: Estimate = getattr(learned, name)
        paper = f"{PAPER[name]:.3f}" if name in PAPER else ""
        table.row(words, _said(estimate.value), _interval(estimate), paper)
    label = "temperature T [m]" if learned.w.known else "temperature T / (1 - w) [m]"
    table.row(label, _said(learned.temperature.value, 4), _interval(learned.temperature, 4), "")
    shown: list[RenderableType] = [table, *(Text(note) for note in learned.notes)]
    shown += [Text(line) for line in _told(lesson)]
    return Report(
        fields={"seconds": seconds, **lesson_fields(lesson)},
        shown=shown,
        draw=lambda: _figure(lesson),
        holds=learned.finding is not Finding.SILENT,
    )


def _told(lesson: Lesson) -> list[str]:
    """What was left out, and how well it predicts."""
    lines = []
    if lesson.forced:
        lines.append(f"{lesson.forced} boxes left when nothing else could be taken: no choices.")
    if lesson.blocked:
        lines.append(
            f"{lesson.blocked} boxes left while another stood on or before them: the model has no "
            "word for that, and they are not used."
        )
    check = lesson.check
    if check is None:
        lines.append("Too few pallets to hold some out: not checked.")
        return lines
    low, high = check.taken.ci95
    lines.append(
        f"Learned from {check.learned_from} pallets and tried on the other {check.pallets}: the "
        f"best-scored box was taken in {100 * check.taken.value:.1f} % of {check.choices:,} "
        f"choices [{100 * low:.1f}, {100 * high:.1f}], by chance {100 * check.by_chance:.1f} %; "
        f"log-likelihood of a choice {check.log_likelihood:.3f}, by chance "
        f"{check.log_chance:.3f} ({100 * check.explained:.0f} % explained)."
    )
    return lines


def lesson_fields(lesson: Lesson) -> dict[str, Json]:
    """What `--json` writes."""
    return {
        "sources": list(lesson.sources),
        "pallets": lesson.pallets,
        "forced": lesson.forced,
        "blocked": lesson.blocked,
        "resamples": lesson.resamples,
        **learned_fields(lesson.learned),
        "held_out": None if lesson.check is None else _check_fields(lesson.check),
    }


def learned_fields(learned: Learned) -> dict[str, Json]:
    """What was learned."""
    estimates: dict[str, Json] = {
        name: _estimate_fields(getattr(learned, name)) for name in (*NAMES, "temperature")
    }
    return {
        "finding": learned.finding.name.lower(),
        **estimates,
        "choices": learned.choices,
        "log_likelihood": learned.log_likelihood,
        "by_chance": learned.by_chance,
        "notes": list(learned.notes),
    }


def _estimate_fields(estimate: Estimate) -> dict[str, Json]:
    return {"value": estimate.value, "ci95": [estimate.low, estimate.high]}


def _check_fields(check: HeldOut) -> dict[str, Json]:
    return {
        "learned_from": check.learned_from,
        "pallets": check.pallets,
        "choices": check.choices,
        "taken": {"mean": check.taken.value, "ci95": list(check.taken.ci95)},
        "by_chance": check.by_chance,
        "log_likelihood": check.log_likelihood,
        "log_chance": check.log_chance,
    }


def _said(value: float, digits: int = 3) -> str:
    if math.isnan(value):
        return "unknown"
    return "infinite" if math.isinf(value) else f"{value:.{digits}f}"


def _interval(estimate: Estimate, digits: int = 3) -> str:
    return f"{_said(estimate.low, digits)} .. {_said(estimate.high, digits)}"


def _figure(lesson: Lesson) -> Figure:
    learned = lesson.learned
    lines = []
    for name, words in NAMES.items():
        each: Estimate = getattr(learned, name)
        value = each.value if each.known else None
        lines.append(DrawnWeight(words, value, each.low, each.high, PAPER.get(name)))
    said = ", ".join(f"{name} {_said(getattr(learned, name).value)}" for name in NAMES)
    note = f"{learned.choices:,} choices at {lesson.pallets} pallets"
    return weights_figure(lines, f"Learned from orders: {said}", "the paper's", note)


def recovery_report(
    teacher: Teacher, pallets: int, results: Sequence[Recovery], seconds: float
) -> Report:
    """The report of `depal study learning`; it never fails: it measures."""
    table = plain_table(
        f"Learned from {pallets} drawn orders, T = {teacher.temperature:g} m, {len(results)} times",
        "",
        "true",
        "mean error",
        "greatest error",
        f"within {100 * RECOVERED:.0f} %",
        "in the interval",
    )
    rows: list[Json] = []
    for name, words in NAMES.items():
        relative = [result.relative[name] for result in results]
        within = sum(each <= RECOVERED for each in relative)
        held = sum(result.held[name] for result in results)
        mean, greatest = sum(relative) / len(relative), max(relative)
        table.row(
            words,
            f"{teacher.truth[name]:.3f}",
            f"{100 * mean:.1f} %",
            f"{100 * greatest:.1f} %",
            f"{within} of {len(results)}",
            f"{held} of {len(results)}",
        )
        rows.append(
            {
                "weight": name,
                "true": teacher.truth[name],
                "mean_error": mean,
                "greatest_error": greatest,
                "greatest_absolute_error": max(result.errors[name] for result in results),
                "within": within,
                "held": held,
            }
        )
    followed = sum(result.followed.count for result in results)
    choices = sum(result.followed.of for result in results)
    whole = sum(max(result.relative.values()) <= RECOVERED for result in results)
    said = (
        f"All four within {100 * RECOVERED:.0f} % of the true ones in {whole} of {len(results)}. "
        f"The policy took the best-scored box in {100 * followed / max(choices, 1):.1f} % of "
        f"{choices:,} choices."
    )
    fields: dict[str, Json] = {
        "pallets": pallets,
        "temperature": teacher.temperature,
        "generators": list(teacher.generators),
        "requests": teacher.requests,
        "seconds": seconds,
        "rows": rows,
        "recovered": whole,
        "of": len(results),
        "followed": followed / max(choices, 1),
        "runs": [{"seed": each.seed, **learned_fields(each.learned)} for each in results],
    }
    return Report(fields=fields, shown=[table, said])
