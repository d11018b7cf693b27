"""A found face, seen finely: where exactly it is, and what its print says."""

import math
from collections.abc import Sequence
from dataclasses import replace

import numpy as np
import numpy.typing as npt

from depal.perception.faces import Errors, Face, Facing
from depal.perception.recognition import Gallery, identify
from depal.perception.recognition.identity import Identity
from depal.perception.recognition.patches import Patch
from depal.perception.recognition.rectifying import best_view, rectified
from depal.perception.refining import Belief, by_depths, by_print, by_sides, moved
from depal.perception.refining.belief import DEPTH, HEIGHT, SWING, TURN, WIDTH, U, V
from depal.ports import Frame

Floats = npt.NDArray[np.float64]

SNAP = 0.018
"""A face whose edges differ from an expected size by less has that size [m]."""

FOUND = (0.008, 0.008, 0.02)
"""How far off a face is where it was found: along its width and height, in depth [m]."""

LEVEL = math.radians(0.5)
"""Boxes stand so upright, as a standard deviation [rad]."""

TURNED = {Facing.FRONT: math.radians(2.5), Facing.TOP: math.radians(1.5)}
"""A found face's yaw is known so well [rad]."""

CUT, UNKNOWN = 0.0005, 0.01
"""Boxes are as large as their product to the first, and as they were found to the second [m]."""

RESEMBLES = 0.6
"""A print that agrees less well says nothing about where its face is."""


def located(
    face: Face,
    frames: Sequence[Frame],
    sizes: Sequence[tuple[float, float]],
    gallery: Gallery | None,
) -> Face:
    """The face where its depths, its print and its edges say that it is, named by its print.

    Args:
        face: as it was found.
        frames: of the look.
        sizes: widths and heights of the faces that may look this way [m]; none where nobody knows.
        gallery: the prints that may come; None where there are no pictures.
    """
    size = _nearest(face.size, sizes)
    face = face if size is None else replace(face, size=size)
    view = best_view(frames, face.cell_from_face)
    if view is None:
        return face
    belief = _found(face.facing, known=size is not None)
    depths = by_depths(frames[view], face.cell_from_face, face.size)
    if depths is not None:
        belief += depths[0]
        face, belief = _moved(face, belief)
    patch = rectified(frames, face.facing, face.cell_from_face, face.size)
    if patch is None:
        return face
    identity = identify(patch, gallery) if gallery is not None else None
    if identity is not None and gallery is not None:
        face = replace(face, name=identity.name)
        belief += _printed(patch, identity, gallery, belief)
    belief += by_sides(patch, belief)
    face, belief = _moved(face, belief)
    sway = np.zeros(7)
    if depths is not None:
        sway = belief.covariance @ (depths[0].information[:, DEPTH] * depths[1])
    return replace(face, errors=_errors(face.facing, belief.covariance, sway, view))


def _found(facing: Facing, *, known: bool) -> Belief:
    """What is known of a face that was found on a raster."""
    turned, size = TURNED[facing], CUT if known else UNKNOWN
    swing, turn = (turned, LEVEL) if facing is Facing.FRONT else (LEVEL / 50, turned)
    return Belief.around((*FOUND, swing, turn, size, size))


def _moved(face: Face, belief: Belief) -> tuple[Face, Belief]:
    """The face where it is believed to be, and what is believed of it there."""
    step = belief.mean
    width, height = face.size
    size = (width + float(step[WIDTH]), height + float(step[HEIGHT]))
    there = replace(face, cell_from_face=moved(face.cell_from_face, step), size=size)
    return there, belief.from_there(step)


def _printed(patch: Patch, identity: Identity, gallery: Gallery, belief: Belief) -> Belief:
    """What the print says, where it is the right one."""
    name, start = identity.name, identity.refined
    printed = next(
        each for each in gallery.prints if each.product.gtin == name.gtin and each.side == name.side
    )
    if patch.eye is None or name.score < RESEMBLES:
        return Belief(np.zeros((7, 7)), np.zeros(7))
    print_ = printed.levels[1].turned(name.quarter)
    begin = (start.du, start.dv, start.turn)
    return by_print(patch.features, print_, patch.eye, belief, begin)


def _errors(facing: Facing, covariance: Floats, sway: Floats, view: int) -> Errors:
    """Of the four numbers that place a face."""
    chosen = [U, V, DEPTH, SWING if facing is Facing.FRONT else TURN]
    block = covariance[np.ix_(chosen, chosen)]
    rows = tuple(tuple(row) for row in block.tolist())
    return Errors(rows, view, tuple(sway[chosen].tolist()))


def _nearest(
    size: tuple[float, float], sizes: Sequence[tuple[float, float]]
) -> tuple[float, float] | None:
    """The expected size that a face has; None where none is near."""
    if not sizes:
        return None
    away = np.abs(np.array(sizes) - size).max(axis=1)
    best = int(away.argmin())
    return sizes[best] if away[best] < SNAP else None
