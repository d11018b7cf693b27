"""The loop that adds up a strip along slanted lines."""

import math

import numpy as np
import numpy.typing as npt

from depal.geometry import loop_kernel

Narrow = npt.NDArray[np.float32]
Floats = npt.NDArray[np.float64]


@loop_kernel
def profiles(strip: Narrow, known: npt.NDArray[np.bool_], slopes: Floats, out: Floats) -> None:
    """The mean of a strip along lines of several slopes.

    Args:
        strip: (n, m, c) n places along an edge, m across.
        known: (n, m).
        slopes: (k,) how far a line moves across for each step along.
        out: (k, m, c) mean along the line that crosses the strip's middle at each place across;
            nan where less than a third of the line is known; written.
    """
    n, m, channels = strip.shape
    for k in range(slopes.shape[0]):
        for j in range(m):
            seen = 0
            for c in range(channels):
                out[k, j, c] = 0.0
            for i in range(n):
                at = j + slopes[k] * (i - (n - 1) / 2)
                low = math.floor(at)
                if low < 0 or low + 1 >= m or not known[i, low] or not known[i, low + 1]:
                    continue
                part = at - low
                seen += 1
                for c in range(channels):
                    out[k, j, c] += (1.0 - part) * strip[i, low, c] + part * strip[i, low + 1, c]
            for c in range(channels):
                out[k, j, c] = out[k, j, c] / seen if 3 * seen > n else np.nan
