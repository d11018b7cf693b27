"""How a depth picture errs, in numbers that a real and a simulated one can be compared by.

Taken once from a real frame and kept as `REAL`: one exposure of a stereo camera of the D435's kind
(depth in millimetres, registered to a colour picture of 640 x 480 with a focal length of 607
pixels), eleven cartons of about 0.26 x 0.17 x 0.11 m in two layers, seen from above at 1.55 to
1.75 m, each with a mask; one carton and the pallet beside them have none. Lengths in a picture are
in units of its focal length, for simulated pictures have other sizes; spreads are brought to 1.75 m
by the square of the range, as stereo errors grow.
"""

from dataclasses import dataclass

import cv2
import numpy as np
import numpy.typing as npt

Floats = npt.NDArray[np.float64]
Flags = npt.NDArray[np.bool_]

RANGE = 1.75
"""Spreads are told for this range [m]."""

MARGIN = 0.01
"""A face's spread is taken so far from its edge [focal length]."""

AROUND = 0.02
"""Holes count on the masks and up to so far around them [focal length]."""

REACH = 0.025
"""A depth step is looked at so far to either side of a mask's edge [focal length]."""

STEP = 0.1
"""Depth steps below this are not taken [m]."""

FEWEST = 50
"""A face with fewer measured pixels has no spread."""


@dataclass(frozen=True, slots=True)
class DepthStatistics:
    """How a depth picture errs.

    Attributes:
        spread: median over the faces of the standard deviation from a plane, at `RANGE` [m].
        holes: share without a depth on the faces and around them.
        edge: median width from 10 to 90 % of the depth steps around them [focal length].
    """

    spread: float
    holes: float
    edge: float


REAL = DepthStatistics(spread=0.00596, holes=0.00606, edge=0.01379)
"""Of the real frame, by this function. Simulated frames of severity normal hold them within a
quarter; where the real spread is below the 6 to 9 mm that are asked of them, those hold."""


def depth_statistics(depth: Floats, masks: list[Flags], focal: float) -> DepthStatistics:
    """Measures a depth picture.

    Args:
        depth: (h, w) along the optical axis [m]; 0 where nothing was measured.
        masks: (h, w) the pixels of one face each.
        focal: length [pixel].
    """
    together = np.any(masks, axis=0)
    size = 2 * round(AROUND * focal) + 1
    disc = cv2.getStructuringElement(cv2.MORPH_ELLIPSE, (size, size))
    around = cv2.dilate(together.astype(np.uint8), disc) > 0
    spreads = [spread for mask in masks for spread in _spread(depth, mask, focal)]
    reach = round(REACH * focal)
    widths = _step_widths(depth, together, reach) + _step_widths(depth.T, together.T, reach)
    return DepthStatistics(
        float(np.median(spreads)) if spreads else float("nan"),
        float((depth[around] <= 0.0).mean()),
        float(np.median(widths)) / focal if widths else float("nan"),
    )


def _spread(depth: Floats, mask: Flags, focal: float) -> list[float]:
    """The standard deviation from the plane of a face, in which 1 / depth is linear."""
    size = 2 * round(MARGIN * focal) + 1
    inner = cv2.erode(mask.astype(np.uint8), np.ones((size, size), dtype=np.uint8)) > 0
    y, x = np.nonzero(inner & (depth > 0.0))
    if len(y) < FEWEST:
        return []
    told = depth[y, x].astype(float)
    terms = np.column_stack((x, y, np.ones(len(x)))).astype(float)
    plane = 1.0 / (terms @ np.linalg.lstsq(terms, 1.0 / told, rcond=None)[0])
    return [float((told - plane).std() * (RANGE / plane.mean()) ** 2)]


def _step_widths(depth: Floats, mask: Flags, reach: int) -> list[float]:
    """Widths of the steps that rows show at a mask's edges, where no hole is in the way [pixel]."""
    widths, plateau = [], max(reach // 3, 1)
    rows, columns = np.nonzero(mask[:, 1:] != mask[:, :-1])
    for row, column in zip(rows.tolist(), columns.tolist(), strict=True):
        first, last = column - reach, column + reach + 1
        if first < 0 or last > depth.shape[1]:
            continue
        profile = depth[row, first:last].astype(float)
        if not mask[row, column]:
            profile = profile[::-1]
        low, high = np.median(profile[:plateau]), np.median(profile[-plateau:])
        if high - low >= STEP and (profile > 0.0).all():
            widths.append(_rise((profile - low) / (high - low)))
    return widths


def _rise(profile: Floats) -> float:
    """From where a profile leaves 0.1 for the last time to where it then reaches 0.9 [pixel]."""
    last = int(np.flatnonzero(profile >= 0.9).max())  # noqa: PLR2004 - of 10 to 90 %
    a = int(np.flatnonzero(profile[:last] <= 0.1).max(initial=0))  # noqa: PLR2004
    b = a + int(np.flatnonzero(profile[a:] >= 0.9).min())  # noqa: PLR2004
    start = a + (0.1 - profile[a]) / (profile[a + 1] - profile[a])
    end = b - (profile[b] - 0.9) / (profile[b] - profile[b - 1])
    return float(end - start)
