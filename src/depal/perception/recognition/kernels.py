"""The loop of the registration: one step's normal equations over all pixels."""

import numpy as np
import numpy.typing as npt

from depal.geometry import loop_kernel

Narrow = npt.NDArray[np.float32]
Floats = npt.NDArray[np.float64]


@loop_kernel
def normal_equations(
    seen: Narrow,
    weights: Narrow,
    print_: Narrow,
    print_weights: Narrow,
    state: Floats,
    room: Floats,
    normal: Floats,
    right: Floats,
) -> None:
    """Sums of one Gauss-Newton step that lays a print over what is seen.

    A pixel (x, y) of what is seen, counted from its middle, lies in the print at
    (1 + s) R(turn) (x, y) + (dx, dy), counted from the print's middle. Differences of the
    features are weighted down where they are large (Cauchy's function).

    Args:
        seen: (h, w, 3) features.
        weights: (h, w) of the pixels seen.
        print_: (h', w', 3) features of the print at the same step.
        print_weights: (h', w').
        state: (9,) dx, dy [pixel], turn [rad], s, an offset of each feature; the scale of the
            weighting; every how manieth row and column is looked at.
        room: (3, 5) for a pixel's residuals and their derivatives.
        normal: (7, 7); overwritten.
        right: (7,); overwritten.
    """
    height, width = weights.shape
    high, wide = print_weights.shape
    every = int(state[8])
    normal[:] = 0.0
    right[:] = 0.0
    c, s, k = np.cos(state[2]), np.sin(state[2]), 1.0 + state[3]
    x0, y0 = (width - 1) / 2, (height - 1) / 2
    u0, v0 = (wide - 1) / 2 + state[0], (high - 1) / 2 + state[1]
    for row in range(0, height, every):
        y = row - y0
        for column in range(0, width, every):
            x = column - x0
            rx, ry = c * x - s * y, s * x + c * y
            u, v = u0 + k * rx, v0 + k * ry
            i, j = int(np.floor(u)), int(np.floor(v))
            if i < 0 or j < 0 or i >= wide - 1 or j >= high - 1:
                continue
            w = weights[row, column] * print_weights[j, i]
            if w <= 0.0:
                continue
            square = 0.0
            for f in range(3):
                room[f, 0] = seen[row, column, f] - state[4 + f]
                sloped(print_, i, j, f, u - i, v - j, room)
                room[f, 3] = k * (room[f, 2] * rx - room[f, 1] * ry)
                room[f, 4] = room[f, 1] * rx + room[f, 2] * ry
                square += room[f, 0] * room[f, 0]
            gather(room, w / (1.0 + square / (state[7] * state[7])), normal, right)
    for i in range(7):
        for j in range(i):
            normal[i, j] = normal[j, i]


@loop_kernel
def sloped(print_: Narrow, i: int, j: int, f: int, a: float, b: float, room: Floats) -> None:
    """Takes a print's feature between four pixels off a value, and says how it changes.

    Args:
        print_: (h, w, 3).
        i: column of the upper left one.
        j: its row.
        f: which feature.
        a: how far to the right of it, 0 .. 1.
        b: how far below it.
        room: (3, k) value, slope along the row, slope along the column, then others; updated.
    """
    p, q = print_[j, i, f], print_[j, i + 1, f]
    m, n = print_[j + 1, i, f], print_[j + 1, i + 1, f]
    room[f, 0] -= (p * (1 - a) + q * a) * (1 - b) + (m * (1 - a) + n * a) * b
    room[f, 1] = (q - p) * (1 - b) + (n - m) * b
    room[f, 2] = (m - p) * (1 - a) + (n - q) * a


@loop_kernel
def gather(room: Floats, w: float, normal: Floats, right: Floats) -> None:
    """Adds a pixel's residuals to the normal equations' upper half.

    Args:
        room: (3, 5) of each feature the residual and its derivatives by dx, dy, turn and s.
        w: the pixel's weight.
        normal: (7, 7); updated.
        right: (7,); updated.
    """
    for f in range(3):
        r = room[f, 0]
        for g in range(4):
            slope = w * room[f, 1 + g]
            for h in range(g, 4):
                normal[g, h] += slope * room[f, 1 + h]
            normal[g, 4 + f] += slope
            right[g] += slope * r
        normal[4 + f, 4 + f] += w
        right[4 + f] += w * r


@loop_kernel
def moments(
    one: Narrow, one_weights: Narrow, other: Narrow, other_weights: Narrow, cell: int, out: Narrow
) -> None:
    """Sums over square cells of two pictures' features, their squares and their products.

    Args:
        one: (h, w, 3) features.
        one_weights: (h, w).
        other: (h, w, 3) features.
        other_weights: (h, w).
        cell: edge of a cell [pixel].
        out: (rows, columns, 10) sums of the weight; of each feature of one, and of the other; of
            all squares of one, of the other, and of the products. Overwritten.
    """
    out[:] = 0.0
    rows, columns = out.shape[:2]
    for row in range(rows * cell):
        i = row // cell
        for column in range(columns * cell):
            w = one_weights[row, column] * other_weights[row, column]
            if w <= 0.0:
                continue
            cells = out[i, column // cell]
            cells[0] += w
            for f in range(3):
                a, b = one[row, column, f], other[row, column, f]
                cells[1 + f] += w * a
                cells[4 + f] += w * b
                cells[7] += w * a * a
                cells[8] += w * b * b
                cells[9] += w * a * b


@loop_kernel
def products(one: Narrow, other: Narrow, weights: Narrow, cell: int, out: Narrow) -> None:
    """Sums over square cells of two pictures' products and squares.

    Args:
        one: (h, w, 3) features.
        other: (h, w, 3) features.
        weights: (h, w).
        cell: edge of a cell [pixel].
        out: (rows, columns, 3) products, squares of one, squares of the other. Overwritten.
    """
    out[:] = 0.0
    rows, columns = out.shape[:2]
    for row in range(rows * cell):
        for column in range(columns * cell):
            w = weights[row, column]
            if w <= 0.0:
                continue
            cells = out[row // cell, column // cell]
            for f in range(3):
                a, b = one[row, column, f], other[row, column, f]
                cells[0] += w * a * b
                cells[1] += w * a * a
                cells[2] += w * b * b
