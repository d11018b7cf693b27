"""Rectangles of simulated scenes, and whether each is a face."""

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, replace
from enum import Enum

import cv2
import numpy as np
import numpy.typing as npt

from depal.domain import CellLayout, Delivery
from depal.geometry import Vector3
from depal.perception.calibration import calibrate
from depal.perception.detecting import Expected, Finder
from depal.perception.detecting.finding import DIRECTIONS, Printed, candidates_of
from depal.perception.faces import Facing, Raster
from depal.perception.proposals.candidates import Candidates, best
from depal.perception.rasters import Region, rasters_of
from depal.perception.scoring import described
from depal.perception.seams import directions_of, seams_of
from depal.ports import Frame
from depal.simulation.scenes import Kind, Scene, Severity, TrueFace, scene
from depal.studies.perception.polygons import agreement

Floats = npt.NDArray[np.float64]
Flags = npt.NDArray[np.bool_]
Prints = Callable[[Raster, Scene, np.random.Generator], Sequence[Printed]]

RIGHT, WRONG = 0.85, 0.72
"""A rectangle is a face where it covers one so well (intersection over union), and none where it
covers none even so well; what lies between teaches nothing."""

NEAR = 0.4
"""Of a face whose middle is farther off than this share of a rectangle's shorter side, the
rectangle covers too little."""

BEHIND = 0.06
"""A face that lies so far behind a rectangle, or before it, is another one [m]."""

SEEN = 0.5
"""Of a face that teaches so much is visible."""

CLEAN = 0.6
"""Share of the coarse cameras that smooth their pictures."""

HARD, COARSE, FOREIGN = 0.3, 0.4, 0.15
"""Shares of the scenes that are hard, and that a camera with half the pixels takes; share of the
boxes that nobody knows."""

BLIND = 0.3
"""Share of scenes in which no prints are looked for."""

BY_SCORE, BY_SIDES, BY_LOT = 500, 500, 500
"""So many rectangles of a raster are learned from: the likeliest so far, those with the strongest
sides, and any."""


class Told(Enum):
    """What the detector is told of sizes."""

    EXACT = "exact"
    ROUGH = "rough"
    NOTHING = "nothing"


@dataclass(frozen=True, slots=True, eq=False)
class Examples:
    """What is learned from.

    Attributes:
        features: (n, d).
        faces: (n,) 1 where it is a face.
        tops: (n,) whether it looks up.
    """

    features: Floats
    faces: Floats
    tops: Flags

    @property
    def looking_up(self) -> "Examples":
        """Those of tops alone."""
        up = self.tops
        return Examples(self.features[up], self.faces[up], self.tops[up])

    @classmethod
    def joined(cls, parts: Iterable["Examples"]) -> "Examples":
        """Several together."""
        every = list(parts)
        return cls(
            np.concatenate([each.features for each in every]),
            np.concatenate([each.faces for each in every]),
            np.concatenate([each.tops for each in every]),
        )


def examples_of(
    delivery: Delivery,
    layout: CellLayout,
    seed: int,
    finder: Finder | None,
    prints: Prints | None,
) -> Examples:
    """The rectangles of one scene, drawn by its seed.

    Args:
        delivery: what stands there.
        layout: the cell.
        seed: of the scene and of what is told of it.
        finder: as trained so far; None at first.
        prints: where prints are seen.
    """
    random = np.random.default_rng([seed, 77])
    severity = Severity.HARD if random.random() < HARD else Severity.NORMAL
    kind = tuple(Kind)[int(random.integers(len(Kind)))]
    made = scene(delivery, layout, seed, severity, kind, foreign=FOREIGN)
    frames = [
        calibrate([frame], layout.fiducials, layout.fixtures).applied(frame)
        for frame in made.frames
    ]
    coarse = random.random() < COARSE
    if coarse:
        frames = [coarser(frame, random) for frame in frames]
    told = random.choice([*Told], p=[0.6, 0.25, 0.15])
    expected = told_sizes(made.note, Told(told), random)
    parts = []
    for raster in rasters_of(frames, Region.above(layout.pallet)):
        shown = (
            None
            if prints is None or coarse or random.random() < BLIND
            else prints(raster, made, random)
        )
        faces = [getattr(box, raster.facing.value) for box in made.truth.boxes]
        parts.append(_of_raster(raster, expected, shown, faces, finder, random))
    return Examples.joined(parts)


def told_sizes(note: Delivery, told: Told, random: np.random.Generator) -> Expected:
    """Sizes of boxes as somebody may have noted them down."""
    sizes = [line.product.size for line in note.lines]
    if told is Told.NOTHING or not sizes:
        return Expected()
    if told is Told.ROUGH:
        factor = random.uniform(0.93, 1.02)
        sizes = [_rough(size, factor, random) for size in sizes]
    return Expected(tuple(sorted(set(sizes))))


def _rough(size: Vector3, factor: float, random: np.random.Generator) -> Vector3:
    length, width, height = (
        edge * factor + float(error)
        for edge, error in zip(size, random.normal(0.0, 0.004, 3), strict=True)
    )
    return (length, width, height)


def coarser(frame: Frame, random: np.random.Generator) -> Frame:
    """A frame as a camera with half the pixels and paler colours takes it.

    Some such cameras smooth away what is faint, noise and small print alike.
    """
    height, width = frame.colour.shape[:2]
    small = cv2.resize(frame.colour, (width // 2, height // 2), interpolation=cv2.INTER_AREA)
    mean = small.mean(axis=(0, 1))
    pale = mean + (small - mean) * random.uniform(0.5, 1.0)
    pale = np.clip(pale + random.normal(0.0, 2.0, pale.shape), 0, 255).astype(np.uint8)
    if random.random() < CLEAN:
        pale = np.asarray(cv2.bilateralFilter(pale, 7, 18.0, 3.0), dtype=np.uint8)
    k = np.array(frame.colour_k)
    k[:2] /= 2
    k[:2, 2] -= 0.25
    rows = tuple((row[0], row[1], row[2]) for row in k.tolist())
    return replace(frame, colour=pale, colour_k=(rows[0], rows[1], rows[2]))


def _of_raster(
    raster: Raster,
    expected: Expected,
    prints: Sequence[Printed] | None,
    faces: Sequence[TrueFace],
    finder: Finder | None,
    random: np.random.Generator,
) -> Examples:
    seams = [seams_of(raster, turn) for turn in directions_of(raster, DIRECTIONS[raster.facing])]
    sizes = expected.faces(raster.facing)
    candidates, agreed = candidates_of(seams, sizes, prints)
    shares = agreed.max(axis=1) if agreed.shape[1] else np.full(len(candidates), -1.0)
    shares = np.where(shares < 0.0, 0.0 if prints is not None else -1.0, shares)
    features = described(candidates.measured, candidates.sizes, sizes, shares)
    measured = candidates.measured
    sides = measured[:, :4].mean(axis=1) + measured[:, :4].min(axis=1)
    chosen = [best(candidates, sides + measured[:, 4:8].min(axis=1), BY_SIDES)]
    chosen.append(random.permutation(len(candidates))[:BY_LOT])
    if finder is not None:
        chosen.append(best(candidates, finder.score_of(raster.facing).log_odds(features), BY_SCORE))
    rows = np.unique(np.concatenate(chosen))
    covered, seen = coverage(raster, candidates[rows], faces)
    right = (covered > RIGHT) & (seen > SEEN)
    use = right | (covered < WRONG)
    tops = np.full(int(use.sum()), raster.facing is Facing.TOP)
    return Examples(features[rows[use]], right[use].astype(float), tops)


def coverage(
    raster: Raster, candidates: Candidates, faces: Sequence[TrueFace]
) -> tuple[Floats, Floats]:
    """How well each rectangle covers a true face, and how much of that is visible.

    Returns:
        (n,) greatest intersection over union, and (n,) the visible share of that face.
    """
    raster_from_cell = raster.cell_from_raster.inverse
    turn, shift = np.array(raster_from_cell.rotation), np.array(raster_from_cell.translation)
    places = [face.corners @ turn.T + shift for face in faces]
    outlines = [place[:, :2] for place in places]
    depths = np.array([place[:, 2].mean() for place in places])
    middles = np.array([outline.mean(axis=0) for outline in outlines]).reshape(-1, 2)
    covered, seen = np.zeros(len(candidates)), np.zeros(len(candidates))
    for row, rectangle in enumerate(candidates.rectangles):
        reach = NEAR * min(rectangle.width, rectangle.height)
        away = np.abs(middles - (rectangle.u, rectangle.v)).max(axis=1, initial=0.0)
        near = (away < reach) & (np.abs(depths - rectangle.depth) < BEHIND)
        for index in np.flatnonzero(near).tolist():
            share = agreement(rectangle.corners, outlines[index])
            if share > covered[row]:
                covered[row], seen[row] = share, faces[index].visible
    return covered, seen
