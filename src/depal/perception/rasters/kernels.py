"""The loops over pixels: from depth pictures to rasters."""

import math

import numpy as np
import numpy.typing as npt

from depal.geometry import loop_kernel

Floats = npt.NDArray[np.float64]
Narrow = npt.NDArray[np.float32]
Bytes = npt.NDArray[np.uint8]


ALIKE = 0.030
"""Points so near behind the nearest are of its surface [m]."""


@loop_kernel
def normals(depth: Narrow, k: Floats, reach: int, jump: float, out: Narrow) -> None:
    """The normal of the surface at every pixel, from differences to pixels `reach` away.

    Args:
        depth: (h, w) along the axis [m], smoothed; 0 where unknown.
        k: (4,) fx, fy, cx, cy [pixel].
        reach: [pixel].
        jump: neighbours that differ by more, as a share of the depth, are another surface.
        out: (h, w, 3) unit normals towards the camera; zero where unknown; written.
    """
    height, width = depth.shape
    for row in range(height):
        for column in range(width):
            out[row, column, 0] = out[row, column, 1] = out[row, column, 2] = 0.0
            z = depth[row, column]
            if z <= 0.0:
                continue
            # 1 / z is linear over the picture of a plane: its slopes are the normal's.
            left = max(column - reach, 0)
            right = min(column + reach, width - 1)
            up = max(row - reach, 0)
            down = min(row + reach, height - 1)
            limit = jump * z
            gx, gy, nx, ny = 0.0, 0.0, 0, 0
            for other in (left, right):
                far = depth[row, other]
                if far > 0.0 and abs(far - z) < limit and other != column:
                    gx += (1.0 / far - 1.0 / z) / (other - column)
                    nx += 1
            for other in (up, down):
                far = depth[other, column]
                if far > 0.0 and abs(far - z) < limit and other != row:
                    gy += (1.0 / far - 1.0 / z) / (other - row)
                    ny += 1
            if nx == 0 or ny == 0:
                continue
            a, b = gx / nx * k[0], gy / ny * k[1]
            rx, ry = (column - k[2]) / k[0], (row - k[3]) / k[1]
            c = 1.0 / z - a * rx - b * ry
            length = math.sqrt(a * a + b * b + c * c)
            out[row, column, 0] = -a / length
            out[row, column, 1] = -b / length
            out[row, column, 2] = -c / length


@loop_kernel
def splat(  # noqa: PLR0913, PLR0917
    depth: Narrow,
    normal: Narrow,
    k: Floats,
    carried: Floats,
    step: float,
    flattest: float,
    deepest: float,
    nearest: Narrow,
    total: Narrow,
    count: Narrow,
) -> None:
    """Puts the points of a depth picture into a raster; the nearest surface at each place stays.

    To be called for all cameras, and then once more for all with `count` cleared to zero: at
    first `nearest` becomes the nearest point at each place, which noise brings nearer than the
    surface is; then all points near to it are summed.

    Args:
        depth: (h, w) [m]; 0 where unknown.
        normal: (h, w, 3) in the camera's frame; zero where unknown.
        k: (4,) fx, fy, cx, cy [pixel].
        carried: (3, 4) `raster_from_camera`.
        step: of the raster [m].
        flattest: cosine between a normal and the viewing direction below which a point is left.
        deepest: what lies deeper is left [m].
        nearest: (h', w') depth in the raster [m], infinite where none; updated while `count` is
            negative.
        total: (h', w') sum of the depths near to the nearest [m]; updated after that.
        count: (h', w') how many those are, negative at first; updated after that.
    """
    height, width = depth.shape
    rows, columns = nearest.shape
    for row in range(height):
        ry = (row - k[3]) / k[1]
        for column in range(width):
            z = depth[row, column]
            if z <= 0.0:
                continue
            n = normal[row, column]
            facing = carried[2, 0] * n[0] + carried[2, 1] * n[1] + carried[2, 2] * n[2]
            if -facing < flattest:
                continue
            x, y = (column - k[2]) / k[0] * z, ry * z
            d = carried[2, 0] * x + carried[2, 1] * y + carried[2, 2] * z + carried[2, 3]
            if d < 0.0 or d > deepest:
                continue
            u = carried[0, 0] * x + carried[0, 1] * y + carried[0, 2] * z + carried[0, 3]
            v = carried[1, 0] * x + carried[1, 1] * y + carried[1, 2] * z + carried[1, 3]
            i, j = math.floor(v / step + 0.5), math.floor(u / step + 0.5)
            if i < 0 or j < 0 or i >= rows or j >= columns:
                continue
            if count[i, j] < 0.0:
                nearest[i, j] = min(nearest[i, j], d)
            elif d < nearest[i, j] + ALIKE:
                total[i, j] += d
                count[i, j] += 1.0


@loop_kernel
def gather(  # noqa: PLR0913, PLR0917
    depth: Narrow,
    picture: Bytes,
    behind: Narrow,
    scale: float,
    k: Floats,
    carried: Floats,
    step: float,
    hidden: float,
    weight: Narrow,
    colour: Narrow,
) -> None:
    """Fetches the colours of a raster's surfaces from one picture.

    Args:
        depth: (h, w) of the raster [m]; nan where unknown.
        picture: (h', w', 3) RGB.
        behind: (h'', w'') depth picture of the same camera [m]; 0 where unknown.
        scale: pixels of the depth picture per pixel of the colour picture.
        k: (4,) fx, fy, cx, cy of the colour picture [pixel].
        carried: (3, 4) `camera_from_raster`.
        step: of the raster [m].
        hidden: what lies so far behind what the camera measures there is hidden [m].
        weight: (h, w) how well the best camera so far sees each place; updated.
        colour: (h, w, 3); updated where this camera sees it better.
    """
    rows, columns = depth.shape
    high, wide = picture.shape[0], picture.shape[1]
    dh, dw = behind.shape
    for i in range(rows):
        for j in range(columns):
            d = depth[i, j]
            if not d < 1e9:  # noqa: PLR2004
                continue
            u, v = j * step, i * step
            z = carried[2, 0] * u + carried[2, 1] * v + carried[2, 2] * d + carried[2, 3]
            if z <= 0.05:  # noqa: PLR2004
                continue
            x = carried[0, 0] * u + carried[0, 1] * v + carried[0, 2] * d + carried[0, 3]
            y = carried[1, 0] * u + carried[1, 1] * v + carried[1, 2] * d + carried[1, 3]
            range_ = math.sqrt(x * x + y * y + z * z)
            # How squarely it is seen, over how far away it is.
            seen = (x * carried[0, 2] + y * carried[1, 2] + z * carried[2, 2]) / range_
            value = seen * k[0] / range_
            if seen <= 0.1 or value <= weight[i, j]:  # noqa: PLR2004
                continue
            px, py = k[0] * x / z + k[2], k[1] * y / z + k[3]
            c0, r0 = math.floor(px), math.floor(py)
            if c0 < 0 or r0 < 0 or c0 + 1 >= wide or r0 + 1 >= high:
                continue
            dr, dc = int(py * scale + 0.5), int(px * scale + 0.5)
            if dr < dh and dc < dw:
                measured = behind[dr, dc]
                if measured > 0.0 and measured < z - hidden:
                    continue
            fx, fy = px - c0, py - r0
            for c in range(3):
                above = (1 - fx) * picture[r0, c0, c] + fx * picture[r0, c0 + 1, c]
                below = (1 - fx) * picture[r0 + 1, c0, c] + fx * picture[r0 + 1, c0 + 1, c]
                colour[i, j, c] = (1 - fy) * above + fy * below
            weight[i, j] = value


@loop_kernel
def level(depth: Narrow, radius: int, spread: float, out: Narrow) -> None:
    """Smooths a raster's depth within surfaces, and closes small holes.

    Args:
        depth: (h, w) [m]; infinite or nan where unknown.
        radius: of the window [pixel]; every second pixel of it counts.
        spread: what differs by more from the window's middle value is another surface [m].
        out: (h, w) [m]; nan where unknown; written.
    """
    rows, columns = depth.shape
    for i in range(rows):
        for j in range(columns):
            middle = depth[i, j]
            out[i, j] = np.nan
            if not middle < 1e9:  # noqa: PLR2004
                continue
            total, count = 0.0, 0
            for a in range(max(i - radius, 0), min(i + radius + 1, rows), 2):
                for b in range(max(j - radius, 0), min(j + radius + 1, columns), 2):
                    value = depth[a, b]
                    if abs(value - middle) < spread:
                        total += value
                        count += 1
            out[i, j] = total / count if count else middle
