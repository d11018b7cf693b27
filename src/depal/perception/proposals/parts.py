"""Whether a rectangle is rather two faces side by side. Pixels are those of a turned raster."""

import numpy as np
import numpy.typing as npt

from depal.geometry import loop_kernel
from depal.perception.proposals.kernels import weakest_third

Floats = npt.NDArray[np.float64]
Ints = npt.NDArray[np.int64]

COVERED = 0.5
"""Behind a side beyond which so much is nearer a face may go on."""

LEAST = 0.6
"""So much of a face that goes on behind something must be seen."""


@loop_kernel
def _fits(seen: float, edge: float, slack: float, covered: float) -> bool:
    """Whether an edge is what is seen, or goes on where something covers it."""
    if abs(edge - seen) <= slack:
        return True
    return covered > COVERED and LEAST * edge <= seen < edge


@loop_kernel
def seams_between(
    rows: Floats, columns: Floats, rectangles: Ints, sizes: Floats, slack: float, out: Floats
) -> None:
    """The strongest line that divides a rectangle into two of expected sizes.

    Args:
        rows: (h, w + 1) running sums of the evidence of level edges along rows.
        columns: (w, h + 1) running sums of the evidence of upright edges along columns.
        rectangles: (n, 4) left, top, right, bottom [pixel].
        sizes: (m, 2) widths and heights of faces that are expected [pixel].
        slack: a part is as large as an expected face where both edges differ by no more [pixel].
        out: (n, >= 26); 22-25 as `surfaces.covers` writes them; written: 21 the mean
            evidence along the weakest third of that line; 0 where there is none.
    """
    for n in range(rectangles.shape[0]):
        best = 0.0
        for way in range(2):
            sums = columns if way == 0 else rows
            low, high = rectangles[n, way], rectangles[n, way + 2]
            first, last = rectangles[n, 1 - way], rectangles[n, 3 - way]
            covered = max(out[n, 23 - way], out[n, 25 - way])
            for i in range(sizes.shape[0]):
                if not _fits(last - first, sizes[i, 1 - way], slack, covered):
                    continue
                for j in range(sizes.shape[0]):
                    if not _fits(last - first, sizes[j, 1 - way], slack, covered):
                        continue
                    # Both parts as large as expected, each but for the slack.
                    start = max(low + sizes[i, way] - slack, high - sizes[j, way] - slack)
                    end = min(low + sizes[i, way] + slack, high - sizes[j, way] + slack)
                    for line in range(int(np.ceil(start)), int(np.floor(end)) + 1):
                        if low < line < high:
                            best = max(best, weakest_third(sums, line, first, last))
        out[n, 21] = best
