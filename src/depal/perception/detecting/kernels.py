"""The loop over candidates and prints."""

import numpy as np
import numpy.typing as npt

from depal.geometry import loop_kernel

Floats = npt.NDArray[np.float64]


@loop_kernel
def agreeing(values: Floats, printed: Floats, scores: Floats, near: float, out: Floats) -> None:
    """How well the places of prints agree with candidates.

    Args:
        values: (n, 6) of candidates: u, v, width, height [m], turn [rad], depth [m].
        printed: (m, 6) of the prints' places.
        scores: (m,) of the prints.
        near: a print belongs to a candidate whose sides are all within this of its own [m].
        out: (n, m) the print's score where it lies on the candidate, less the farther off; -1
            where it does not; written.
    """
    for n in range(values.shape[0]):
        for m in range(printed.shape[0]):
            out[n, m] = -1.0
            wide, high = abs(values[n, 2] - printed[m, 2]), abs(values[n, 3] - printed[m, 3])
            along = abs(values[n, 0] - printed[m, 0]) + wide / 2
            across = abs(values[n, 1] - printed[m, 1]) + high / 2
            turned = abs(values[n, 4] - printed[m, 4]) * (values[n, 2] + values[n, 3]) / 4
            away = max(along, across) + turned
            if away < near:
                out[n, m] = scores[m] * (1.0 - 0.5 * away / near)
