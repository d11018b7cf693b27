"""A found face, seen finely: where exactly it is, and what its print says."""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from depal.geometry import Pose
from depal.perception.faces import Face
from depal.perception.recognition import Gallery, identify
from depal.perception.recognition.rectifying import rectified
from depal.perception.refining import refined
from depal.ports import Frame

SNAP = 0.018
"""A face whose edges differ from an expected size by less has that size [m]."""


@dataclass(frozen=True, slots=True)
class _Move:
    """From where a face was thought to be to where something says it is, with deviations.

    Attributes:
        du: along its width [m].
        dv: downward [m].
        turn: clockwise [rad].
        sigma: standard deviations of the three.
    """

    du: float
    dv: float
    turn: float
    sigma: tuple[float, float, float]


def located(
    face: Face,
    frames: Sequence[Frame],
    sizes: Sequence[tuple[float, float]],
    gallery: Gallery | None,
) -> Face:
    """The face where its edges and its print say that it is, named by its print.

    Args:
        face: as it was found.
        frames: of the look.
        sizes: widths and heights of the faces that may look this way [m]; none where nobody knows.
        gallery: the prints that may come; None where there are no pictures.
    """
    size = _nearest(face.size, sizes)
    face = face if size is None else replace(face, size=size)
    patch = rectified(frames, face.facing, face.cell_from_face, face.size)
    if patch is None:
        return face
    edges = refined(patch, fixed=size is not None)
    moves = [_Move(edges.du, edges.dv, edges.turn, edges.sigma)]
    name = face.name
    identity = identify(patch, gallery) if gallery is not None else None
    if identity is not None:
        name, print_ = identity.name, identity.refined
        moves.append(_Move(print_.du, print_.dv, print_.turn, print_.sigma))
    move = _together(moves)
    c, s = float(np.cos(move.turn)), float(np.sin(move.turn))
    shift = Pose((move.du, move.dv, 0.0), ((c, -s, 0.0), (s, c, 0.0), (0.0, 0.0, 1.0)))
    return replace(
        face,
        cell_from_face=face.cell_from_face @ shift,
        size=(edges.width, edges.height),
        name=name,
    )


def _nearest(
    size: tuple[float, float], sizes: Sequence[tuple[float, float]]
) -> tuple[float, float] | None:
    """The expected size that a face has; None where none is near."""
    if not sizes:
        return None
    away = np.abs(np.array(sizes) - size).max(axis=1)
    best = int(away.argmin())
    return sizes[best] if away[best] < SNAP else None


def _together(moves: Sequence[_Move]) -> _Move:
    """The mean of several moves, the more exact ones counting more."""
    values = np.array([(each.du, each.dv, each.turn) for each in moves])
    weights = 1.0 / np.array([each.sigma for each in moves]) ** 2
    mean = (values * weights).sum(axis=0) / weights.sum(axis=0)
    sigma = weights.sum(axis=0) ** -0.5
    du, dv, turn = mean.tolist()
    return _Move(du, dv, turn, (float(sigma[0]), float(sigma[1]), float(sigma[2])))
