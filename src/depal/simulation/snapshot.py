"""Where everything in the world is at one moment."""

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

Floats = npt.NDArray[np.float64]


@dataclass(frozen=True, slots=True, eq=False)
class Snapshot:
    """Where everything is, for pictures.

    Attributes:
        at: when [s].
        arm: (8, 7) base, links 1 to 6 and the tool: position [m] and quaternion (w, x, y, z).
        boxes: (n, 7) the same of the boxes.
        folded: whether the lower module is up.
        held: boxes in the hand.
        removed: boxes that people took away.
        bays: the trolley that stands in each bay.
    """

    at: float
    arm: Floats
    boxes: Floats
    folded: bool
    held: tuple[int, ...]
    removed: tuple[int, ...]
    bays: dict[str, str | None]
