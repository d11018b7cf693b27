"""Everything that one bench of perception has measured."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from statistics import median

from depal.simulation.scenes import Kind, Severity
from depal.studies.bench.figure import Figure
from depal.studies.perception.quantities import quantities
from depal.studies.perception.real import FrameScore, Variant
from depal.studies.perception.scenes import Measured
from depal.studies.perception.score import Score

FIRST_LOOK, LATER_LOOK = 1.2, 0.5
"""The simulated clock charges so much for a look's computing [s]."""

FOUND, STILL_FOUND = 10 / 12, 9 / 12
"""Shares of a real frame's marked faces that should be found: as it is, and at the worst."""

FALSE = 1
"""So many detections in a real frame may be of something else."""


@dataclass(frozen=True, slots=True)
class Result:
    """What was measured.

    Attributes:
        scenes: by severity, in the order of their seeds.
        timed: scenes with many faces, looked at one after another.
        frames: real frames by their names, each in all its variants, unchanged first.
    """

    scenes: Mapping[Severity, Sequence[Measured]]
    timed: Sequence[Measured] = ()
    frames: Mapping[str, Sequence[FrameScore]] = field(default_factory=dict)

    def score(self, severity: Severity, kind: Kind | None = None) -> Score:
        """All scenes of a severity together, or those of one kind."""
        chosen = (
            measured.score
            for measured in self.scenes[severity]
            if kind is None or measured.piece.kind is kind
        )
        return sum(chosen, Score())

    @property
    def figures(self) -> list[Figure]:
        """What is printed beside its target."""
        figures = [
            Figure(
                f"{severity}: {line.name}", got.value, line.unit, line.target, line.better, got.n
            )
            for severity in self.scenes
            for score in [self.score(severity)]
            for line in quantities(severity)
            for got in [line.of(score)]
        ]
        return figures + _times(self.timed) + _real(self.frames)


def _times(timed: Sequence[Measured]) -> list[Figure]:
    if not timed:
        return []
    faces = round(median(measured.visible for measured in timed))
    return [
        Figure(f"{name}, {faces} visible faces", median(seconds), "s", target, "lower", len(timed))
        for name, seconds, target in (
            ("first look", [measured.first for measured in timed], FIRST_LOOK),
            ("later look", [measured.later for measured in timed], LATER_LOOK),
        )
    ]


def _real(frames: Mapping[str, Sequence[FrameScore]]) -> list[Figure]:
    figures = []
    for name, scores in frames.items():
        plain = next(score for score in scores if score.variant == Variant())
        found = f"{name}: found of {plain.masks}"
        least = _whole(FOUND * plain.masks)
        figures += [
            Figure(found, plain.found, "", least, "higher", 1),
            Figure(f"{name}: false detections", plain.false, "", FALSE, "lower", 1),
        ]
        if len(scores) > 1:
            worst, least = min(score.found for score in scores), _whole(STILL_FOUND * plain.masks)
            what = f"{found}, worst of {len(scores)} turns and lights"
            figures.append(Figure(what, worst, "", least, "higher", len(scores)))
    return figures


def _whole(value: float) -> float:
    """The next whole number that is not smaller."""
    return float(math.ceil(value - 1e-9))
