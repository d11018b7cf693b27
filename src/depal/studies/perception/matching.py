"""Which detections are right: one to one with the true faces of which enough is seen.

A detection is right when it agrees with a true face that counts, wrong when it agrees with none,
and neither when it agrees with a face that is there but too much hidden to be asked for. A second
detection of the same face is wrong.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt
from scipy.optimize import linear_sum_assignment

from depal.perception.faces import Face
from depal.studies.perception.polygons import agreement
from depal.studies.perception.truth import TrueFace, corners_of

Floats = npt.NDArray[np.float64]

AGREES = 0.7
"""Intersection over union beyond which two areas are the same face."""

APART = 0.06
"""A detection that is this far before or behind a face is of something else [m]."""

TILTED = math.radians(20)
"""A detection that is turned this much out of a face's plane is of something else."""


@dataclass(frozen=True, slots=True)
class Matching:
    """What became of detections and true faces, by their indices.

    Attributes:
        pairs: detections with the faces that they found.
        ignored: detections with the faces that nobody asked for.
        wrong: detections of nothing.
        missed: faces that count and were not found.
    """

    pairs: tuple[tuple[int, int], ...]
    ignored: tuple[tuple[int, int], ...]
    wrong: tuple[int, ...]
    missed: tuple[int, ...]


def match_faces(found: Sequence[Face], true: Sequence[TrueFace]) -> Matching:
    """Matches detections to true faces by their outlines in the true face's plane."""
    agreed = np.array([[face_agreement(a, b) for b in true] for a in found], dtype=float)
    return matched(agreed.reshape(len(found), len(true)), [face.counts for face in true])


def matched(agreed: Floats, counts: Sequence[bool]) -> Matching:
    """Matches as many as possible, of these the ones that agree best.

    Args:
        agreed: (n, m) intersection over union of n detections and m true faces.
        counts: (m,) whether a true face must be found.
    """
    asked = np.array(counts, dtype=np.bool_).reshape(agreed.shape[1])
    pairs = _assigned(np.where(asked, agreed, 0.0))
    used = {detection for detection, _ in pairs}
    left = np.where(asked, 0.0, agreed)
    left[sorted(used)] = 0.0
    ignored = _assigned(left)
    used |= {detection for detection, _ in ignored}
    found = {face for _, face in pairs}
    return Matching(
        pairs,
        ignored,
        tuple(sorted(set(range(len(agreed))) - used)),
        tuple(face for face in np.flatnonzero(asked).tolist() if face not in found),
    )


def face_agreement(found: Face, true: TrueFace) -> float:
    """Intersection over union in the true face's plane; 0 where they are two different planes."""
    if found.facing is not true.facing:
        return 0.0
    turn = np.array(true.cell_from_face.rotation)
    shift = np.array(found.cell_from_face.translation) - true.cell_from_face.translation
    inward = np.array(found.cell_from_face.rotation)[:, 2]
    if abs(shift @ turn[:, 2]) > APART or inward @ turn[:, 2] < math.cos(TILTED):
        return 0.0
    reach = math.hypot(*found.size) / 2 + math.hypot(*true.size) / 2
    if shift @ shift > reach * reach:
        return 0.0
    flat = [
        ((corners - true.cell_from_face.translation) @ turn)[:, :2]
        for corners in (corners_of(found.cell_from_face, found.size), true.corners)
    ]
    return agreement(*flat)


def _assigned(agreed: Floats) -> tuple[tuple[int, int], ...]:
    """One to one: the most pairs that agree; of these the best together."""
    good = agreed > AGREES
    value = np.where(good, min(agreed.shape) + agreed, 0.0)
    rows, columns = linear_sum_assignment(value, maximize=True)
    return tuple(
        (int(row), int(column))
        for row, column in zip(rows, columns, strict=True)
        if good[row, column]
    )
