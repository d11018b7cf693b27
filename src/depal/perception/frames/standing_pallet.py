"""Whether a pallet stands where one is expected, by depth alone."""

from collections.abc import Iterator

import numpy as np
import numpy.typing as npt

from depal.domain import PalletStand
from depal.geometry import Pose
from depal.perception.calibration.finding import projected
from depal.ports import Frame

Floats = npt.NDArray[np.float64]

STEP = 0.02
"""Points on the pallet are so far apart [m]."""

LOWEST = 0.035
"""Of the front, what is nearer to the floor can hardly be told from it [m]."""

NEAR = 0.04
"""What is seen within this of the front is the front [m]."""

LEAST_FRONT = 0.25
"""Of the front that nothing hides, so much is wood; a Euro pallet has half of it."""

STEEPEST = 0.26
"""A plane is looked at when the cosine between its normal and the sight is greater."""

HIGH = 1.0
"""A camera so far above the deck looks at it from above [m]."""

MOST_FLOOR = 0.6
"""A deck through whose place a greater share shows the floor is not there; a Euro pallet's gaps
are a fifth."""

FEWEST = 60
"""So many points give an answer."""


def pallet_problems(frame: Frame, stand: PalletStand) -> Iterator[str]:
    """What is missing of the pallet's front, or of its deck as seen from above.

    Args:
        frame: with true depths and the camera's pose.
        stand: where the pallet is expected.
    """
    length, width, deck = stand.size
    height = stand.cell_from_pallet.translation[2]
    front = _grid(length, deck - LOWEST)
    front = np.column_stack((front[:, 0], np.zeros(len(front)), -front[:, 1]))
    apart = _behind(frame, stand.cell_from_pallet, front, (0.0, -1.0, 0.0))
    open_to_see = apart[apart > -NEAR]
    if len(open_to_see) >= FEWEST:
        share = float(np.mean(open_to_see < NEAR))
        if share < LEAST_FRONT:
            yield (
                f"pallet: {100 * share:.0f} % of its front edge is where it should be, "
                f"expected {100 * LEAST_FRONT:.0f} % or more"
            )
    if frame.cell_from_camera.translation[2] < height + HIGH:
        return
    flat = _grid(length, width)
    flat = np.column_stack((flat, np.zeros(len(flat))))
    apart = _behind(frame, stand.cell_from_pallet, flat, (0.0, 0.0, 1.0))
    if len(apart) >= FEWEST:
        floor = float(np.mean(apart > deck / 2))
        if floor > MOST_FLOOR:
            yield (
                f"pallet: {100 * floor:.0f} % of the place of its deck shows the floor, "
                f"expected at most {100 * MOST_FLOOR:.0f} %"
            )


def _grid(across: float, down: float) -> Floats:
    """Points within a rectangle from the origin: (n, 2) [m]."""
    x = np.arange(STEP / 2, across, STEP)
    y = np.arange(STEP / 2, down, STEP)
    return np.stack(np.meshgrid(x, y), axis=-1).reshape(-1, 2)


def _behind(
    frame: Frame, cell_from_pallet: Pose, points: Floats, outward: tuple[float, float, float]
) -> Floats:
    """How far behind points of a plane the first surface is, where it was measured: (m,) [m]."""
    turn = np.array(cell_from_pallet.rotation)
    there = points @ turn.T + np.array(cell_from_pallet.translation)
    way = np.array(frame.cell_from_camera.translation) - there
    facing = way @ (turn @ np.array(outward)) > STEEPEST * np.linalg.norm(way, axis=1)
    at = projected(there[facing], frame.depth_k, frame.cell_from_camera)
    measured = _sampled(frame.depth, at)
    known = measured > 0.0
    return np.asarray(measured[known] - at[known, 2])


def _sampled(depth: npt.NDArray[np.float32], at: Floats) -> Floats:
    """Depths at pixels, 0 outside of the picture."""
    height, width = depth.shape
    column, row = np.rint(at[:, 0]).astype(int), np.rint(at[:, 1]).astype(int)
    inside = (column >= 0) & (column < width) & (row >= 0) & (row < height) & (at[:, 2] > 0.0)
    found = np.zeros(len(at))
    found[inside] = depth[row[inside], column[inside]]
    return found
