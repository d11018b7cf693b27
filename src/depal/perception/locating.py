"""A found face, seen finely: where exactly it is, and what its print says."""

import math
from collections.abc import Sequence
from dataclasses import replace

import numpy as np
import numpy.typing as npt

from depal.perception.faces import Errors, Face, Facing, Name
from depal.perception.recognition import Gallery, identify
from depal.perception.recognition.identity import SIZES, Identity
from depal.perception.recognition.patches import Patch
from depal.perception.recognition.prints import Print
from depal.perception.recognition.rectifying import best_view, rectified
from depal.perception.refining import Belief, Sides, by_depths, by_print, moved
from depal.perception.refining.belief import DEPTH, HEIGHT, SWING, TURN, WIDTH, U, V
from depal.ports import Frame

Floats = npt.NDArray[np.float64]

SNAP = 0.022
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


STILL = (0.0015, 0.0015, np.inf, np.inf, math.radians(0.3), np.inf, np.inf)
"""A face whose edges move it by less is not laid flat anew [m, rad]."""

READ = (0.003, 0.003, 0.006, math.radians(0.1), math.radians(0.5), np.inf, np.inf)
"""A face that its print and edges move by less is not read again [m, rad]."""

RIGHT = 0.93
"""A print that agrees better is of the right product, or of one that is as large."""

ASKEW = math.radians(2.0)
"""A print that agrees less may be turned by so much against where it was found [rad]."""


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
    view = best_view(frames, face.cell_from_face)
    if view is None:
        return face
    near = [each for each in sizes if _apart(each, face.size) < SNAP]
    near += _size_of(face.name, gallery)
    belief = _found(face.facing, known=bool(near))
    depths = by_depths(frames[view], face.cell_from_face, face.size)
    if depths is not None:
        belief += depths[0]
        face, belief = _moved(face, belief)
    patch = rectified(frames, face.facing, face.cell_from_face, face.size)
    if patch is None:
        return face
    sides, first = Sides.of(patch), patch
    face, belief, patch = _rough(face, belief, patch, sides, frames, near)
    identity = identify(patch, gallery) if gallery is not None else None
    if identity is not None and gallery is not None:
        face = replace(face, name=identity.name)
        if identity.name.score > RESEMBLES:
            before = face.size
            face, belief, patch = _by_print(face, belief, patch, frames, identity, gallery)
            if _apart(before, face.size) > SIZES:
                again = identify(patch, gallery)
                face = face if again is None else replace(face, name=again.name)
    belief += (sides if patch is first else Sides.of(patch)).told(belief)
    turned = bool((np.abs(belief.mean) > READ).any())
    face, belief = _moved(face, belief)
    if gallery is not None and turned:
        face = _read_again(face, frames, gallery)
    sway = np.zeros(7)
    if depths is not None:
        sway = belief.covariance @ (depths[0].information[:, DEPTH] * depths[1])
    return replace(face, errors=_errors(face.facing, belief.covariance, sway, view))


def _rough(
    face: Face,
    belief: Belief,
    patch: Patch,
    sides: Sides,
    frames: Sequence[Frame],
    sizes: Sequence[tuple[float, float]],
) -> tuple[Face, Belief, Patch]:
    """The face where its edges say that it is, as large as they say; so its print is found."""
    more = np.zeros(2)
    if sizes:
        every = np.array(sizes) - face.size
        best = sides.grown(belief, every)
        more, face = every[best], replace(face, size=sizes[best])
    grown = np.array([0.0, 0.0, 0.0, 0.0, 0.0, *more])
    step = (belief + sides.told(belief.from_there(-grown))).mean
    step[[WIDTH, HEIGHT]] = 0.0
    if not more.any() and bool((np.abs(step) < STILL).all()):
        return face, belief, patch
    there = replace(face, cell_from_face=moved(face.cell_from_face, step))
    return there, belief.from_there(step), _patch(there, frames, patch)


def _by_print(
    face: Face,
    belief: Belief,
    patch: Patch,
    frames: Sequence[Frame],
    identity: Identity,
    gallery: Gallery,
) -> tuple[Face, Belief, Patch]:
    """The face as large as its product, and what its print says of its place."""
    name, start = identity.name, identity.refined
    printed, (size,) = _print_of(name, gallery), _size_of(name, gallery)
    if _apart(size, face.size) > CUT:
        if name.score < RIGHT:
            return face, belief, patch
        face = replace(face, size=size)
        patch = _patch(face, frames, patch)
    print_ = printed.levels[1].turned(name.quarter)
    belief += Belief.around((*(np.inf,) * 5, CUT, CUT))
    if patch.eye is not None:
        turns = (0.0,) if name.score > RIGHT else (0.0, -ASKEW, ASKEW)
        starts = [(start.du, start.dv, start.turn + turn) for turn in turns]
        belief += by_print(patch.features, print_, patch.eye, belief, starts)
    return face, belief, patch


def _read_again(face: Face, frames: Sequence[Frame], gallery: Gallery) -> Face:
    """The face, its print read where the face is now known to be, if it was not sure of its name.

    Letters are compared stroke by stroke: of a face that is laid flat with a yaw that is wrong by a
    degree the strokes at one end lie beside the print's, and they pass for other letters.
    """
    if face.name is None or face.name.certain or face.name.score < RESEMBLES:
        return face
    patch = rectified(frames, face.facing, face.cell_from_face, face.size)
    again = None if patch is None else identify(patch, gallery, sized=True)
    return face if again is None else replace(face, name=again.name)


def _print_of(name: Name, gallery: Gallery) -> Print:
    """The print that says a name."""
    return next(
        each for each in gallery.prints if each.product.gtin == name.gtin and each.side == name.side
    )


def _size_of(name: Name | None, gallery: Gallery | None) -> list[tuple[float, float]]:
    """Width and height of a face with a name [m], where it has one."""
    if name is None or gallery is None:
        return []
    width, height = _print_of(name, gallery).size
    return [(width, height) if name.quarter % 2 == 0 else (height, width)]


def _patch(face: Face, frames: Sequence[Frame], before: Patch) -> Patch:
    """The face laid flat; as before, where no camera shows it any more."""
    return rectified(frames, face.facing, face.cell_from_face, face.size) or before


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


def _errors(facing: Facing, covariance: Floats, sway: Floats, view: int) -> Errors:
    """Of the four numbers that place a face."""
    chosen = [U, V, DEPTH, SWING if facing is Facing.FRONT else TURN]
    block = covariance[np.ix_(chosen, chosen)]
    rows = tuple(tuple(row) for row in block.tolist())
    return Errors(rows, view, tuple(sway[chosen].tolist()))


def _apart(size: tuple[float, float], other: tuple[float, float]) -> float:
    """By how much two sizes differ [m]."""
    return max(abs(a - b) for a, b in zip(size, other, strict=True))
