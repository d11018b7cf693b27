"""What the score knows of a rectangle: the same for every size, camera and direction."""

from collections.abc import Sequence

import numpy as np
import numpy.typing as npt

from depal.perception.scoring.parts import whole

Floats = npt.NDArray[np.float64]

NAMES = (
    "weakest side",
    "second side",
    "third side",
    "strongest side",
    "weakest third",
    "second weakest third",
    "third weakest third",
    "upright line inside",
    "level line inside",
    "clutter inside",
    "known",
    "hidden",
    "spread",
    "slope",
    "sides with something behind",
    "sides with something before",
    "open sides' weakest",
    "misfit",
    "misfit of one edge",
    "no sizes",
    "print",
    "printed",
    "longer edge",
    "shorter edge",
)

BEHIND = 0.025
"""A surface this far behind counts as behind [m]."""

USUAL_MISFIT = 0.6
"""Where no sizes are known the misfit counts as this."""


def described(
    measured: Floats, sizes: Floats, expected: Sequence[tuple[float, float]], prints: Floats
) -> Floats:
    """The features of rectangles.

    Args:
        measured: (n, FEATURES) as `proposals.kernels.measure` says.
        sizes: (n, 2) width and height [m].
        expected: widths and heights of the faces that may be there [m]; none where nobody knows.
        prints: (n,) how well the best print fits, in [0, 1]; negative where none was compared.

    Returns:
        (n, len(NAMES)).
    """
    sizes, unsure = whole(sizes, expected, measured[:, 22:26])
    sides = np.sort(measured[:, 0:4], axis=1)
    thirds = np.sort(measured[:, 4:8], axis=1)
    behind, before = measured[:, 12:16] > BEHIND, measured[:, 12:16] < -BEHIND
    open_ = np.where(behind, 1.0, measured[:, 0:4]).min(axis=1)
    columns = [
        *sides.T,
        *thirds[:, :3].T,
        measured[:, 8] - sides[:, 1],
        measured[:, 9] - sides[:, 1],
        measured[:, 19],
        measured[:, 10],
        measured[:, 20],
        np.log(measured[:, 11] * 1000 + 0.3),
        np.minimum(np.hypot(measured[:, 17], measured[:, 18]), 1.0),
        behind.sum(axis=1),
        before.sum(axis=1),
        open_,
        np.minimum(misfits(sizes, expected) + unsure * 100, 4.0),
        edge_misfits(sizes, expected),
        np.full(len(sizes), 0.0 if len(expected) else 1.0),
        np.maximum(prints, 0.0),
        (prints >= 0.0).astype(float),
        np.log(sizes.max(axis=1)),
        np.log(sizes.min(axis=1)),
    ]
    return np.column_stack(columns)


def misfits(sizes: Floats, expected: Sequence[tuple[float, float]]) -> Floats:
    """(n,) how far sizes (n, 2) are from the nearest expected one, in centimetres, up to 4."""
    if not len(expected):
        return np.full(len(sizes), USUAL_MISFIT)
    known = np.array(expected, dtype=float)
    away = np.hypot(*(sizes[:, None, :] - known[None]).transpose(2, 0, 1)).min(axis=1)
    return np.asarray(np.minimum(away * 100, 4.0))


def edge_misfits(sizes: Floats, expected: Sequence[tuple[float, float]]) -> Floats:
    """(n,) the same of the better edge alone: the other may be hidden in part."""
    if not len(expected):
        return np.full(len(sizes), USUAL_MISFIT / 2)
    away = np.abs(sizes[:, None, :] - np.array(expected, dtype=float)[None])
    return np.asarray(np.minimum(away.min(axis=(1, 2)) * 100, 4.0))
