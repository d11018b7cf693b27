"""The loop that colours a camera's picture: print, wear, film, light and shadow in one pass."""

import math
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from depal.geometry import loop_kernel
from depal.simulation.imaging.kernels import texel_at
from depal.simulation.imaging.wear import Worn

Floats = npt.NDArray[np.float64]
Ints = npt.NDArray[np.int64]
Bytes = npt.NDArray[np.uint8]

SPREAD = 1
"""An edge of a shadow is soft over so many of the light's pixels, to either side."""

DARK, FOLD = 0.28, 0.0016
"""Prints are darker at their edges by this share, which falls off over this length [m]."""

SHINE = 246.0
"""The value of film that shines fully."""

# As in `wear.MARKS`: kernels take numbers from their own module only.
OFFSET, TAPE, SCUFFS, FILM, CREASE, WIDTH, HEIGHT = 3, 6, 15, 27, 29, 16, 17
SCUFF_COUNT, FILM_STEP, TILE = 3, 0.004, 512


class Looks(NamedTuple):
    """How triangles look.

    Attributes:
        fields: (n, 4, 4) as `kernels.paint` takes them.
        skins: (n,) which texture.
        faces: (n,) which row of the wear, negative for none.
        table: of the atlas.
        texels: of the atlas.
        lens: (5,) values of the lens.
        gains: (3,) of red, green, blue.
    """

    fields: Floats
    skins: Ints
    faces: Ints
    table: Ints
    texels: Bytes
    lens: Floats
    gains: Floats


class Sun(NamedTuple):
    """Where the light falls.

    Attributes:
        lens: (5,) values of the light's lens.
        carried: (3, 4) from the camera's frame to the light's.
        nearest: (side, side) 1 / depth from the light [1/m].
        most: (side, side) its greatest value around each pixel.
        kept: (m, 2) the share of its brightness that a moving triangle keeps in the shadow, and how
            far behind the first surface it is lit [m].
    """

    lens: Floats
    carried: Floats
    nearest: Floats
    most: Floats
    kept: Floats


@loop_kernel
def expose(
    owner: npt.NDArray[np.int32],
    nearest: npt.NDArray[np.float32],
    region: Ints,
    first: int,
    looks: Looks,
    sun: Sun,
    worn: Worn,
    colour: Bytes,
) -> None:
    """Colours every pixel that sees something that moves.

    Args:
        owner: (h, w) index of its triangle, negative where it sees none.
        nearest: (h, w) 1 / depth [1/m].
        region: (4,) first and last row, first and last column that are looked at.
        first: triangles before this one are still, and painted.
        looks: of the triangles from `first` on.
        sun: for shadows, of the triangles from `first` on.
        worn: the wear of the boxes.
        colour: (h, w, 3) the still triangles; updated.
    """
    lens = looks.lens
    for row in range(region[0], region[1] + 1):
        ry = (row - lens[3]) / lens[1]
        for column in range(region[2], region[3] + 1):
            k = owner[row, column] - first
            if k < 0:
                continue
            rx, z = (column - lens[2]) / lens[0], 1.0 / nearest[row, column]
            f = looks.fields[k]
            u = (f[0, 0] * rx + f[0, 1] * ry + f[0, 2]) * z + f[0, 3]
            v = (f[1, 0] * rx + f[1, 1] * ry + f[1, 2]) * z + f[1, 3]
            bright = (f[2, 0] * rx + f[2, 1] * ry + f[2, 2]) * z + f[2, 3]
            bright *= shadow(sun, k, rx, ry, z)
            covered = f[3, 0] * z / lens[0]
            texel = texel_at(looks.table, looks.texels, looks.skins[k], u, v, covered)
            face = looks.faces[k]
            if face < 0:
                for c in range(3):
                    value = texel[c] * bright * looks.gains[c]
                    colour[row, column, c] = int(min(max(value, 0.0), 255.0))
                continue
            at = (rx, ry, z)
            worn_pixel(worn, face, at, texel, bright, looks.gains, colour[row, column])


@loop_kernel
def shadow(sun: Sun, t: int, rx: float, ry: float, z: float) -> float:
    """What a shadow leaves of a pixel's brightness, 1 where none falls."""
    if sun.kept[t, 0] > 0.999:  # noqa: PLR2004
        return 1.0
    m, s, side = sun.carried, sun.lens, sun.nearest.shape[0]
    d = (m[2, 0] * rx + m[2, 1] * ry + m[2, 2]) * z + m[2, 3]
    x = (m[0, 0] * rx + m[0, 1] * ry + m[0, 2]) * z + m[0, 3]
    y = (m[1, 0] * rx + m[1, 1] * ry + m[1, 2]) * z + m[1, 3]
    u, v = int(s[0] * x / d + s[2] + 0.5), int(s[1] * y / d + s[3] + 0.5)
    if u < SPREAD or v < SPREAD or u >= side - SPREAD or v >= side - SPREAD:
        return 1.0
    limit, hidden = 1.0 / (d - sun.kept[t, 1]), 0
    if sun.most[v, u] <= limit:
        return 1.0
    for j in range(v - SPREAD, v + SPREAD + 1):
        for i in range(u - SPREAD, u + SPREAD + 1):
            hidden += sun.nearest[j, i] > limit
    return float(1.0 - (1.0 - sun.kept[t, 0]) * hidden / (2 * SPREAD + 1) ** 2)


@loop_kernel
def place(frames: Floats, face: int, at: int, rx: float, ry: float, z: float) -> float:
    """One of a face's coordinates at a pixel [m]."""
    return float(
        (frames[face, at] * rx + frames[face, at + 1] * ry + frames[face, at + 2]) * z
        + frames[face, at + 3]
    )


@loop_kernel
def film_at(worn: Worn, face: int, rx: float, ry: float, z: float) -> float:
    """How strongly film shines at a pixel, 0 .. 1."""
    strength = worn.marks[face, FILM]
    if strength <= 0.0:
        return 0.0
    x = place(worn.frames, face, 8, rx, ry, z) / FILM_STEP + 4 * TILE
    y = place(worn.frames, face, 12, rx, ry, z) / FILM_STEP + 4 * TILE
    x0, y0 = int(x), int(y)
    a, b = x - x0, y - y0
    x0, y0 = x0 % TILE, y0 % TILE
    x1, y1 = (x0 + 1) % TILE, (y0 + 1) % TILE
    upper = worn.film[y0, x0] * (1 - a) + worn.film[y0, x1] * a
    lower = worn.film[y1, x0] * (1 - a) + worn.film[y1, x1] * a
    return float((upper * (1 - b) + lower * b) / 255.0 * strength)


@loop_kernel
def worn_pixel(
    worn: Worn,
    face: int,
    at: tuple[float, float, float],
    texel: tuple[float, float, float],
    bright: float,
    gains: Floats,
    out: Bytes,
) -> None:
    """The colour of a pixel of a box.

    Args:
        worn: the wear.
        face: its row.
        at: the pixel's ray (x, y, 1) as x and y, and its depth [m].
        texel: what is printed there.
        bright: the light on it.
        gains: (3,) of red, green, blue.
        out: (3,) filled.
    """
    rx, ry, z = at
    marks = worn.marks[face]
    s, t = place(worn.frames, face, 0, rx, ry, z), place(worn.frames, face, 4, rx, ry, z)
    tape, light = 0.0, 0.0
    if marks[TAPE + 5] > 0.0:
        across, along = (s, t) if marks[TAPE] > 0.0 else (t, s)
        on = abs(across - marks[TAPE + 1]) <= marks[TAPE + 2]
        if on and marks[TAPE + 3] <= along <= marks[TAPE + 4]:
            tape = marks[TAPE + 5]
    for n in range(SCUFF_COUNT):
        k = SCUFFS + 4 * n
        radius = marks[k + 2]
        if radius <= 0.0:
            break
        ds, dt = s - marks[k], (t - marks[k + 1]) * 2.0
        apart = (ds * ds + dt * dt) / (radius * radius)
        if apart < 1.0:
            light = marks[k + 3] * (1.0 - apart * apart)
    inward = min(s, worn.frames[face, WIDTH] - s, t, worn.frames[face, HEIGHT] - t)
    if inward < 4 * FOLD:
        edge = DARK * math.exp(-max(inward, 0.0) / FOLD)
        bright *= (1.0 - edge * marks[CREASE]) / (1.0 - edge)
    film = film_at(worn, face, rx, ry, z)
    for c in range(3):
        value = texel[c] * marks[c] + marks[OFFSET + c]
        value += (marks[TAPE + 6 + c] - value) * tape
        value += (235.0 - value if light > 0.0 else value - 40.0) * light
        value = value * bright
        value = (value + (SHINE - value) * film) * gains[c]
        out[c] = int(min(max(value, 0.0), 255.0))
