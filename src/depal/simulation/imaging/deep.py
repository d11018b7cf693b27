"""The loop that finds true disparities and what the second lens cannot see."""

import numpy as np
import numpy.typing as npt

from depal.geometry import loop_kernel
from depal.simulation.imaging.exposure import film_at, place
from depal.simulation.imaging.wear import Worn

Floats = npt.NDArray[np.float64]
Ints = npt.NDArray[np.int64]

# As in `wear.MARKS`: kernels take numbers from their own module only.
BULGE, WIDTH, HEIGHT = 28, 16, 17


@loop_kernel
def disparities(
    owner: npt.NDArray[np.int32],
    planes: Floats,
    faces: Ints,
    worn: Worn,
    lens: Floats,
    limits: Floats,
    disparity: npt.NDArray[np.float32],
    holes: npt.NDArray[np.bool_],
) -> None:
    """Disparities of the pixels' triangles, from each row's right to its left.

    What the second lens, to the right, does not see lies behind something to the right of it.

    Args:
        owner: (h, w) index of the triangle, negative where nothing stands.
        planes: (n, 3) whose product with a ray (x, y, 1) is 1 / depth [1/m].
        faces: (n,) which row of the wear, negative for none.
        worn: the wear: bulging faces, film.
        lens: (5,) values of the lens.
        limits: (3,) disparity times depth [pixel m]; cosine of the flattest sight; greatest shine.
        disparity: (h, w) [pixel]; filled, 0 where nothing stands.
        holes: (h, w) what is not measured; filled.
    """
    height, width = owner.shape
    for row in range(height):
        ry, first = (row - lens[3]) / lens[1], np.inf
        for column in range(width - 1, -1, -1):
            t = owner[row, column]
            if t < 0:
                disparity[row, column], holes[row, column] = 0.0, True
                continue
            rx = (column - lens[2]) / lens[0]
            a, b, c = planes[t, 0], planes[t, 1], planes[t, 2]
            inverse, steep = a * rx + b * ry + c, np.sqrt(a * a + b * b + c * c)
            hole = inverse < limits[1] * steep * np.sqrt(rx * rx + ry * ry + 1.0)
            face = faces[t]
            if face >= 0:
                z = 1.0 / max(inverse, 1e-6)
                out = bulged(worn, face, rx, ry, z)
                inverse = inverse / (1.0 - out * steep)
                hole = hole or film_at(worn, face, rx, ry, z) > limits[2]
            pixels = inverse * limits[0]
            there = column - pixels
            hole = hole or there >= first
            first = min(first, there)
            disparity[row, column], holes[row, column] = pixels, hole


@loop_kernel
def bulged(worn: Worn, face: int, rx: float, ry: float, z: float) -> float:
    """How far a face stands out at a pixel [m]."""
    most = worn.marks[face, BULGE]
    if most <= 0.0:
        return 0.0
    s, t = place(worn.frames, face, 0, rx, ry, z), place(worn.frames, face, 4, rx, ry, z)
    a, b = 2.0 * s / worn.frames[face, WIDTH] - 1.0, 2.0 * t / worn.frames[face, HEIGHT] - 1.0
    return float(most * max(1.0 - a * a, 0.0) * max(1.0 - b * b, 0.0))
