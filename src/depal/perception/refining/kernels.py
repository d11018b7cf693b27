"""The loops that lay sides, depths and prints onto what a face shows."""

import math

import numpy as np
import numpy.typing as npt

from depal.geometry import loop_kernel
from depal.perception.recognition.kernels import sloped

Narrow = npt.NDArray[np.float32]
Floats = npt.NDArray[np.float64]


@loop_kernel
def profiles(strip: Narrow, known: npt.NDArray[np.bool_], slopes: Floats, out: Floats) -> None:
    """The mean of a strip along lines of several slopes.

    Args:
        strip: (n, m, c) n places along an edge, m across.
        known: (n, m).
        slopes: (k,) how far a line moves across for each step along.
        out: (k, m, c) mean along the line that crosses the strip's middle at each place across;
            nan where less than a third of the line is known; written.
    """
    n, m, channels = strip.shape
    for k in range(slopes.shape[0]):
        for j in range(m):
            seen = 0
            for c in range(channels):
                out[k, j, c] = 0.0
            for i in range(n):
                at = j + slopes[k] * (i - (n - 1) / 2)
                low = math.floor(at)
                if low < 0 or low + 1 >= m or not known[i, low] or not known[i, low + 1]:
                    continue
                part = at - low
                seen += 1
                for c in range(channels):
                    out[k, j, c] += (1.0 - part) * strip[i, low, c] + part * strip[i, low + 1, c]
            for c in range(channels):
                out[k, j, c] = out[k, j, c] / seen if 3 * seen > n else np.nan


@loop_kernel
def laid_over(  # noqa: PLR0913, PLR0917
    seen: Narrow,
    weights: Narrow,
    print_: Narrow,
    print_weights: Narrow,
    view: Floats,
    state: Floats,
    room: Floats,
    normal: Floats,
    right: Floats,
) -> float:
    """Sums of one Gauss-Newton step that moves a face until its print is where it is seen.

    The face's five errors move the print's points in the picture as `belief.flow` says; three more
    numbers are offsets of the features. Differences of the features are weighted down where they
    are large (Cauchy's function).

    Args:
        seen: (h, w, 3) features of the patch.
        weights: (h, w) of its pixels.
        print_: (h', w', 3) features of the print, as it is seen.
        print_weights: (h', w').
        view: (6,) the eye in the face's frame [m], edge of a pixel [m], scale of the weighting,
            every how manieth row and column of the print is looked at.
        state: (8,) shift along u, v and depth [m], swing and turn [rad], offsets.
        room: (3, 6) for a pixel's differences and derivatives.
        normal: (8, 8); overwritten.
        right: (8,); overwritten.

    Returns:
        The weighted mean of the squared differences.
    """
    height, width = weights.shape
    high, wide = print_weights.shape
    ex, ey, ez, step = view[0], view[1], -view[2], view[3]
    every, total, count = int(view[5]), 0.0, 0.0
    normal[:] = 0.0
    right[:] = 0.0
    for row in range(0, high, every):
        y = (row - (high - 1) / 2) * step
        for column in range(0, wide, every):
            if print_weights[row, column] <= 0.0:
                continue
            x = (column - (wide - 1) / 2) * step
            nx, ny = (ex - x) / ez, (ey - y) / ez
            deep = state[2] - x * state[3]
            u = (x + state[0] + nx * deep - y * state[4]) / step + (width - 1) / 2
            v = (y + state[1] + ny * deep + x * state[4]) / step + (height - 1) / 2
            i, j = math.floor(u), math.floor(v)
            if i < 0 or j < 0 or i >= width - 1 or j >= height - 1:
                continue
            w = weights[j, i] * weights[j + 1, i + 1] * print_weights[row, column]
            if w <= 0.0:
                continue
            square = 0.0
            for f in range(3):
                room[f, 0] = print_[row, column, f] + state[5 + f]
                sloped(seen, i, j, f, u - i, v - j, room)
                gx, gy = room[f, 1] / step, room[f, 2] / step
                room[f, 1], room[f, 2], room[f, 3] = gx, gy, gx * nx + gy * ny
                room[f, 4], room[f, 5] = -x * room[f, 3], gy * x - gx * y
                square += room[f, 0] * room[f, 0]
            w /= 1.0 + square / (view[4] * view[4])
            total += w * square
            count += w
            gather(room, w, normal, right)
    for g in range(8):
        for h in range(g):
            normal[g, h] = normal[h, g]
    return total / max(count, 1e-9)


@loop_kernel
def gather(room: Floats, w: float, normal: Floats, right: Floats) -> None:
    """Adds a pixel's differences to the normal equations' upper half.

    Args:
        room: (3, 6) of each feature the difference, and how the picture changes with the errors.
        w: the pixel's weight.
        normal: (8, 8); updated.
        right: (8,); updated.
    """
    for f in range(3):
        off = room[f, 0]
        for g in range(5):
            slope = w * room[f, 1 + g]
            for h in range(g, 5):
                normal[g, h] += slope * room[f, 1 + h]
            normal[g, 5 + f] -= slope
            right[g] += slope * off
        normal[5 + f, 5 + f] += w
        right[5 + f] -= w * off
