"""Faces laid flat, straight from the frames: finer than rasters are."""

import math
from collections.abc import Sequence

import cv2
import numpy as np
import numpy.typing as npt

from depal.geometry import Pose
from depal.perception.faces import Facing
from depal.perception.recognition.patches import FINE, MARGIN, Patch, patch_shape
from depal.ports import Frame

Floats = npt.NDArray[np.float64]
Flags = npt.NDArray[np.bool_]

FLATTEST = math.cos(math.radians(72))
"""Cosine between sight and normal below which a camera sees a face too flatly."""

BEFORE = 0.06
"""What is measured so far before a face hides it [m]."""

COARSE = 6
"""What hides a face is asked for in squares of so many pixels."""


def rectified(
    frames: Sequence[Frame],
    facing: Facing,
    cell_from_face: Pose,
    size: tuple[float, float],
    step: float = FINE,
) -> Patch | None:
    """A face as the camera saw it that sees it best.

    Args:
        frames: of one look, one per camera.
        facing: which way the face looks.
        cell_from_face: its middle; x along its width, y down, z into the box.
        size: width and height [m].
        step: edge of a pixel of the patch [m].

    Returns:
        The face and a margin around it; None where no camera sees its middle.
    """
    best = best_view(frames, cell_from_face)
    if best is None:
        return None
    frame, shape = frames[best], patch_shape(size, step, MARGIN)
    camera_from_face = frame.cell_from_camera.inverse @ cell_from_face
    colour_from_patch = _homography(np.array(frame.colour_k), camera_from_face, shape, step)
    flags = cv2.INTER_LINEAR | cv2.WARP_INVERSE_MAP
    colour = cv2.warpPerspective(frame.colour, colour_from_patch, shape, flags=flags)
    known = _inside(colour_from_patch, shape, frame.colour.shape)
    known &= ~_hidden(frame, camera_from_face, shape, step)
    eye = camera_from_face.inverse.translation
    return Patch(facing, size, np.asarray(colour, dtype=np.uint8), known, step, eye=eye)


def best_view(frames: Sequence[Frame], cell_from_face: Pose) -> int | None:
    """The frame that shows a face most finely, by its index; None where none shows its middle."""
    fineness = [_fineness(frame, cell_from_face) for frame in frames]
    best = max(range(len(frames)), key=fineness.__getitem__, default=None)
    return None if best is None or fineness[best] <= 0.0 else best


def _fineness(frame: Frame, cell_from_face: Pose) -> float:
    """Pixels per metre of a face's shorter way; 0 where its middle is not in the picture."""
    camera_from_face = frame.cell_from_camera.inverse @ cell_from_face
    middle = np.array(camera_from_face.translation)
    inward = np.array(camera_from_face.rotation)[:, 2]
    cosine = float(inward @ middle / np.linalg.norm(middle))
    if middle[2] <= 0.0 or cosine < FLATTEST:
        return 0.0
    x, y, _ = (np.array(frame.colour_k) @ (middle / middle[2])).tolist()
    height, width = frame.colour.shape[:2]
    inside = 0 <= x < width and 0 <= y < height
    return frame.colour_k[0][0] / float(middle[2]) * cosine if inside else 0.0


def _homography(k: Floats, camera_from_face: Pose, shape: tuple[int, int], step: float) -> Floats:
    """From a patch's pixels to a picture's, as (3, 3)."""
    turn, shift = np.array(camera_from_face.rotation), np.array(camera_from_face.translation)
    x0, y0 = (shape[0] - 1) / 2 * step, (shape[1] - 1) / 2 * step
    face_from_patch = np.array([[step, 0.0, -x0], [0.0, step, -y0], [0.0, 0.0, 1.0]])
    return np.asarray(k @ np.column_stack((turn[:, :2], shift)) @ face_from_patch)


def _inside(warp: Floats, shape: tuple[int, int], picture: tuple[int, ...]) -> Flags:
    """(h, w) which pixels of a patch lie within the picture."""
    width, height = shape
    corners = np.array([[0, 0, 1], [width, 0, 1], [width, height, 1], [0, height, 1]]) @ warp.T
    points = corners[:, :2] / corners[:, 2:]
    if (points >= 0).all() and (points < (picture[1], picture[0])).all():
        return np.ones((height, width), dtype=np.bool_)
    whole = np.full(picture[:2], 255, dtype=np.uint8)
    flags = cv2.INTER_NEAREST | cv2.WARP_INVERSE_MAP
    return np.asarray(cv2.warpPerspective(whole, warp, shape, flags=flags)) > 0


def _hidden(frame: Frame, camera_from_face: Pose, shape: tuple[int, int], step: float) -> Flags:
    """(h, w) before which pixels of a patch something was measured."""
    width, height = (math.ceil(edge / COARSE) for edge in shape)
    warp = _homography(np.array(frame.depth_k), camera_from_face, shape, step)
    rows, columns = np.mgrid[0:height, 0:width] * COARSE + (COARSE - 1) / 2
    x, y, z = np.tensordot(warp, np.stack((columns, rows, np.ones_like(rows))), axes=1)
    u = np.clip(np.round(x / z), 0, frame.depth.shape[1] - 1).astype(np.intp)
    v = np.clip(np.round(y / z), 0, frame.depth.shape[0] - 1).astype(np.intp)
    measured = frame.depth[v, u]
    hidden = ((measured > 0.0) & (measured < z - BEFORE)).astype(np.uint8)
    # Single places are errors of the depth.
    hidden = np.asarray(cv2.medianBlur(hidden, 3))
    large = cv2.resize(hidden, (width * COARSE, height * COARSE), interpolation=cv2.INTER_NEAREST)
    return np.asarray(large)[: shape[1], : shape[0]] > 0
