"""Simulated scenes that perception is measured on, none of them used to tune it."""

import time
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Protocol

from depal.cell.files import shipped_cell
from depal.domain import Delivery, DeliveryLine
from depal.geometry import Vector3
from depal.logistics import shipped_deliveries
from depal.perception.calibration import calibrate
from depal.perception.faces import Look
from depal.perception.pictures import PictureBook
from depal.perception.rasters import Region
from depal.ports import Frame
from depal.simulation.imaging.photographs import book_of
from depal.simulation.scenes import Kind, Scene, Severity, random_delivery, scene
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

    def look(self, frames: Sequence[Frame], *, anew: bool = True) -> Look:
        """What is found in the frames of one look; anew, or by what has changed since the last."""
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
    """What two looks at a scene are worth.

    Attributes:
        piece: the scene.
        visible: how many faces must be found.
        score: of the first look.
        first: what the first look took [s].
        later: what a look took that knew the first [s].
    """

    piece: Piece
    visible: int
    score: Score
    first: float
    later: float


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
    fiducials = made.layout.fiducials
    return tuple(calibrate([frame], fiducials).applied(frame) for frame in made.frames)


def measure(piece: Piece, perception: Perception, delivery: Delivery | None = None) -> Measured:
    """Looks twice at a scene.

    Args:
        piece: which.
        perception: what is measured.
        delivery: whose stack it is; the piece's own where none is given.
    """
    stacked = delivery or delivery_of(piece.seed)
    made = scene_of(piece, stacked)
    products = [line.product for line in stacked.lines]
    truth = truth_of(made, products)
    book = book_of(products, piece.seed, known_share=1.0)
    note = made.note.lines if piece.noted else None
    frames, region = calibrated(made), Region.above(made.layout.pallet)
    eye = perception(region, note, book)
    begun = time.perf_counter()
    look = eye.look(frames)
    first = time.perf_counter() - begun
    begun = time.perf_counter()
    eye.look(frames, anew=False)
    later = time.perf_counter() - begun
    visible = sum(face.counts for face in truth.faces)
    return Measured(piece, visible, scored(look, truth), first, later)
