"""What makes two boxes of one product look different: print, tape, scuffs, film, bulging."""

from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from depal.geometry import OrientedBox, Pose, Vector3
from depal.simulation.imaging.mesh import SIDES, face_pose, face_size
from depal.simulation.imaging.severity import Severity
from depal.simulation.imaging.smooth_noise import smooth_noise

Floats = npt.NDArray[np.float64]
Bytes = npt.NDArray[np.uint8]

MARKS = 32
"""Columns of a face's marks: gain 0-2 and offset 3-5 of the print; tape 6 along its height, 7
middle, 8 half width, 9 from, 10 to [m], 11 opacity, 12-14 colour; scuffs 15-26, each middle,
radius [m] and lightness; 27 film; 28 bulge [m]; 29 how dark the edges are against the print's."""

GAIN, OFFSET, TAPE, SCUFFS, FILM, BULGE, CREASE = 0, 3, 6, 15, 27, 28, 29

SCUFF_COUNT = 3
"""At the most so many scuffs on a face."""

TILE = 512
"""The film's pattern has so many texels along each side, and repeats."""

FILM_STEP = 0.004
"""Edge of a texel of the film's pattern [m]."""

TAPE_WIDTH, OVER_THE_EDGE = 0.05, 0.07
"""Of a strip of tape, and how far one that closes the lid reaches down a side [m]."""

TAPES = ((206, 184, 140), (168, 128, 84), (236, 234, 226), (186, 170, 148))
"""Colours of tape."""


@dataclass(frozen=True, slots=True)
class WearSettings:
    """How different boxes look.

    Attributes:
        shift: of the print on its face, standard deviation along both edges [m].
        tint: of the gain of each colour, standard deviation.
        light: of the gain of all colours, standard deviation.
        contrast: of the contrast, standard deviation.
        taped: share of the faces with tape across.
        scuffs: how many a face has on average.
        bulge: how far the middle of a face stands out at the most [m].
        wrapped: how probable film around a group of boxes is.
        glare: how white the film shines at the most.
        crease: how dark edges are, at least and at most; 1 as they are printed.
    """

    shift: float = 0.0
    tint: float = 0.0
    light: float = 0.0
    contrast: float = 0.0
    taped: float = 0.0
    scuffs: float = 0.0
    bulge: float = 0.0
    wrapped: float = 0.0
    glare: float = 0.0
    crease: tuple[float, float] = (1.0, 1.0)


WEAR: Mapping[Severity, WearSettings] = MappingProxyType(
    {
        Severity.EASY: WearSettings(),
        Severity.NORMAL: WearSettings(
            shift=0.0012,
            tint=0.012,
            light=0.04,
            contrast=0.06,
            taped=0.12,
            scuffs=0.5,
            bulge=0.004,
            wrapped=0.5,
            glare=0.7,
            crease=(0.1, 1.3),
        ),
        Severity.HARD: WearSettings(
            shift=0.002,
            tint=0.025,
            light=0.07,
            contrast=0.1,
            taped=0.25,
            scuffs=1.2,
            bulge=0.008,
            wrapped=0.8,
            glare=0.9,
            crease=(0.0, 1.3),
        ),
    }
)


class Worn(NamedTuple):
    """Wear as the kernels take it; face `6 i + side` is a side of box i.

    Attributes:
        frames: (6 n, 18) in the camera's frame: place along the width and along the height of a
            face, and across and along the film, each a gradient and an offset [m]; width, height.
        marks: (6 n, MARKS).
        film: (TILE, TILE) how strongly the film shines.
    """

    frames: Floats
    marks: Floats
    film: Bytes


class Wear:
    """The wear of the boxes of one run.

    Attributes:
        shifts: (6 n, 2) of the prints, in widths and heights of the face.
    """

    def __init__(self, shapes: list[OrientedBox], settings: WearSettings, seed: int) -> None:
        """Draws it; a box's wear depends on the seed and its number alone.

        Args:
            shapes: where the boxes stand when the run begins.
            settings: how much.
            seed: of the run.
        """
        self._sizes = [shape.size for shape in shapes]
        count = len(shapes) * len(SIDES)
        self._marks, self.shifts = np.zeros((count, MARKS)), np.zeros((count, 2))
        for box, shape in enumerate(shapes):
            random = np.random.default_rng([seed, 13, box])
            for side in range(len(SIDES)):
                row = box * len(SIDES) + side
                self._marks[row], self.shifts[row] = _marks(random, shape.size, side, settings)
            rows = slice(box * len(SIDES), (box + 1) * len(SIDES))
            self._marks[rows, :TAPE] = _print(random, settings)
        self._film = _film(np.random.default_rng([seed, 15]))
        self._wrap(shapes, settings, np.random.default_rng([seed, 16]))
        self._local = [_local(size) for size in self._sizes]

    def _wrap(
        self, shapes: list[OrientedBox], settings: WearSettings, random: np.random.Generator
    ) -> None:
        """Film around the boxes near one of them."""
        drawn, radius, strength = random.random(), random.uniform(0.3, 0.6), random.uniform(0.6, 1)
        if drawn >= settings.wrapped or not shapes:
            return
        centres = np.array([shape.centre for shape in shapes])
        middle = centres[int(random.integers(len(shapes)))]
        near = np.linalg.norm(centres - middle, axis=1) < radius
        self._marks[np.repeat(near, len(SIDES)), FILM] = strength * settings.glare

    def seen_from(self, camera_from_boxes: list[Pose], cell_from_camera: Pose) -> Worn:
        """The wear where the boxes are.

        Args:
            camera_from_boxes: the pose of each.
            cell_from_camera: the camera's.
        """
        turns = np.array([pose.rotation for pose in camera_from_boxes]).reshape(-1, 1, 3, 3)
        shifts = np.array([pose.translation for pose in camera_from_boxes]).reshape(-1, 1, 3)
        local = np.array(self._local).reshape(-1, len(SIDES), 3, 5)
        right, down, middle = local[..., 0], local[..., 1], local[..., 2]
        frames = np.zeros((len(self._sizes), len(SIDES), 18))
        centre = np.einsum("nkij,nsj->nsi", turns, middle) + shifts
        for start, axis, size in ((0, right, local[..., 0, 3]), (4, down, local[..., 1, 3])):
            way = np.einsum("nkij,nsj->nsi", turns, axis)
            frames[..., start : start + 3] = way
            frames[..., start + 3] = size / 2 - (way * centre).sum(axis=2)
        turn, (x, y, z) = np.array(cell_from_camera.rotation), cell_from_camera.translation
        frames[..., 8:11], frames[..., 11] = turn[0] + turn[1], x + y
        frames[..., 12:15], frames[..., 15] = turn[2] + turn[0], z + x
        frames[..., 16], frames[..., 17] = local[..., 0, 3], local[..., 1, 3]
        return Worn(frames.reshape(-1, 18), self._marks, self._film)


def _local(size: Vector3) -> Floats:
    """Of each side: right, down, middle, (width, height, 0) in the box's own frame: (6, 3, 5)."""
    rows = np.zeros((len(SIDES), 3, 5))
    for side in range(len(SIDES)):
        pose = face_pose(size, side)
        rows[side, :, :2] = np.array(pose.rotation)[:, :2]
        rows[side, :, 2] = pose.translation
        rows[side, :2, 3] = face_size(size, side)
    return rows


def _print(random: np.random.Generator, settings: WearSettings) -> Floats:
    """Gains and offsets of a box's colours, (6,)."""
    tints = random.normal(1.0, settings.tint, 3) * random.normal(1.0, settings.light)
    tints = np.clip(tints, 0.8, 1.2)
    contrast = float(np.clip(random.normal(1.0, settings.contrast), 0.75, 1.2))
    return np.concatenate((tints * contrast, np.full(3, 140.0 * (1.0 - contrast))))


def _marks(
    random: np.random.Generator, size: Vector3, side: int, settings: WearSettings
) -> tuple[Floats, Floats]:
    """What is on one face, (MARKS,), and the shift of its print, (2,)."""
    marks = np.zeros(MARKS)
    width, height = face_size(size, side)
    marks[TAPE : TAPE + 9] = _tape(random, (width, height), side, settings.taped)
    many = min(int(random.poisson(settings.scuffs)), SCUFF_COUNT)
    drawn = random.random((SCUFF_COUNT, 4))
    for n in range(many):
        s, t, r, light = drawn[n].tolist()
        shine = (0.25 + 0.45 * light) * (1.0 if light > 0.4 else -1.0)  # noqa: PLR2004 - three of five
        at = SCUFFS + 4 * n
        marks[at : at + 4] = (s * width, t * height, 0.004 + 0.012 * r, shine)
    marks[BULGE] = settings.bulge * float(random.random()) * min(1.0, width * height / 0.06)
    marks[CREASE] = random.uniform(*settings.crease)
    shift = np.clip(random.normal(0.0, settings.shift, 2), -0.003, 0.003)
    return marks, shift / (width, height)


def _tape(
    random: np.random.Generator, face: tuple[float, float], side: int, share: float
) -> Floats:
    """A strip of tape, (9,): over the lid's edge, or across the whole face."""
    width, height = face
    where, upright, opacity = random.random(), random.random() < 0.5, random.uniform(0.35, 0.8)  # noqa: PLR2004
    colour = TAPES[int(random.integers(len(TAPES)))]
    middle, drawn = random.uniform(0.2, 0.8), random.random()
    if drawn >= share * (3 if side < 2 else 1):  # noqa: PLR2004 - ends are closed by tape more often
        return np.zeros(9)
    half = TAPE_WIDTH / 2
    if side < 2 and where < 0.7:  # noqa: PLR2004
        return np.array([1, width / 2, half, 0.0, OVER_THE_EDGE, opacity, *colour])
    if upright:
        return np.array([1, middle * width, half, 0.0, height, opacity, *colour])
    return np.array([0, middle * height, half, 0.0, width, opacity, *colour])


def _film(random: np.random.Generator) -> Bytes:
    """How strongly film shines at every place: streaks along its folds, here and there."""
    upright = smooth_noise((TILE, TILE), (40.0, 2.5), random)
    slanted = smooth_noise((TILE, TILE), (4.0, 30.0), random)
    here = smooth_noise((TILE, TILE), (35.0, 35.0), random)
    streaks = np.maximum(np.clip((upright - 0.9) / 1.4, 0, 1), np.clip((slanted - 1.2) / 1.4, 0, 1))
    shine = 0.06 + 0.94 * streaks * (1 / (1 + np.exp(-2.0 * here)))
    return np.asarray(np.clip(shine * 255, 0, 255), dtype=np.uint8)
