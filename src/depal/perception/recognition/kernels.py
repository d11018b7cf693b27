"""The loops of the registration: its steps, and the normal equations of each over all pixels."""

import math

import numpy as np
import numpy.typing as npt

from depal.geometry import loop_kernel

Narrow = npt.NDArray[np.float32]
Floats = npt.NDArray[np.float64]


@loop_kernel
def steps_of_laying(  # noqa: PLR0913, PLR0917
    seen: Narrow,
    weights: Narrow,
    print_: Narrow,
    print_weights: Narrow,
    prior: Floats,
    ends: tuple[int, int, float, float],
    state: Floats,
    room: Floats,
    normal: Floats,
    right: Floats,
) -> None:
    """Gauss-Newton steps that lay a print over what is seen, first over a thinned grid.

    Args:
        seen: (h, w, 3) features.
        weights: (h, w) of the pixels seen.
        print_: (h', w', 3) features of the print at the same step.
        print_weights: (h', w').
        prior: (7,) how much speaks for no change of each number.
        ends: how many steps look at every second of the rows and columns only; how many steps there
            are at the most; the last one changes the shift [pixel] and the turn [rad] by less.
        state: (9,) as `normal_equations` has it; its first seven numbers are updated.
        room: (7, 7) for whatever is between.
        normal: (7, 7) of the last step, the prior included; overwritten.
        right: (7,); overwritten.
    """
    rough, most, still, level = ends
    every = state[8]
    for n in range(most):
        state[8] = 2 * every if n < rough else every
        normal_equations(seen, weights, print_, print_weights, state, room, normal, right)
        for g in range(7):
            normal[g, g] += prior[g]
            right[g] -= prior[g] * state[g]
        solved(normal, right, room)
        for g in range(7):
            state[g] += right[g]
        near = abs(right[0]) < still and abs(right[1]) < still and abs(right[2]) < level
        if near and n >= rough:
            break
    state[8] = every


@loop_kernel
def solved(matrix: Floats, values: Floats, room: Floats) -> None:
    """Solves a system of equations whose matrix is symmetric and positive, by Cholesky.

    Args:
        matrix: (n, n).
        values: (n,) the right side; the solution is written into it.
        room: (>= n, >= n); overwritten.
    """
    n = values.shape[0]
    for i in range(n):
        for j in range(i + 1):
            rest = matrix[i, j]
            for k in range(j):
                rest -= room[i, k] * room[j, k]
            room[i, j] = math.sqrt(rest) if i == j else rest / room[j, j]
    for i in range(n):
        for k in range(i):
            values[i] -= room[i, k] * values[k]
        values[i] /= room[i, i]
    for i in range(n - 1, -1, -1):
        for k in range(i + 1, n):
            values[i] -= room[k, i] * values[k]
        values[i] /= room[i, i]


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
        room: (>= 3, >= 3) for a pixel's residuals and their slopes.
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
                square += room[f, 0] * room[f, 0]
            gather(room, rx, ry, k, w / (1.0 + square / (state[7] * state[7])), normal, right)
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
def gather(
    room: Floats, rx: float, ry: float, k: float, w: float, normal: Floats, right: Floats
) -> None:
    """Adds a pixel's residuals to the normal equations' upper half.

    A feature with slopes gx, gy changes by k (gy rx - gx ry) with the turn and by gx rx + gy ry
    with s, so all products of slopes follow from those of gx and gy.

    Args:
        room: (3, >= 3) of each feature the residual, and its slopes gx, gy.
        rx: the pixel's place from the middle, turned.
        ry: the same, downward.
        k: 1 + s.
        w: the pixel's weight.
        normal: (7, 7); updated.
        right: (7,); updated.
    """
    a, b, c, p, q = 0.0, 0.0, 0.0, 0.0, 0.0
    for f in range(3):
        r, gx, gy = room[f, 0], room[f, 1], room[f, 2]
        wx, wy = w * gx, w * gy
        a += wx * gx
        b += wx * gy
        c += wy * gy
        p += wx * r
        q += wy * r
        normal[0, 4 + f] += wx
        normal[1, 4 + f] += wy
        normal[2, 4 + f] += k * (wy * rx - wx * ry)
        normal[3, 4 + f] += wx * rx + wy * ry
        normal[4 + f, 4 + f] += w
        right[4 + f] += w * r
    a2, b2 = k * (b * rx - a * ry), k * (c * rx - b * ry)
    a3, b3 = a * rx + b * ry, b * rx + c * ry
    normal[0, 0] += a
    normal[0, 1] += b
    normal[1, 1] += c
    normal[0, 2] += a2
    normal[1, 2] += b2
    normal[2, 2] += k * (b2 * rx - a2 * ry)
    normal[0, 3] += a3
    normal[1, 3] += b3
    normal[2, 3] += k * (b3 * rx - a3 * ry)
    normal[3, 3] += a3 * rx + b3 * ry
    right[0] += p
    right[1] += q
    right[2] += k * (q * rx - p * ry)
    right[3] += p * rx + q * ry


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
