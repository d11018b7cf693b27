"""The loop that inverts the normal equations of all boxes: most of their entries are zero."""

import math

import numpy as np
import numpy.typing as npt

from depal.geometry import loop_kernel

Floats = npt.NDArray[np.float64]


@loop_kernel
def inverse(upper: Floats, out: Floats) -> None:
    """The inverse of a symmetric positive matrix, by Cholesky's factor; zeros cost nothing.

    Args:
        upper: (n, n) the matrix; overwritten, above its diagonal by the factor U of U^T U.
        out: (n, n); overwritten.
    """
    size = upper.shape[0]
    for k in range(size):
        scaled(upper, k, k, 1.0 / math.sqrt(upper[k, k]))
        for i in range(k + 1, size):
            less(upper, i, upper, k, upper[k, i])
    for i in range(size):
        for j in range(size):
            out[i, j] = 1.0 if i == j else 0.0
        for k in range(i):
            less(out, i, out, k, upper[k, i])
        scaled(out, i, 0, 1.0 / upper[i, i])
    for i in range(size - 1, -1, -1):
        for k in range(i + 1, size):
            less(out, i, out, k, upper[i, k])
        scaled(out, i, 0, 1.0 / upper[i, i])


@loop_kernel
def scaled(rows: Floats, row: int, first: int, factor: float) -> None:
    """Multiplies what a row has from a column on."""
    for j in range(first, rows.shape[1]):
        rows[row, j] *= factor


@loop_kernel
def less(rows: Floats, row: int, others: Floats, other: int, factor: float) -> None:
    """Takes another row, times a factor, off a row."""
    if factor != 0.0:
        for j in range(rows.shape[1]):
            rows[row, j] -= factor * others[other, j]
