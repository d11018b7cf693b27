"""The picture of `depal bench perception`."""

import math
from collections.abc import Callable

from matplotlib.figure import Figure

from depal.simulation.scenes import Kind, Severity
from depal.studies.bench.perception_result import Result
from depal.studies.drawing.perception import Chart, Dots, perception_figure
from depal.studies.perception.quantities import PERCENTILE, Quantity, quantities


def perception_picture(result: Result) -> Figure:
    """Draws detection of every severity, and the rest of one: where there is, of the normal one.

    Args:
        result: with at least one severity.
    """
    usual = Severity.NORMAL if Severity.NORMAL in result.scenes else next(iter(result.scenes))
    left = [
        _chart(
            result,
            severity,
            f"{severity}: faces",
            lambda line: " faces: " in line.name and not line.unit,
        )
        for severity in result.scenes
    ]
    left.append(
        _chart(result, usual, f"{usual}: relations", lambda line: line.name.startswith(RELATIONS))
    )
    right = [
        _chart(result, usual, f"{usual}: {name}", chosen)
        for name, chosen in (
            ("boxes named", lambda line: line.unit == "%" and line.better == "higher"),
            ("boxes named wrong", lambda line: line.unit == "%" and line.better == "lower"),
            (f"centres, {PERCENTILE}th percentile", lambda line: line.unit == "mm"),
            (f"yaw, {PERCENTILE}th percentile", lambda line: line.unit == "deg"),
        )
    ]
    scenes = ", ".join(f"{len(made)} {severity}" for severity, made in result.scenes.items())
    return perception_figure([left, right], tuple(Kind), _finding(result, usual), scenes)


RELATIONS = ("on top", "occludes")


def _chart(
    result: Result, severity: Severity, name: str, chosen: Callable[[Quantity], bool]
) -> Chart:
    """Some quantities of a severity; they have one unit."""
    lines = [line for line in quantities(severity) if chosen(line)]
    whole = result.score(severity)
    parts = [result.score(severity, kind) for kind in Kind]
    rows = []
    for line in lines:
        got = line.of(whole)
        kinds = tuple(line.of(part).value for part in parts)
        rows.append(Dots(_short(line), kinds, got.value, got.ci95, line.target))
    unit, lower = lines[0].unit, lines[0].better == "lower"
    ceiling = {"": 1.0, "%": 100.0}.get(unit, math.inf)
    return Chart(name, unit, tuple(rows), lower=lower, ceiling=ceiling)


def _short(line: Quantity) -> str:
    """A row's name without what the chart's name says."""
    words = line.name.replace(f", p{PERCENTILE}", "").replace(" faces:", "")
    for part in ("centre ", " boxes", " named wrong", " named", " accepted", ":"):
        words = words.replace(part, " " if part == "centre " else "")
    return " ".join(words.split())


def _finding(result: Result, severity: Severity) -> str:
    """How many faces are found, as a sentence."""
    detected = result.score(severity).detected.values()
    found = sum(one.found.count for one in detected)
    asked = sum(one.found.of for one in detected)
    right = sum(one.right.of for one in detected)
    if not asked or not right:
        return f"Perception, {severity}: no face to be found"
    recall, precision = 100 * found / asked, 100 * found / right
    return (
        f"{severity.capitalize()} scenes: {recall:.1f} % of the faces found, "
        f"{precision:.1f} % of the detections right"
    )
