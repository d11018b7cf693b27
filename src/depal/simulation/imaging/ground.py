"""Shadows of what moves on what is still: the still pixels are found once."""

from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from depal.geometry import loop_kernel

Floats = npt.NDArray[np.float64]
Bytes = npt.NDArray[np.uint8]

SPREAD = 1
"""An edge of a shadow is soft over so many of the light's pixels, to either side."""


class Ground(NamedTuple):
    """Pixels of the still things on which shadows of the moving ones can fall.

    Attributes:
        pixels: (n,) place in the picture, row by row.
        places: (n,) place in the light's picture, row by row.
        limits: (n,) what is nearer to the light than this 1 / depth throws a shadow [1/m].
        kept: (n,) share of the brightness that is left in the shadow.
    """

    pixels: npt.NDArray[np.int32]
    places: npt.NDArray[np.int32]
    limits: npt.NDArray[np.float32]
    kept: npt.NDArray[np.float32]


@loop_kernel
def find_ground(
    owner: npt.NDArray[np.int32],
    nearest: npt.NDArray[np.float32],
    kept: Floats,
    lenses: Floats,
    carried: Floats,
    side: int,
    ground: Ground,
) -> int:
    """Fills in where shadows can fall.

    Args:
        owner: (h, w) index of each pixel's triangle, negative for none.
        nearest: (h, w) 1 / depth [1/m].
        kept: (n, 2) as of a `Sun`.
        lenses: (2, 5) values of the viewer's lens and of the light's.
        carried: (3, 4) from the viewer's frame to the light's.
        side: of the light's picture [pixel].
        ground: with room for every pixel; filled.

    Returns:
        How many pixels were filled in.
    """
    height, width = owner.shape
    a, s, m, count = lenses[0], lenses[1], carried, 0
    for row in range(height):
        ry = (row - a[3]) / a[1]
        for column in range(width):
            t = owner[row, column]
            if t < 0 or kept[t, 0] > 0.999:  # noqa: PLR2004
                continue
            rx, z = (column - a[2]) / a[0], 1.0 / nearest[row, column]
            d = (m[2, 0] * rx + m[2, 1] * ry + m[2, 2]) * z + m[2, 3]
            x = (m[0, 0] * rx + m[0, 1] * ry + m[0, 2]) * z + m[0, 3]
            y = (m[1, 0] * rx + m[1, 1] * ry + m[1, 2]) * z + m[1, 3]
            u, v = int(s[0] * x / d + s[2] + 0.5), int(s[1] * y / d + s[3] + 0.5)
            if u < SPREAD or v < SPREAD or u >= side - SPREAD or v >= side - SPREAD:
                continue
            ground.pixels[count] = row * width + column
            ground.places[count] = v * side + u
            ground.limits[count] = 1.0 / (d - kept[t, 1])
            ground.kept[count] = kept[t, 0]
            count += 1
    return count


@loop_kernel
def shade_ground(
    ground: Ground,
    owner: npt.NDArray[np.int32],
    first: int,
    nearest: Floats,
    most: Floats,
    bare: Bytes,
    colour: Bytes,
) -> None:
    """Lets the shadows of what moves fall on what is still.

    Args:
        ground: where they can fall.
        owner: (h w,) index of each pixel's triangle.
        first: triangles before this one are still.
        nearest: (side, side) 1 / depth from the light of all things [1/m].
        most: (side side,) its greatest value around each pixel.
        bare: (h w, 3) the still triangles without shadows.
        colour: (h w, 3) the picture; updated.
    """
    side = nearest.shape[0]
    for n in range(ground.pixels.shape[0]):
        at = ground.places[n]
        limit = ground.limits[n]
        if most[at] <= limit:
            continue
        pixel = ground.pixels[n]
        if owner[pixel] >= first:
            continue
        hidden, v, u = 0, at // side, at % side
        for j in range(v - SPREAD, v + SPREAD + 1):
            for i in range(u - SPREAD, u + SPREAD + 1):
                hidden += nearest[j, i] > limit
        left = 1.0 - (1.0 - ground.kept[n]) * hidden / (2 * SPREAD + 1) ** 2
        for c in range(3):
            colour[pixel, c] = int(bare[pixel, c] * left)
