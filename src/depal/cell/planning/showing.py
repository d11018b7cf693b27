"""Where a held box is shown to the reader, side by side."""

from collections.abc import Iterator

import numpy as np
import numpy.typing as npt

from depal.cell.planning.plans import Load
from depal.domain import Approach, ReaderMount
from depal.geometry import Pose, Vector3

Floats = npt.NDArray[np.float64]

COVERED = 0.7
"""A side whose normal points against the cups' is under them."""


def shown_poses(load: Load, reader: ReaderMount) -> Iterator[tuple[int, Pose]]:
    """Poses of the flange that show an upright side of the box to the reader.

    The side faces the lens at the reader's distance, the box upright; the side under the cups is
    left out.

    Args:
        load: the held box.
        reader: where it looks.

    Yields:
        The number of the side and `cell_from_flange`.
    """
    under = cup_side(load)
    for side in range(4):
        normal = np.zeros(3)
        normal[side % 2] = 1.0 if side < 2 else -1.0  # noqa: PLR2004 - x, y, -x, -y
        if float(normal @ under) > COVERED:
            continue
        yield side, before_lens(reader, load.size, normal) @ load.grasp.box_from_flange


def before_lens(reader: ReaderMount, size: Vector3, normal: Floats) -> Pose:
    """`cell_from_box` of an upright box, the middle of one side where the lens sees it best.

    Args:
        reader: where it looks.
        size: of the box [m].
        normal: (3,) of the side, in the box's frame.
    """
    sight = np.array(reader.cell_from_reader.rotation)[:, 2]
    lens = np.array(reader.cell_from_reader.translation)
    toward = -sight
    toward[2] = 0.0
    toward /= np.linalg.norm(toward)
    yaw = np.arctan2(toward[1], toward[0]) - np.arctan2(normal[1], normal[0])
    turn = Pose.from_yaw((0.0, 0.0, 0.0), float(yaw))
    half = float(np.abs(normal) @ np.array(size)) / 2
    centre = lens + sight * reader.distance - toward * half
    return Pose.from_arrays(centre, turn.rotation)


def cup_side(load: Load) -> Floats:
    """The outward normal of the side under the cups, in the box's frame; zero for the top."""
    normal = np.zeros(3)
    if load.grasp.approach is Approach.HORIZONTAL:
        x, y, _ = load.grasp.box_from_flange.translation
        axis = int(abs(y) - load.size[1] / 2 > abs(x) - load.size[0] / 2)
        normal[axis] = 1.0 if (x, y)[axis] > 0 else -1.0
    return normal
