"""Real frames with masks: what is found in them, and how little a turn or the light changes it."""

import itertools
import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Self, TypeVar

import cv2
import numpy as np
import numpy.typing as npt

from depal.geometry import Matrix3, Pose
from depal.perception.faces import Face
from depal.perception.frames import RecordedFrame
from depal.perception.ground import levelled, region_in
from depal.ports import Frame
from depal.studies.perception.boxes import all_faces
from depal.studies.perception.matching import matched
from depal.studies.perception.scenes import Perception
from depal.studies.perception.truth import corners_of

Floats = npt.NDArray[np.float64]
Value = TypeVar("Value", np.uint8, np.float32)

TURNS = (0.0, -8.0, -4.0, 4.0, 8.0)
"""About the picture's middle [degree]."""

LIGHTS = (1.0, 0.7, 1.3)
"""Brightness by which the picture is multiplied."""

_FINE = 4
"""Corners of polygons are drawn in steps of 1 / 2^4 pixel."""


@dataclass(frozen=True, slots=True)
class Variant:
    """A way in which a frame is changed.

    Attributes:
        turn: about its middle [degree].
        light: by which it is multiplied.
    """

    turn: float = 0.0
    light: float = 1.0


@dataclass(frozen=True, slots=True)
class FrameScore:
    """What was found in a frame.

    Attributes:
        variant: how it was changed.
        masks: how many faces are marked.
        found: of these.
        false: detections of something else.
    """

    variant: Variant
    masks: int
    found: int
    false: int


def variants() -> list[Variant]:
    """As it is, then every turn under every light."""
    return [Variant(turn, light) for turn, light in itertools.product(TURNS, LIGHTS)]


def score_frame(recorded: RecordedFrame, variant: Variant, perception: Perception) -> FrameScore:
    """Looks at a frame that was changed, without a note.

    Args:
        recorded: with masks, and maybe with sizes.
        variant: how it is changed.
        perception: what is measured.
    """
    changed = varied(recorded, variant)
    frame = changed.as_frame()
    if changed.cell_from_camera is None:
        frame = levelled(frame)
    look = perception(region_in([frame]), sizes=changed.sizes).look([frame])
    outlines = [outline(face, frame) for face in all_faces(look)]
    return judged(outlines, changed.masks, variant)


def judged(
    outlines: Sequence[Floats], masks: Sequence[npt.NDArray[np.bool_]], variant: Variant
) -> FrameScore:
    """Compares outlines (4, 2) [pixel] with the masks of what is there."""
    agreed = np.array([[_agreement(one, mask) for mask in masks] for one in outlines], dtype=float)
    matching = matched(agreed.reshape(len(outlines), len(masks)), [True] * len(masks))
    return FrameScore(variant, len(masks), len(matching.pairs), len(matching.wrong))


def outline(face: Face, frame: Frame) -> Floats:
    """The corners of a face in the colour picture, (4, 2) [pixel]."""
    camera_from_cell = frame.cell_from_camera.inverse
    corners = corners_of(face.cell_from_face, face.size)
    local = corners @ np.array(camera_from_cell.rotation).T + camera_from_cell.translation
    pixels = local @ np.array(frame.colour_k).T
    return np.asarray(pixels[:, :2] / np.maximum(pixels[:, 2:], 1e-6))


def varied(recorded: RecordedFrame, variant: Variant) -> RecordedFrame:
    """A frame turned about its middle and under another light; nothing of it is cut off."""
    turned = _turned(recorded, math.radians(variant.turn)) if variant.turn else recorded
    if variant.light == 1.0:
        return turned
    bright = np.clip(np.round(turned.colour * variant.light), 0, 255).astype(np.uint8)
    return replace(turned, colour=bright)


def _turned(recorded: RecordedFrame, angle: float) -> RecordedFrame:
    """Clockwise as seen; the camera turns the other way about its axis.

    A camera matrix of square pixels moves its centre with the picture.
    """
    c, s = math.cos(angle), math.sin(angle)
    turn = np.array([[c, -s], [s, c]])
    over_colour = _Warp.of(recorded.colour.shape, recorded.colour_k, turn)
    over_depth = _Warp.of(recorded.depth.shape, recorded.depth_k, turn)
    masks = tuple(
        over_colour.of_picture(mask.astype(np.uint8), cv2.INTER_NEAREST) > 0
        for mask in recorded.masks
    )
    about = Pose(rotation=((c, s, 0.0), (-s, c, 0.0), (0.0, 0.0, 1.0)))  # camera_from_turned
    pose = recorded.cell_from_camera
    return replace(
        recorded,
        colour=over_colour.of_picture(recorded.colour, cv2.INTER_LINEAR),
        depth=over_depth.of_picture(recorded.depth, cv2.INTER_NEAREST),
        colour_k=over_colour.k,
        depth_k=over_depth.k,
        cell_from_camera=None if pose is None else pose @ about,
        masks=masks,
    )


@dataclass(frozen=True, slots=True, eq=False)
class _Warp:
    """A turn of pictures of one size about their middle, into room for all of them.

    Attributes:
        matrix: (2, 3) from old to new pixels.
        room: width and height of the new picture.
        k: its intrinsics.
    """

    matrix: Floats
    room: tuple[int, int]
    k: Matrix3

    @classmethod
    def of(cls, shape: tuple[int, ...], k: Matrix3, turn: Floats) -> Self:
        """For pictures of a shape, (h, w, ...)."""
        size = np.array((shape[1], shape[0]))
        wide, high = np.ceil(np.abs(turn) @ size - 1e-9).astype(int).tolist()
        before, after = (size - 1) / 2, np.array((wide - 1, high - 1)) / 2
        (fx, _, cx), (_, fy, cy), _ = k
        x, y = (turn @ (np.array((cx, cy)) - before) + after).tolist()
        matrix = np.column_stack((turn, after - turn @ before))
        return cls(matrix, (wide, high), ((fx, 0.0, x), (0.0, fy, y), (0.0, 0.0, 1.0)))

    def of_picture(self, picture: npt.NDArray[Value], how: int) -> npt.NDArray[Value]:
        """A picture turned; black, or not measured, where there was nothing."""
        turned = cv2.warpAffine(picture, self.matrix, self.room, flags=how)
        return np.asarray(turned, dtype=picture.dtype)


def _agreement(corners: Floats, mask: npt.NDArray[np.bool_]) -> float:
    """Intersection over union of a polygon and a mask, counted in pixels."""
    drawn = np.zeros(mask.shape, dtype=np.uint8)
    fine = np.round(np.clip(corners, -1e4, 1e4) * 2**_FINE).astype(np.int32)
    cv2.fillConvexPoly(drawn, fine, 1, shift=_FINE)
    inside = drawn > 0
    union = int((inside | mask).sum())
    return int((inside & mask).sum()) / union if union else 0.0
