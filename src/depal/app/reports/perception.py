"""What `depal bench perception` prints and writes."""

import math
from collections import Counter
from collections.abc import Iterable, Sequence
from functools import partial
from statistics import median

from rich.console import RenderableType
from rich.text import Text

from depal.app.files import Json
from depal.app.reports.bench import bench_report
from depal.app.reports.perception_picture import perception_picture
from depal.app.reports.report import PlainTable, Report, plain_table, verdict
from depal.simulation.scenes import Kind, Severity
from depal.studies.bench.perception_result import Result
from depal.studies.perception.quantities import Quantity, Value, quantities
from depal.studies.perception.scenes import Measured

ALL = "all"

STEP = 10
"""Times are told by so many visible faces."""

RULES = (
    "A face counts when 70 % of it are seen by any camera within 70 degrees of its normal; it is "
    "found by a detection with IoU > 0.7 in its plane, one to one. A detection of a face that is "
    "there and does not count is neither right nor wrong. Names and relations are of boxes that "
    "were found."
)


def perception_report(result: Result) -> Report:
    """The report of `depal bench perception`.

    Args:
        result: what was measured.

    Returns:
        The report; it holds when every target is met.
    """
    figures = bench_report("perception", result.figures)
    tables: list[RenderableType] = [_table(result, severity) for severity in result.scenes]
    if result.timed:
        tables.append(_times_table(result.timed))
    if result.frames:
        tables.append(_frames_table(result))
    return Report(
        fields={
            **figures.fields,
            "rows": list(_rows(result)),
            "times": list(_time_rows(result)),
            "frames": list(_frame_rows(result)),
        },
        shown=[*tables, Text(RULES, style="dim")],
        draw=partial(perception_picture, result) if result.scenes else None,
        holds=figures.holds,
    )


def _kinds(result: Result, severity: Severity) -> list[Kind | None]:
    """The kinds of scenes that there are, then all together."""
    there = {measured.piece.kind for measured in result.scenes[severity]}
    return [*(kind for kind in Kind if kind in there), None]


def _table(result: Result, severity: Severity) -> PlainTable:
    """One severity: a line for each quantity, a column for each kind of scene."""
    kinds = _kinds(result, severity)
    counts = Counter(measured.piece.kind for measured in result.scenes[severity])
    columns = [f"{kind} ({counts[kind]})" for kind in kinds if kind is not None]
    scenes = len(result.scenes[severity])
    table = plain_table(
        f"perception, {severity}: {scenes} scenes",
        "quantity", *columns, ALL, "95 % interval", "n", "target", "",
    )  # fmt: skip
    scores = [result.score(severity, kind) for kind in kinds]
    lines = quantities(severity)
    for line, after in zip(lines, [*lines[1:], lines[-1]], strict=True):
        values = [line.of(score) for score in scores]
        table.row(
            _with_unit(line),
            *(_shown(value.value, line) for value in values),
            _interval(values[-1], line),
            str(values[-1].n),
            _target(line),
            _verdict(values[-1], line),
            last=_group(line) != _group(after),
        )
    return table


def _group(line: Quantity) -> str:
    """Lines that stand together."""
    return line.name.split(":", maxsplit=1)[0] if ":" in line.name else "names"


def _with_unit(line: Quantity) -> str:
    return f"{line.name} [{line.unit}]" if line.unit else line.name


def _shown(value: float, line: Quantity) -> str:
    if math.isnan(value):
        return "-"
    if not line.unit:
        return f"{value:.3f}"
    return f"{value:.2f}" if line.unit == "%" and 0 < value < 1 else f"{value:.1f}"


def _interval(value: Value, line: Quantity) -> str:
    if value.ci95 is None or not value.n:
        return ""
    return " .. ".join(_shown(end, line) for end in value.ci95)


def _target(line: Quantity) -> str:
    if math.isnan(line.target):
        return ""
    return f"{'<=' if line.better == 'lower' else '>='} {line.target:g}"


def _verdict(value: Value, line: Quantity) -> Text:
    if math.isnan(line.target):
        return Text("")
    lower = line.better == "lower"
    met = value.value <= line.target if lower else value.value >= line.target
    return verdict(met, "met", "missed")


def _by_faces(measured: Iterable[Measured]) -> dict[int, list[Measured]]:
    """By the number of visible faces, in steps."""
    grouped: dict[int, list[Measured]] = {}
    for one in measured:
        grouped.setdefault(one.visible // STEP * STEP, []).append(one)
    return dict(sorted(grouped.items()))


def _times_table(timed: Sequence[Measured]) -> PlainTable:
    table = plain_table(
        "time of a look [s], median (most)", "visible faces", "looks", "first", "later"
    )
    for faces, group in _by_faces(timed).items():
        table.row(
            f"{faces} to {faces + STEP - 1}",
            str(len(group)),
            *(
                f"{median(seconds):.2f} ({max(seconds):.2f})"
                for seconds in ([one.first for one in group], [one.later for one in group])
            ),
        )
    return table


def _frames_table(result: Result) -> PlainTable:
    table = plain_table(
        "real frames", "frame", "turn [deg]", "brightness", "marked", "found", "false"
    )
    for name, scores in result.frames.items():
        for number, score in enumerate(scores, start=1):
            variant = score.variant
            table.row(
                name,
                f"{variant.turn:+g}" if variant.turn else "0",
                f"{variant.light:g}",
                str(score.masks),
                str(score.found),
                str(score.false),
                last=number == len(scores),
            )
    return table


def _rows(result: Result) -> Iterable[Json]:
    for severity in result.scenes:
        for kind in _kinds(result, severity):
            score = result.score(severity, kind)
            for line in quantities(severity):
                value = line.of(score)
                yield {
                    "severity": severity.value,
                    "kind": ALL if kind is None else kind.value,
                    "scenes": score.looks,
                    "name": line.name,
                    "value": value.value,
                    "unit": line.unit,
                    "n": value.n,
                    "ci95": None if value.ci95 is None else list(value.ci95),
                }


def _time_rows(result: Result) -> Iterable[Json]:
    for faces, group in _by_faces(result.timed).items():
        yield {
            "faces": [faces, faces + STEP - 1],
            "looks": len(group),
            "first": median(one.first for one in group),
            "later": median(one.later for one in group),
        }


def _frame_rows(result: Result) -> Iterable[Json]:
    for name, scores in result.frames.items():
        for score in scores:
            yield {
                "frame": name,
                "turn": score.variant.turn,
                "light": score.variant.light,
                "marked": score.masks,
                "found": score.found,
                "false": score.false,
            }
