"""The loops over rectangles. Pixels are those of a turned raster; edges lie on pixels."""

import numpy as np
import numpy.typing as npt

from depal.geometry import loop_kernel

Floats = npt.NDArray[np.float64]
Narrow = npt.NDArray[np.float32]
Ints = npt.NDArray[np.int64]

FEATURES = 26
"""So many numbers are measured of a rectangle; `sides`, `insides`, `surfaces.surfaces`,
`surfaces.covers` and `parts.seams_between` say which."""

INSIDE = 0.1
"""Lines nearer to a side than this share of the whole are that side's own."""


@loop_kernel
def row_mean(sums: Floats, row: int, first: int, last: int) -> float:
    """Mean of a map along a row, `last` included; sums (h, w + 1) run along rows."""
    return float((sums[row, last + 1] - sums[row, first]) / (last + 1 - first))


@loop_kernel
def corners(rows: Floats, columns: Floats, run: int, least: float, maps: Narrow) -> None:
    """How much every place looks like each of the four corners of a face.

    Args:
        rows: (h, w + 1) running sums of the evidence of level edges along rows.
        columns: (w, h + 1) running sums of the evidence of upright edges along columns.
        run: the two edges are looked at over so much of their length [pixel].
        least: weaker ones are left out.
        maps: (4, h, w) upper left, upper right, lower right, lower left; written.
    """
    height, width = rows.shape[0], rows.shape[1] - 1
    for y in range(height):
        for x in range(width):
            for c in range(4):
                maps[c, y, x] = 0.0
                right = (c + 1) % 4 < 2  # noqa: PLR2004
                down = c < 2  # noqa: PLR2004
                if (right and x + run >= width) or (not right and x < run):
                    continue
                if (down and y + run >= height) or (not down and y < run):
                    continue
                level = row_mean(rows, y, x, x + run) if right else row_mean(rows, y, x - run, x)
                if level < least:
                    continue
                upright = (
                    row_mean(columns, x, y, y + run) if down else row_mean(columns, x, y - run, y)
                )
                if upright >= least:
                    maps[c, y, x] = min(level, upright) + 0.1 * max(level, upright)


@loop_kernel
def snapped(rows: Floats, columns: Floats, slack: int, turns: int, rectangles: Ints) -> None:
    """Moves the sides of rectangles to where the evidence of edges is strongest nearby.

    Args:
        rows: (h, w + 1) running sums of the evidence of level edges along rows.
        columns: (w, h + 1) running sums of the evidence of upright edges along columns.
        slack: a side moves by so much at the most [pixel].
        turns: all four sides are moved so often.
        rectangles: (n, 4) left, top, right, bottom; updated.
    """
    height, width = rows.shape[0], rows.shape[1] - 1
    for n in range(rectangles.shape[0]):
        start = (rectangles[n, 0], rectangles[n, 1], rectangles[n, 2], rectangles[n, 3])
        for _ in range(turns):
            for side in range(4):
                x0, y0 = rectangles[n, 0], rectangles[n, 1]
                x1, y1 = rectangles[n, 2], rectangles[n, 3]
                best, at = -1.0, rectangles[n, side]
                for value in range(start[side] - slack, start[side] + slack + 1):
                    if side % 2 == 0:
                        if value < 0 or value >= width:
                            continue
                        mean = row_mean(columns, value, y0, y1)
                    else:
                        if value < 0 or value >= height:
                            continue
                        mean = row_mean(rows, value, x0, x1)
                    mean -= 0.01 * abs(value - start[side])
                    if mean > best:
                        best, at = mean, value
                rectangles[n, side] = at


@loop_kernel
def weakest_third(sums: Floats, line: int, first: int, last: int) -> float:
    """Mean over the weakest third of a map's row, `last` included."""
    third = max((last - first + 1) // 3, 1)
    least = row_mean(sums, line, first, first + third - 1)
    least = min(least, row_mean(sums, line, first + third, first + 2 * third - 1))
    return min(least, row_mean(sums, line, first + 2 * third, last))


@loop_kernel
def rough(rows: Floats, columns: Floats, rectangles: Ints, out: Floats) -> None:
    """A first score of rectangles: the mean of the sides, the weakest side, the weakest third.

    Args:
        rows: (h, w + 1) running sums of the evidence of level edges along rows.
        columns: (w, h + 1) running sums of the evidence of upright edges along columns.
        rectangles: (n, 4) left, top, right, bottom [pixel].
        out: (n,); written.
    """
    for n in range(rectangles.shape[0]):
        total, weakest, third = 0.0, 1e9, 1e9
        for side in range(4):
            other = 1 - side % 2
            first, last = rectangles[n, other], rectangles[n, other + 2]
            sums = columns if side % 2 == 0 else rows
            mean = row_mean(sums, rectangles[n, side], first, last)
            total += mean
            weakest = min(weakest, mean)
            third = min(third, weakest_third(sums, rectangles[n, side], first, last))
        out[n] = total / 4 + weakest + third


@loop_kernel
def unlike(sides: Floats, order: Ints, alike: float, rather: float, few: int, kept: Ints) -> int:
    """The first of an order, none like an earlier one.

    Args:
        sides: (n, d) places of candidates.
        order: (n,) their rows, the best first.
        alike: candidates whose places differ by no more, whichever is looked at, are the same.
        rather: of those that differ by no more, only so few are kept.
        few: how many.
        kept: (k,) room for rows; written.

    Returns:
        How many were kept; k at the most.
    """
    count = 0
    for n in range(order.shape[0]):
        if count == kept.shape[0]:
            break
        row, near, same = order[n], 0, False
        for m in range(count):
            away = 0.0
            for k in range(sides.shape[1]):
                away = max(away, abs(sides[kept[m], k] - sides[row, k]))
                if away > rather:
                    break
            if away <= rather:
                near += 1
                if away <= alike or near >= few:
                    same = True
                    break
        if not same:
            kept[count] = row
            count += 1
    return count


@loop_kernel
def sides(rows: Floats, columns: Floats, rectangles: Ints, out: Floats) -> None:
    """The evidence along the sides of rectangles.

    Args:
        rows: (h, w + 1) running sums of the evidence of level edges along rows.
        columns: (w, h + 1) running sums of the evidence of upright edges along columns.
        rectangles: (n, 4) left, top, right, bottom [pixel].
        out: (n, >= 8); written: 0-3 the mean along the left, top, right and lower side; 4-7 the
            mean over the weakest third of each.
    """
    for n in range(rectangles.shape[0]):
        for side in range(4):
            upright = side % 2 == 0
            other = 1 if upright else 0
            first, last = rectangles[n, other], rectangles[n, other + 2]
            line = rectangles[n, side]
            sums = columns if upright else rows
            out[n, side] = row_mean(sums, line, first, last)
            out[n, 4 + side] = weakest_third(sums, line, first, last)


@loop_kernel
def insides(rows: Floats, columns: Floats, rectangles: Ints, out: Floats) -> None:
    """The evidence of lines that cross rectangles.

    Args:
        rows: (h, w + 1) running sums of the evidence of level edges along rows.
        columns: (w, h + 1) running sums of the evidence of upright edges along columns.
        rectangles: (n, 4) left, top, right, bottom [pixel].
        out: (n, >= 20); written: 8, 9 the strongest upright and level line from edge to edge;
            19 the mean of all lines inside.
    """
    for n in range(rectangles.shape[0]):
        total, count = 0.0, 0
        for way in range(2):
            sums = columns if way == 0 else rows
            low, high = rectangles[n, way], rectangles[n, way + 2]
            first, last = rectangles[n, 1 - way], rectangles[n, 3 - way]
            margin = max(int(INSIDE * (high - low)), 6)
            best = 0.0
            for line in range(low + margin, high - margin + 1):
                mean = row_mean(sums, line, first, last)
                best = max(best, mean)
                total += mean
                count += 1
            out[n, 8 + way] = best
        out[n, 19] = total / count if count else 0.0


@loop_kernel
def pairs(first: Ints, second: Ints, lower: Ints, upper: Ints, out: Ints, flip: int) -> int:
    """Rectangles between two sets of opposite corners.

    Args:
        first: (n, 2) x, y of upper corners.
        second: (m, 2) x, y of lower corners.
        lower: least width and height [pixel].
        upper: greatest width and height [pixel].
        out: (k, 4) room for rectangles; written.
        flip: 0 where the first are upper left corners, 1 where they are upper right.

    Returns:
        How many were written; k at the most.
    """
    count = 0
    for i in range(first.shape[0]):
        for j in range(second.shape[0]):
            wide = second[j, 0] - first[i, 0]
            if flip:
                wide = -wide
            high = second[j, 1] - first[i, 1]
            if wide < lower[0] or high < lower[1] or wide > upper[0] or high > upper[1]:
                continue
            if count == out.shape[0]:
                return count
            out[count, 0] = first[i, 0] - (wide if flip else 0)
            out[count, 1] = first[i, 1]
            out[count, 2] = out[count, 0] + wide
            out[count, 3] = first[i, 1] + high
            count += 1
    return count
