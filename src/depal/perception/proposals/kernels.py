"""The loops over rectangles. Pixels are those of a turned raster; edges lie on pixels."""

import math

import numpy as np
import numpy.typing as npt

from depal.geometry import kernel, loop_kernel

Floats = npt.NDArray[np.float64]
Narrow = npt.NDArray[np.float32]
Ints = npt.NDArray[np.int64]

FEATURES = 21
"""So many numbers are measured of a rectangle; `sides`, `insides` and `surfaces` say which."""

HIDES = 0.025
"""What lies so far before a face hides it [m]."""

FLAT = 0.008
"""Depths with less spread about their plane are of one surface [m]."""

STEEP = 0.15
"""A face is no steeper against its raster [m/m]."""

INSIDE = 0.1
"""Lines nearer to a side than this share of the whole are that side's own."""


@loop_kernel
def _row_mean(sums: Floats, row: int, first: int, last: int) -> float:
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
                level = _row_mean(rows, y, x, x + run) if right else _row_mean(rows, y, x - run, x)
                if level < least:
                    continue
                upright = (
                    _row_mean(columns, x, y, y + run) if down else _row_mean(columns, x, y - run, y)
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
                        mean = _row_mean(columns, value, y0, y1)
                    else:
                        if value < 0 or value >= height:
                            continue
                        mean = _row_mean(rows, value, x0, x1)
                    mean -= 0.01 * abs(value - start[side])
                    if mean > best:
                        best, at = mean, value
                rectangles[n, side] = at


@loop_kernel
def _weakest(sums: Floats, line: int, first: int, last: int) -> float:
    """Mean over the weakest third of a map's row, `last` included."""
    third = max((last - first + 1) // 3, 1)
    least = _row_mean(sums, line, first, first + third - 1)
    least = min(least, _row_mean(sums, line, first + third, first + 2 * third - 1))
    return min(least, _row_mean(sums, line, first + 2 * third, last))


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
            mean = _row_mean(sums, rectangles[n, side], first, last)
            total += mean
            weakest = min(weakest, mean)
            third = min(third, _weakest(sums, rectangles[n, side], first, last))
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
            out[n, side] = _row_mean(sums, line, first, last)
            out[n, 4 + side] = _weakest(sums, line, first, last)


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
                mean = _row_mean(sums, line, first, last)
                best = max(best, mean)
                total += mean
                count += 1
            out[n, 8 + way] = best
        out[n, 19] = total / count if count else 0.0


@loop_kernel
def _plane(
    depth: Narrow, rectangle: tuple[int, int, int, int], plane: Floats, hides: float, sums: Floats
) -> float:
    """Sums for the plane through a rectangle's depths, without what hides it.

    Args:
        depth: (h, w) [m]; nan where unknown.
        rectangle: left, top, right, bottom [pixel].
        plane: (3,) a plane so far: depth in the middle, slopes for each pixel; nan at first.
        hides: what lies so far before the plane hides it [m].
        sums: (11,) written: 0-8 sums; 9 places whose depth is known; 10 places that are hidden.

    Returns:
        How many places there are.
    """
    x0, y0, x1, y1 = rectangle
    mx, my = (x0 + x1) / 2, (y0 + y1) / 2
    places = 0.0
    for k in range(11):
        sums[k] = 0.0
    for y in range(y0 + 2, y1 - 1, 5):
        for x in range(x0 + 2, x1 - 1, 5):
            places += 1.0
            d = depth[y, x]
            if math.isnan(d):
                continue
            dx, dy = x - mx, y - my
            if plane[0] + plane[1] * dx + plane[2] * dy - d > hides:
                sums[10] += 1.0
                continue
            sums[9] += 1.0
            sums[0] += dx
            sums[1] += dy
            sums[2] += dx * dx
            sums[3] += dx * dy
            sums[4] += dy * dy
            sums[5] += d
            sums[6] += d * dx
            sums[7] += d * dy
            sums[8] += d * d
    return places


@kernel
def surfaces(depth: Narrow, step: float, rectangles: Ints, out: Floats) -> None:
    """The depths inside and around rectangles.

    Args:
        depth: (h, w) [m]; nan where unknown.
        step: of a pixel [m].
        rectangles: (n, 4) left, top, right, bottom [pixel].
        out: (n, >= 21); written: 10 the share whose depth is known or hidden; 11 the spread about
            the plane through what is not hidden [m]; 12-15 how far the surface beyond each side
            lies behind the plane [m], clipped, 0.2 where nothing is known; 16-18 the plane: depth
            in the middle [m], slope along x and y; 20 the share that something nearer hides.
    """
    s, plane = np.zeros(11), np.zeros(3)
    for n in range(rectangles.shape[0]):
        x0, y0, x1, y1 = rectangles[n, 0], rectangles[n, 1], rectangles[n, 2], rectangles[n, 3]
        out[n, 11], out[n, 16], out[n, 17], out[n, 18] = 0.05, np.nan, 0.0, 0.0
        plane[0], plane[1], plane[2] = np.nan, 0.0, 0.0
        places = 1.0
        for _ in range(4):
            places = max(_plane(depth, (x0, y0, x1, y1), plane, HIDES, s), 1.0)
            seen = s[9]
            if seen <= 12:  # noqa: PLR2004
                break
            ax, ay, ad = s[0] / seen, s[1] / seen, s[5] / seen
            xx, xy, yy = s[2] / seen - ax * ax, s[3] / seen - ax * ay, s[4] / seen - ay * ay
            xd, yd, dd = s[6] / seen - ax * ad, s[7] / seen - ay * ad, s[8] / seen - ad * ad
            det = xx * yy - xy * xy
            if det <= 1e-6:  # noqa: PLR2004
                break
            a, b = (xd * yy - yd * xy) / det, (yd * xx - xd * xy) / det
            out[n, 11] = math.sqrt(max(dd - a * xd - b * yd, 0.0))
            plane[0], plane[1], plane[2] = ad - a * ax - b * ay, a, b
            if out[n, 11] < FLAT:
                break
            if math.hypot(a, b) > STEEP * step:
                # What is mixed with something nearer looks steep; its farther part is the face.
                plane[0], plane[1], plane[2] = ad, 0.0, 0.0
        out[n, 10], out[n, 20] = (s[9] + s[10]) / places, s[10] / places
        out[n, 16], out[n, 17], out[n, 18] = plane[0], plane[1] / step, plane[2] / step
        for side in range(4):
            out[n, 12 + side] = _beyond(depth, (x0, y0, x1, y1), side, out[n, 16:19], step)


@loop_kernel
def _beyond(
    depth: Narrow, rectangle: tuple[int, int, int, int], side: int, plane: Floats, step: float
) -> float:
    """How far the surface just beyond a side lies behind the plane of the rectangle [m]."""
    height, width = depth.shape
    x0, y0, x1, y1 = rectangle
    mx, my = (x0 + x1) / 2, (y0 + y1) / 2
    total, count = 0.0, 0
    first, last = (y0, y1) if side % 2 == 0 else (x0, x1)
    for along in range(first + 3, last - 2, 3):
        for away in range(5, 9, 3):
            if side == 0:
                x, y = x0 - away, along
            elif side == 1:
                x, y = along, y0 - away
            elif side == 2:  # noqa: PLR2004
                x, y = x1 + away, along
            else:
                x, y = along, y1 + away
            count += 1
            if x < 0 or y < 0 or x >= width or y >= height or math.isnan(depth[y, x]):
                total += 0.2
                continue
            here = plane[0] + plane[1] * (x - mx) * step + plane[2] * (y - my) * step
            behind = min(max(depth[y, x] - here, -0.2), 0.2)
            total += 0.0 if math.isnan(behind) else behind
    return total / count if count else 0.0


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
