"""Poses and intrinsics as files keep them: rows of numbers."""

import json

import numpy as np
import numpy.typing as npt

from depal.geometry import Matrix3, Pose

FARTHEST = 20.0
"""No camera and no box of a cell is farther or larger [m]."""

_SQUARE = 1e-3
"""A rotation's rows, as people round them, are so far from unit length and right angles."""

_EXACT = 1e-9
"""A rotation that is nearer to a true one is left as it is."""


def rows_of(pose: Pose) -> list[list[float]]:
    """A pose as a matrix: four rows of four numbers."""
    rows = zip(pose.rotation, pose.translation, strict=True)
    return [*([*row, shift] for row, shift in rows), [0.0, 0.0, 0.0, 1.0]]


def pose_of_rows(value: object) -> Pose | str:
    """The pose of a matrix, or what is wrong with it; rounded rotations are made square."""
    matrix = numbers(value, (4, 4))
    if matrix is None:
        return f"{shown(value)} is no matrix of 4 x 4 numbers"
    if np.abs(matrix[3] - (0.0, 0.0, 0.0, 1.0)).max() > _EXACT:
        return f"is no rigid pose: its last row is {_row(matrix[3])}"
    turn, shift = matrix[:3, :3], matrix[:3, 3]
    apart = float(np.abs(turn @ turn.T - np.eye(3)).max())
    if apart > _SQUARE:
        return f"is no rigid pose: its rows are {apart:.2g} from unit length and right angles"
    if np.linalg.det(turn) < 0.0:
        return "is no rigid pose: it mirrors"
    if np.abs(shift).max() > FARTHEST:
        return f"is {float(np.abs(shift).max()):g} m away"
    if apart > _EXACT:
        left, _, right = np.linalg.svd(turn)
        turn = left @ right
    return Pose.from_arrays(shift, turn)


def lens_of_rows(value: object) -> Matrix3 | str:
    """The intrinsics of a matrix, or what is wrong with it."""
    k = numbers(value, (3, 3))
    if k is None:
        return f"{shown(value)} is no matrix of 3 x 3 numbers"
    whole = np.abs(k - k * ((1, 0, 1), (0, 1, 1), (0, 0, 1))).max() <= _EXACT and k[2, 2] == 1.0
    if not whole or k[0, 0] <= 0.0 or k[1, 1] <= 0.0:
        return "is no matrix of a pinhole camera without skew"
    (a, b, c), (d, e, f), (g, h, i) = k.tolist()
    return ((a, b, c), (d, e, f), (g, h, i))


def numbers(value: object, shape: tuple[int, ...]) -> npt.NDArray[np.float64] | None:
    """Finite numbers of a shape, or None."""
    leaves, rest = [value], shape
    while rest:
        if not all(isinstance(leaf, list) and len(leaf) == rest[0] for leaf in leaves):
            return None
        leaves = [inner for leaf in leaves if isinstance(leaf, list) for inner in leaf]
        rest = rest[1:]
    floats = [
        float(leaf)
        for leaf in leaves
        if isinstance(leaf, int | float) and not isinstance(leaf, bool) and abs(leaf) < 1e300  # noqa: PLR2004
    ]
    if len(floats) < len(leaves):
        return None
    return np.array(floats).reshape(shape)


def shown(value: object) -> str:
    """A foreign value in a few characters."""
    if isinstance(value, list | dict):
        return "this"
    text = json.dumps(value)
    return text if len(text) <= 40 else f"{text[:40]}..."  # noqa: PLR2004


def _row(values: npt.NDArray[np.float64]) -> str:
    return " ".join(f"{value:g}" for value in values)
