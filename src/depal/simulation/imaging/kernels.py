"""The rasteriser's two loops: which triangle a pixel sees, and what colour that has.

Coverage by homogeneous edge functions: a ray r lies inside the cone of a triangle's corners
p0, p1, p2 seen from the origin exactly when r . (p1 x p2) and its two likes have one sign, so
no triangle is ever cut (Olano and Greer, "Triangle scan conversion using 2D homogeneous
coordinates", 1997). Depth comes from the triangle's plane: 1/z is linear over the picture.
"""

import math

import numpy as np
import numpy.typing as npt

from depal.geometry import loop_kernel

Floats = npt.NDArray[np.float64]
Ints = npt.NDArray[np.int64]
Bytes = npt.NDArray[np.uint8]
Depths = npt.NDArray[np.float64] | npt.NDArray[np.float32]

SHARP = 0.8
"""A texture's next coarser level is taken where a pixel covers 1 / SHARP of its texels."""


@loop_kernel
def cover(
    corners: Floats, lens: Floats, nearest: Depths, owner: npt.NDArray[np.int32], first: int
) -> None:
    """Finds what each pixel sees; only the outer sides of triangles are seen.

    Args:
        corners: (n, 3, 3) in the camera's frame [m]; anticlockwise as seen from outside.
        lens: (5,) fx, fy, cx, cy [pixel], and the nearest depth that is seen [m].
        nearest: (h, w) 1 / depth of the nearest surface [1/m]; updated.
        owner: (h, w) index of its triangle; updated.
        first: the number of the first of these triangles.
    """
    height, width = nearest.shape
    fx, fy, cx, cy, near = lens[0], lens[1], lens[2], lens[3], lens[4]
    for t in range(corners.shape[0]):
        p = corners[t]
        if p[0, 2] < near and p[1, 2] < near and p[2, 2] < near:
            continue
        ax, ay, az = p[1, 0] - p[0, 0], p[1, 1] - p[0, 1], p[1, 2] - p[0, 2]
        bx, by, bz = p[2, 0] - p[0, 0], p[2, 1] - p[0, 1], p[2, 2] - p[0, 2]
        nx, ny, nz = ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx
        d = nx * p[0, 0] + ny * p[0, 1] + nz * p[0, 2]
        if d >= 0.0:
            continue
        left, right, top, bottom = _bounds(p, lens)
        zx, zy = nx / (d * fx), ny / (d * fy)
        z0 = nz / d - zx * cx - zy * cy
        start, end = max(math.ceil(left), 0), min(math.floor(right), width - 1)
        for y in range(max(math.ceil(top), 0), min(math.floor(bottom), height - 1) + 1):
            low, high = _ends(p, lens, y, float(start), float(end))
            base = z0 + zy * y
            for x in range(math.ceil(low), math.floor(high) + 1):
                inverse = base + zx * x
                if inverse > nearest[y, x] and inverse * near <= 1.0:
                    nearest[y, x] = inverse
                    owner[y, x] = first + t


@loop_kernel
def _ends(p: Floats, lens: Floats, y: int, low: float, high: float) -> tuple[float, float]:
    """From where to where a row of pixels lies within a triangle."""
    for i in range(3):
        j, k = (i + 1) % 3, (i + 2) % 3
        ex = (p[j, 1] * p[k, 2] - p[j, 2] * p[k, 1]) / lens[0]
        ey = (p[j, 2] * p[k, 0] - p[j, 0] * p[k, 2]) / lens[1]
        rest = p[j, 0] * p[k, 1] - p[j, 1] * p[k, 0] + ey * (y - lens[3])
        if ex > 0.0:
            high = min(high, lens[2] - rest / ex)
        elif ex < 0.0:
            low = max(low, lens[2] - rest / ex)
        elif rest > 0.0:
            high = low - 1.0
    return low, high


@loop_kernel
def _bounds(p: Floats, lens: Floats) -> tuple[float, float, float, float]:
    """The frame in the picture around the part of a triangle that is not too near."""
    left, right, top, bottom = np.inf, -np.inf, np.inf, -np.inf
    near = lens[4]
    for i in range(3):
        k = (i + 1) % 3
        if p[i, 2] >= near:
            x, y = lens[0] * p[i, 0] / p[i, 2] + lens[2], lens[1] * p[i, 1] / p[i, 2] + lens[3]
            left, right, top, bottom = min(left, x), max(right, x), min(top, y), max(bottom, y)
        if (p[i, 2] >= near) != (p[k, 2] >= near):
            s = (near - p[i, 2]) / (p[k, 2] - p[i, 2])
            x = lens[0] * (p[i, 0] + s * (p[k, 0] - p[i, 0])) / near + lens[2]
            y = lens[1] * (p[i, 1] + s * (p[k, 1] - p[i, 1])) / near + lens[3]
            left, right, top, bottom = min(left, x), max(right, x), min(top, y), max(bottom, y)
    return left - 1e-6, right + 1e-6, top - 1e-6, bottom + 1e-6


@loop_kernel
def paint(
    owner: npt.NDArray[np.int32],
    nearest: Depths,
    fields: Floats,
    skins: Ints,
    table: Ints,
    texels: Bytes,
    lens: Floats,
    colour: Bytes,
) -> None:
    """Colours every pixel that sees a triangle.

    Args:
        owner: (h, w) index of its triangle, negative where it sees none.
        nearest: (h, w) 1 / depth [1/m].
        fields: (n, 4, 4) rows: texture coordinates u and v in [0, 1] and brightness, each as a
            gradient [1/m] and an offset over the camera's frame; then the texels per metre.
        skins: (n,) which texture.
        table: (textures, levels, 3) first texel, width and height of each level.
        texels: (m, 3) of all textures, row by row.
        lens: (5,) fx, fy, cx, cy [pixel], nearest depth [m].
        colour: (h, w, 3) RGB; updated.
    """
    height, width = owner.shape
    for row in range(height):
        ry = (row - lens[3]) / lens[1]
        for column in range(width):
            t = owner[row, column]
            if t < 0:
                continue
            rx = (column - lens[2]) / lens[0]
            z = 1.0 / nearest[row, column]
            f = fields[t]
            u = (f[0, 0] * rx + f[0, 1] * ry + f[0, 2]) * z + f[0, 3]
            v = (f[1, 0] * rx + f[1, 1] * ry + f[1, 2]) * z + f[1, 3]
            bright = (f[2, 0] * rx + f[2, 1] * ry + f[2, 2]) * z + f[2, 3]
            texel = texel_at(table, texels, skins[t], u, v, f[3, 0] * z / lens[0])
            for c in range(3):
                colour[row, column, c] = int(min(max(texel[c] * bright, 0.0), 255.0))


@loop_kernel
def texel_at(
    table: Ints, texels: Bytes, skin: int, u: float, v: float, covered: float
) -> tuple[float, float, float]:
    """The colour of a texture at a place, from the level that suits how many texels a pixel covers.

    Args:
        table: (textures, levels, 3) first texel, width and height of each level.
        texels: (m, 3) of all textures, row by row.
        skin: which texture.
        u: from its left, in [0, 1].
        v: from its top, in [0, 1].
        covered: texels of the finest level along a pixel's edge.
    """
    covered, level = covered * SHARP, 0
    while covered > 1.0 and level < table.shape[1] - 1:
        covered, level = covered / 2, level + 1
    start, across, down = table[skin, level, 0], table[skin, level, 1], table[skin, level, 2]
    x = min(max(u * across - 0.5, 0.0), across - 1.0)
    y = min(max(v * down - 0.5, 0.0), down - 1.0)
    x0, y0 = int(x), int(y)
    sx, sy = x - x0, y - y0
    here = start + y0 * across + x0
    right = 1 if x0 + 1 < across else 0
    below = across if y0 + 1 < down else 0
    a, b, c, d = (1 - sx) * (1 - sy), sx * (1 - sy), (1 - sx) * sy, sx * sy
    i, j, k, m = here, here + right, here + below, here + below + right
    return (
        texels[i, 0] * a + texels[j, 0] * b + texels[k, 0] * c + texels[m, 0] * d,
        texels[i, 1] * a + texels[j, 1] * b + texels[k, 1] * c + texels[m, 1] * d,
        texels[i, 2] * a + texels[j, 2] * b + texels[k, 2] * c + texels[m, 2] * d,
    )
