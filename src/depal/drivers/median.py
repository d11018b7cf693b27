"""One depth picture from several exposures."""

import numpy as np
import numpy.typing as npt

Counts = npt.NDArray[np.uint16]

_NONE = np.uint16(0xFFFF)


def temporal_median(depths: Counts) -> Counts:
    """The middle of what each pixel measured.

    Args:
        depths: (n, h, w) counts; 0 where nothing was measured.

    Returns:
        (h, w): the lower median of a pixel's measurements; 0 where fewer than half of the
        exposures measured anything.
    """
    count, height, width = depths.shape
    each = np.ascontiguousarray(depths.reshape(count, -1).T)
    measured = np.count_nonzero(each, axis=1)
    each[each == 0] = _NONE
    each.sort(axis=1)
    middle = np.maximum(measured - 1, 0) // 2
    found = np.take_along_axis(each, middle[:, None], axis=1)[:, 0]
    return np.where(2 * measured >= count, found, 0).astype(np.uint16).reshape(height, width)
