"""Where labels are: white and alike on all products, so nothing there tells one from another.

Boxes that the cell can read carry their label in the middle of a side's width and a little below
its middle: there the reader looks, and there this folder does not.
"""

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


def without_label(shape: tuple[int, int], step: float) -> npt.NDArray[np.float32]:
    """(h, w) 1 where a picture of an upright side shows the side, 0 where its label may be.

    Args:
        shape: height and width of the picture, which shows the whole side [pixel].
        step: edge of a pixel [m].
    """
    height, width = shape[0] * step, shape[1] * step
    weights = np.ones(shape, dtype=np.float32)
    tall = min(height - 2 * EDGE, TALLEST)
    wide = min(width - 2 * EDGE, WIDEST)
    if tall < SMALLEST:
        return weights
    below = height / 2 + min((height - tall) / 2 - EDGE, LOWER)
    top, bottom = ((below + way * (tall / 2 + SLACK)) / step for way in (-1, 1))
    left, right = ((width / 2 + way * (wide / 2 + SLACK)) / step for way in (-1, 1))
    weights[max(int(top), 0) : int(bottom) + 1, max(int(left), 0) : int(right) + 1] = 0.0
    return weights
