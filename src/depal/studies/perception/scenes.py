"""Simulated scenes that perception is measured on, none of them used to tune it."""

import math
import time
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Protocol

from depal.cell.files import shipped_cell
from depal.domain import Delivery, DeliveryLine
from depal.geometry import Vector3
from depal.logistics import shipped_deliveries
from depal.perception.calibration import Calibration, calibrate
from depal.perception.faces import Look
from depal.perception.pictures import PictureBook
from depal.perception.rasters import Region
from depal.ports import Frame
from depal.simulation.cases import Case
from depal.simulation.imaging.model import CameraModel
from depal.simulation.imaging.photographs import book_of
from depal.simulation.imaging.scene import CellScene
from depal.simulation.imaging.wear import WEAR, Wear
from depal.simulation.scenes import Kind, Scene, Severity, random_delivery, scene
from depal.simulation.scenes.scene import parked
from depal.studies.perception.score import Score, scored
from depal.studies.perception.truth import truth_of

FIRST_SEED = 2_000_000
"""Of the bench; what is trained and tuned uses seeds below a million."""

REAL = 4
"""Every so many-th scene is of a real delivery that ships; the others are of random products."""

FOREIGN = 0.18
"""So many boxes are replaced by products that no note and no picture book knows."""


class Looks(Protocol):
    """Perception that has been told what it is told."""

    def look(self, frames: Sequence[Frame]) -> Look:
        """What is found in the frames of one look, one per camera; it knows the look before."""
        ...


class Perception(Protocol):
    """Perception, as it is measured."""

    def __call__(
        self,
        region: Region,
        note: tuple[DeliveryLine, ...] | None = None,
        book: PictureBook | None = None,
        sizes: tuple[Vector3, ...] | None = None,
    ) -> Looks:
        """Makes ready for the first look; see `eye.open_eye`."""
        ...


@dataclass(frozen=True, slots=True)
class Piece:
    """A scene that is to be looked at.

    Attributes:
        severity: how hard.
        kind: what has happened to the stack.
        seed: of everything in it.
        noted: whether perception is told the note.
    """

    severity: Severity
    kind: Kind
    seed: int
    noted: bool = True


@dataclass(frozen=True, slots=True)
class Measured:
    """What a look at a scene is worth.

    Attributes:
        piece: the scene.
        visible: how many faces must be found.
        score: of the look.
        first: what the look took [s].
        later: what a look took after that, when a box had gone; NaN where there was none [s].
    """

    piece: Piece
    visible: int
    score: Score
    first: float
    later: float = math.nan


def pieces(severity: Severity, scenes: int, seed: int = 0, *, noted: bool = True) -> list[Piece]:
    """Scenes of one severity, every kind in its turn.

    Args:
        severity: of all.
        scenes: how many.
        seed: another one gives other scenes.
        noted: whether perception is told the note.
    """
    kinds = tuple(Kind)
    first = FIRST_SEED + seed * 100_000
    return [Piece(severity, kinds[k % len(kinds)], first + k, noted=noted) for k in range(scenes)]


def delivery_of(seed: int) -> Delivery:
    """The delivery of a scene: real for some, else random."""
    number, real = divmod(seed, REAL)
    if real:
        return random_delivery(seed)
    shipped = [delivery for delivery in shipped_deliveries() if delivery.stack]
    return shipped[number % len(shipped)]


def scene_of(piece: Piece, delivery: Delivery | None = None) -> Scene:
    """The pictures of a piece, and what is true of them."""
    stacked = delivery or delivery_of(piece.seed)
    return scene(stacked, shipped_cell(), piece.seed, piece.severity, piece.kind, FOREIGN)


def calibrated(made: Scene) -> tuple[Frame, ...]:
    """The frames with the pose and the depth scale that the cell's markers tell of each camera."""
    return tuple(c.applied(f) for c, f in zip(calibrations(made), made.frames, strict=True))


def calibrations(made: Scene) -> tuple[Calibration, ...]:
    """What the cell's markers tell of each camera."""
    return tuple(
        calibrate([frame], made.layout.fiducials, made.layout.fixtures) for frame in made.frames
    )


def after_a_pick(made: Scene) -> tuple[Frame, ...]:
    """What the cameras show when the box with the highest top has gone."""
    cases = tuple(
        Case(index, box.gtin, 1.0, box.shape) for index, box in enumerate(made.truth.boxes)
    )
    shapes = [case.shape for case in cases]
    tops = [float(shape.corners[:, 2].max()) for shape in shapes]
    gone = tops.index(max(tops))
    snapshot = replace(parked(made.layout, cases), removed=(gone,))
    drawn, wear = CellScene(made.layout, cases), Wear(shapes, WEAR[made.severity], made.seed)
    return tuple(
        CameraModel(drawn, mount, made.seed, made.severity, wear).frame(snapshot, 10.0, 1)
        for mount in made.layout.cameras
    )


def measure(piece: Piece, perception: Perception, delivery: Delivery | None = None) -> Measured:
    """Looks at a scene.

    Args:
        piece: which.
        perception: what is measured.
        delivery: whose stack it is; the piece's own where none is given.
    """
    stacked = delivery or delivery_of(piece.seed)
    made = scene_of(piece, stacked)
    products = [line.product for line in stacked.lines]
    truth = truth_of(made, products)
    eye = _told(made, stacked, piece, perception)
    seconds, look = _timed(eye, calibrated(made))
    visible = sum(face.counts for face in truth.faces)
    return Measured(piece, visible, scored(look, truth), seconds)


def measure_times(piece: Piece, perception: Perception, delivery: Delivery) -> Measured:
    """The same, and a later look when a box has gone."""
    first = measure(piece, perception, delivery)
    made = scene_of(piece, delivery)
    known, eye = calibrations(made), _told(made, delivery, piece, perception)
    eye.look([c.applied(frame) for c, frame in zip(known, made.frames, strict=True)])
    later = [c.applied(frame) for c, frame in zip(known, after_a_pick(made), strict=True)]
    seconds, _ = _timed(eye, later)
    return replace(first, later=seconds)


def _told(made: Scene, delivery: Delivery, piece: Piece, perception: Perception) -> Looks:
    """Perception, told what it may know of a scene."""
    book = book_of([line.product for line in delivery.lines], piece.seed, known_share=1.0)
    note = made.note.lines if piece.noted else None
    return perception(Region.above(made.layout.pallet), note, book)


def _timed(eye: Looks, frames: Sequence[Frame]) -> tuple[float, Look]:
    """A look and how long it took [s]."""
    begun = time.perf_counter()
    look = eye.look(frames)
    return time.perf_counter() - begun, look
