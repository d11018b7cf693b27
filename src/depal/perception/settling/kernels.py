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
        root = math.sqrt(upper[k, k])
        for j in range(k, size):
            upper[k, j] /= root
        for i in range(k + 1, size):
            factor = upper[k, i]
            if factor != 0.0:
                for j in range(i, size):
                    upper[i, j] -= factor * upper[k, j]
    for i in range(size):
        for j in range(size):
            out[i, j] = 1.0 if i == j else 0.0
        for k in range(i):
            factor = upper[k, i]
            if factor != 0.0:
                for j in range(k + 1):
                    out[i, j] -= factor * out[k, j]
        for j in range(i + 1):
            out[i, j] /= upper[i, i]
    for i in range(size - 1, -1, -1):
        for k in range(i + 1, size):
            factor = upper[i, k]
            if factor != 0.0:
                for j in range(size):
                    out[i, j] -= factor * out[k, j]
        for j in range(size):
            out[i, j] /= upper[i, i]
