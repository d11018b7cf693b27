"""Where labels are: white and alike on all products, so nothing there tells one from another.

Boxes that the cell can read carry their label in the middle of a side's width and a little below
its middle: there the reader looks, and there this folder does not.
"""

import math

import numpy as np
import numpy.typing as npt

EDGE = 0.006
"""Labels keep so far off the edges of their side [m]."""

WIDEST, TALLEST = 0.095, 0.055
SMALLEST = 0.025
LOWER = 0.03
"""A label's middle is up to so far below the middle of its side [m]."""

SLACK = 0.006
"""Label and print sit so exactly to each other [m]."""


def without_label(
    shape: tuple[int, int], step: float, size: tuple[float, float]
) -> npt.NDArray[np.float32]:
    """(h, w) 1 where a picture of an upright side shows the side, 0 where its label may be.

    Args:
        shape: height and width of the picture, the side in its middle [pixel].
        step: edge of a pixel [m].
        size: width and height of the side [m].
    """
    weights = np.ones(shape, dtype=np.float32)
    place = _place(*size)
    if place is not None:
        x0, y0 = shape[1] / 2 - size[0] / 2 / step, shape[0] / 2 - size[1] / 2 / step
        left, top, right, bottom = (edge / step for edge in place)
        rows = slice(max(int(y0 + top), 0), int(y0 + bottom) + 1)
        weights[rows, max(int(x0 + left), 0) : int(x0 + right) + 1] = 0.0
    return weights


def inside(
    shape: tuple[int, int], step: float, size: tuple[float, float], edge: float
) -> npt.NDArray[np.float32]:
    """(h, w) 1 where a picture shows the inner part of a face, 0 at its edges and beside it.

    Args:
        shape: height and width of the picture, the face in its middle [pixel].
        step: edge of a pixel [m].
        size: width and height of the face [m].
        edge: what is nearer to the face's edges is left out [m].
    """
    weights = np.zeros(shape, dtype=np.float32)
    across, down = (
        math.floor((pixels - (length - 2 * edge) / step) / 2 + 1)
        for pixels, length in zip(shape[::-1], size, strict=True)
    )
    weights[down : shape[0] - down, across : shape[1] - across] = 1.0
    return weights


def label_ends(width: float, height: float) -> float:
    """How far down a side its label may reach, as a share of the side's height.

    Args:
        width: of the side [m].
        height: of the side [m].
    """
    place = _place(width, height)
    return 0.0 if place is None else min(place[3] / height, 1.0)


def _place(width: float, height: float) -> tuple[float, float, float, float] | None:
    """Left, top, right and bottom of where a label may be [m]; None where none fits."""
    tall, wide = min(height - 2 * EDGE, TALLEST), min(width - 2 * EDGE, WIDEST)
    if tall < SMALLEST:
        return None
    below = height / 2 + min((height - tall) / 2 - EDGE, LOWER)
    (top, bottom), (left, right) = (
        (middle - edge / 2 - SLACK, middle + edge / 2 + SLACK)
        for middle, edge in ((below, tall), (width / 2, wide))
    )
    return left, top, right, bottom
