"""The surface inside a rectangle, and what lies around it. Pixels are those of a turned raster."""

import math

import numpy as np
import numpy.typing as npt

from depal.geometry import kernel, loop_kernel

Floats = npt.NDArray[np.float64]
Narrow = npt.NDArray[np.float32]
Ints = npt.NDArray[np.int64]

HIDES = 0.025
"""What lies so far before a face hides it [m]."""

FLAT = 0.008
"""Depths with less spread about their plane are of one surface [m]."""

STEEP = 0.15
"""A face is no steeper against its raster [m/m]."""

REACH = 0.05
"""What covers a face is looked for so far beyond its side, across what is not known [m]."""


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
def covers(depth: Narrow, step: float, rectangles: Ints, out: Floats) -> None:
    """Where something nearer begins at a side, so that the face may go on behind it.

    Args:
        depth: (h, w) [m]; nan where unknown.
        step: of a pixel [m].
        rectangles: (n, 4) left, top, right, bottom [pixel].
        out: (n, >= 26); 16-18 as `surfaces` writes them; written: 22-25 the share of each side
            beyond which the first that is known lies nearer than the plane.
    """
    height, width = depth.shape
    reach = int(REACH / step)
    for n in range(rectangles.shape[0]):
        x0, y0, x1, y1 = rectangles[n, 0], rectangles[n, 1], rectangles[n, 2], rectangles[n, 3]
        mx, my = (x0 + x1) / 2, (y0 + y1) / 2
        for side in range(4):
            across = side % 2 == 0
            sign = -1 if side < 2 else 1  # noqa: PLR2004
            first, last = (y0, y1) if across else (x0, x1)
            near, count = 0, 0
            for along in range(first + 3, last - 2, 3):
                count += 1
                for away in range(3, reach, 2):
                    x = rectangles[n, side] + sign * away if across else along
                    y = along if across else rectangles[n, side] + sign * away
                    if x < 0 or y < 0 or x >= width or y >= height:
                        break
                    if math.isnan(depth[y, x]):
                        continue
                    dx, dy = (x - mx) * step, (y - my) * step
                    here = out[n, 16] + out[n, 17] * dx + out[n, 18] * dy
                    if here - depth[y, x] > HIDES:
                        near += 1
                        break
                    if away > 7:  # noqa: PLR2004 - what is mixed of both lies nearer to the side
                        break
            out[n, 22 + side] = near / count if count else 0.0
