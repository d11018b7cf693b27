"""Where a face's plane lies by the depths that a camera measured on it."""

import numpy as np
import numpy.typing as npt

from depal.geometry import Pose
from depal.perception.refining.belief import DEPTH, STATES, SWING, Belief
from depal.ports import Frame

Floats = npt.NDArray[np.float64]

GRID = 24
"""Depths are looked up in so many places along the face's width and height."""

RIM = 0.011
"""Nearer to a face's edge than this share of the distance, stereo sees its neighbour too."""

INSIDE = 0.5
"""At least this share of the width and the height counts, however small the face is."""

ERRORS = 0.0024
"""A depth is off by this times its square, as a standard deviation [1/m]: stereo, over 50 mm."""

ALIKE = 0.021
"""Depths within this share of the distance are wrong alike."""

OTHER = 0.04
"""Depths that are off by more are of something else [m]."""

BULGE = 0.001
"""Faces stand out by so much on the average [m], and by as much more or less."""

FEW = 0.25
"""At least this share of the places must tell a depth of the face."""


def by_depths(
    frame: Frame, cell_from_face: Pose, size: tuple[float, float]
) -> tuple[Belief, float] | None:
    """What the depths say about where a face is.

    Args:
        frame: that sees it.
        cell_from_face: where it is thought to be.
        size: width and height [m].

    Returns:
        The belief about its depth and its swing, and the distance from the camera to the face's
        plane [m]; None where there are too few depths.
    """
    camera_from_face = frame.cell_from_camera.inverse @ cell_from_face
    turn, shift = np.array(camera_from_face.rotation), np.array(camera_from_face.translation)
    away = float(turn[:, 2] @ shift)
    rim = RIM * float(np.linalg.norm(shift))
    half = [max(edge / 2 - rim, INSIDE * edge / 2) for edge in size]
    x, y = (axis.ravel() for axis in np.meshgrid(*(_steps(each) for each in half)))
    off = _off(frame, turn, shift, x, y) * away
    near = np.abs(off - _middle(off)) < OTHER
    if away <= 0.0 or near.sum() < FEW * len(x):
        return None
    x, off = x[near], off[near]
    sigma = ERRORS * float(np.linalg.norm(shift)) ** 2
    rows = np.zeros((len(x), STATES))
    rows[:, DEPTH], rows[:, SWING] = 1.0, -x
    belief = _fitted(rows, off, sigma)
    area = 4.0 * half[0] * half[1] * near.mean()
    alone = (ALIKE * float(np.linalg.norm(shift))) ** 2
    share = max(area / alone, 1.0) / len(x)
    information = belief.information * share
    information[DEPTH, DEPTH] = 1.0 / (1.0 / information[DEPTH, DEPTH] + BULGE**2)
    mean = np.linalg.lstsq(belief.information, belief.pull, rcond=None)[0]
    mean[DEPTH] += BULGE
    return Belief(information, information @ mean), away


def _steps(half: float) -> Floats:
    return np.asarray(np.linspace(-half, half, GRID))


def _off(frame: Frame, turn: Floats, shift: Floats, x: Floats, y: Floats) -> Floats:
    """(n,) by which share depths are farther than the plane; nan where there is none."""
    points = np.outer(x, turn[:, 0]) + np.outer(y, turn[:, 1]) + shift
    z = np.maximum(points[:, 2], 1e-6)
    k = frame.depth_k
    column = np.rint(points[:, 0] / z * k[0][0] + k[0][2]).astype(np.intp)
    row = np.rint(points[:, 1] / z * k[1][1] + k[1][2]).astype(np.intp)
    high, wide = frame.depth.shape
    inside = (column >= 0) & (column < wide) & (row >= 0) & (row < high)
    row, column = np.clip(row, 0, high - 1), np.clip(column, 0, wide - 1)
    measured = frame.depth[row, column].astype(np.float64)
    known = inside & (measured > 0.0)
    # The places of pixels, not of points, are what was measured: take the ray through them.
    ray = np.stack(
        ((column - k[0][2]) / k[0][0], (row - k[1][2]) / k[1][1], np.ones(len(x))), axis=1
    )
    expected = float(turn[:, 2] @ shift) / (ray @ turn[:, 2])
    return np.asarray(np.where(known, measured / expected - 1.0, np.nan))


def _middle(off: Floats) -> float:
    known = off[np.isfinite(off)]
    return float(np.median(known)) if known.size else float("nan")


def _fitted(rows: Floats, off: Floats, sigma: float) -> Belief:
    """Least squares in which what is far off counts less."""
    weight = np.ones(len(off))
    columns = [DEPTH, SWING]
    for _ in range(3):
        part = rows[:, columns]
        best = np.linalg.lstsq(part * weight[:, None], off * weight, rcond=None)[0]
        left = np.abs(off - part @ best) / sigma
        weight = np.sqrt(np.minimum(1.5 / np.maximum(left, 1e-9), 1.0))
    scaled = rows * (weight**2)[:, None] / sigma**2
    return Belief(scaled.T @ rows, scaled.T @ off)
