"""What is reported of perception: each quantity with its target, from a score."""

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import partial
from typing import Literal

import numpy as np

from depal.perception.faces import Facing
from depal.simulation.scenes import Severity
from depal.studies.perception.identity import Names
from depal.studies.perception.poses import PoseError
from depal.studies.perception.relations import RelationCounts
from depal.studies.perception.score import Score
from depal.studies.statistics import Share

PERCENTILE = 95
"""Of errors of poses."""

DETECTED = {Severity.EASY: math.nan, Severity.NORMAL: 0.95, Severity.HARD: 0.90}
"""What precision and recall of faces should reach."""


@dataclass(frozen=True, slots=True)
class Value:
    """A measured value.

    Attributes:
        value: NaN where there was nothing to measure.
        n: out of how many.
        ci95: its 95 % interval, where it is a share.
    """

    value: float
    n: int
    ci95: tuple[float, float] | None = None


@dataclass(frozen=True, slots=True)
class Quantity:
    """What a line of the table says.

    Attributes:
        name: of the quantity.
        unit: of the value; empty for shares.
        target: what it should reach; NaN where it only stands there.
        better: whether lower or higher values are better.
        of: takes it from a score.
    """

    name: str
    unit: str
    target: float
    better: Literal["lower", "higher"]
    of: Callable[[Score], Value]


def quantities(severity: Severity) -> list[Quantity]:
    """All lines of one severity's table; what is no detection has a target where it is normal."""
    detection = [line for facing in Facing for line in _detection(facing, DETECTED[severity])]
    others = [line for facing in Facing for line in _poses(facing)]
    others += [*_names(), *_relations("on top", _on_top), *_relations("occludes", _occludes)]
    if severity is not Severity.NORMAL:
        others = [replace(line, target=math.nan) for line in others]
    return detection + others


def _detection(facing: Facing, target: float) -> list[Quantity]:
    name = f"{facing.value} faces"
    return [
        Quantity(
            f"{name}: precision", "", target, "higher", lambda s: _share(s.detected[facing].right)
        ),
        Quantity(
            f"{name}: recall", "", target, "higher", lambda s: _share(s.detected[facing].found)
        ),
    ]


def _poses(facing: Facing) -> list[Quantity]:
    """Of grasp faces, those of boxes that none stands on or before, and of all that were found."""
    errors: dict[str, tuple[str, float, float, Callable[[PoseError], float]]] = {
        "centre sideways": ("mm", 8.0, 1e3, lambda error: error.sideways),
        "centre in depth": ("mm", 8.0, 1e3, lambda error: abs(error.depth)),
        "yaw": ("deg", 1.0, 180 / math.pi, lambda error: abs(error.yaw)),
    }
    return [
        Quantity(
            f"{facing.value} {which}: {name}, p{PERCENTILE}",
            unit,
            target if grasp else math.nan,
            "lower",
            partial(_percentile, facing=facing, grasp=grasp, scale=scale, of=of),
        )
        for which, grasp in (("grasp faces", True), ("faces", False))
        for name, (unit, target, scale, of) in errors.items()
    ]


def _names() -> list[Quantity]:
    named = [
        Quantity(f"{stock} boxes named", "%", target, "higher", partial(_named, stock=stock))
        for stock, target in (("printed", 95.0), ("kraft", 75.0), ("plain", math.nan))
    ]
    return [
        *named,
        Quantity("known boxes named wrong", "%", 0.1, "lower", _wrong),
        Quantity("named boxes seen twice", "%", math.nan, "lower", _twice),
        Quantity("unknown boxes accepted", "%", 0.5, "lower", lambda s: _bad(s.names.unknown)),
        Quantity("siblings named", "%", math.nan, "higher", lambda s: _good(s.names.all_siblings)),
        Quantity(
            "siblings named wrong", "%", math.nan, "lower", lambda s: _bad(s.names.all_siblings)
        ),
        Quantity(
            "unknown siblings accepted",
            "%",
            math.nan,
            "lower",
            lambda s: _bad(s.names.unknown_siblings),
        ),
    ]


def _relations(name: str, of: Callable[[Score], RelationCounts]) -> list[Quantity]:
    return [
        Quantity(f"{name}: precision", "", 0.95, "higher", lambda s: _share(of(s).right)),
        Quantity(f"{name}: recall", "", 0.95, "higher", lambda s: _share(of(s).found)),
    ]


def _on_top(score: Score) -> RelationCounts:
    return score.on_top


def _occludes(score: Score) -> RelationCounts:
    return score.occludes


def _percentile(
    score: Score, facing: Facing, *, grasp: bool, scale: float, of: Callable[[PoseError], float]
) -> Value:
    chosen = [error for error in score.poses if error.facing is facing]
    errors = [scale * of(error) for error in chosen if error.grasp or not grasp]
    return Value(float(np.percentile(errors, PERCENTILE)) if errors else math.nan, len(errors))


def _named(score: Score, stock: str) -> Value:
    return _good(score.names.known.get(stock, Names()))


def _good(names: Names) -> Value:
    return _share(Share(names.right, names.boxes), 100.0)


def _bad(names: Names) -> Value:
    return _share(Share(names.wrong, names.boxes), 100.0)


def _wrong(score: Score) -> Value:
    """Named as another product, and names of boxes that are not there."""
    names = score.names.all_known
    return _share(Share(min(names.wrong + score.names.phantoms, names.boxes), names.boxes), 100.0)


def _twice(score: Score) -> Value:
    """Of known boxes those that were seen as two, and the second named as well."""
    boxes = score.names.all_known.boxes
    return _share(Share(min(score.names.twice, boxes), boxes), 100.0)


def _share(share: Share, scale: float = 1.0) -> Value:
    low, high = share.ci95
    return Value(scale * share.value, share.of, (scale * low, scale * high))
