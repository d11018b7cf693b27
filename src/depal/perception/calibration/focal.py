"""Whether markers are out of place because the focal length is another one."""

import math
from collections.abc import Iterable

import numpy as np
import numpy.typing as npt
from scipy.optimize import least_squares
from scipy.spatial.transform import Rotation

from depal.domain import Fiducial
from depal.geometry import Matrix3, Pose
from depal.perception.calibration.calibration import Calibration
from depal.perception.calibration.checking import MarkerCheck, room_among
from depal.perception.calibration.solving import Sighted, misplaced, rms, shifted, sighted

Floats = npt.NDArray[np.float64]

OTHER = 0.01
"""A focal length that differs by a greater share is another one."""

BETTER = 3.0
"""Another focal length must fit the markers so many times better."""


def focal_by_markers(
    k: Matrix3, fiducials: Iterable[Fiducial], calibration: Calibration, seen: MarkerCheck
) -> float | None:
    """The focal length that explains markers which are out of place.

    Args:
        k: intrinsics that the colour picture came with.
        fiducials: all of the cell.
        calibration: what is known of the camera.
        seen: what the look found.

    Returns:
        The focal length [pixel]; None where a camera that has moved explains as much.
    """
    markers = tuple(fiducials)
    corners, known = sighted(markers, [seen.seen]), calibration.cell_from_camera
    if seen.cell_from_camera is None:
        return None
    pose, factor = _with_focal(corners, k, seen.cell_from_camera)
    (fx, _, cx), (_, fy, cy), last = k
    other: Matrix3 = ((fx * factor, 0.0, cx), (0.0, fy * factor, cy), last)
    room = room_among(markers)
    moved = float(shifted(room, seen.cell_from_camera, known).max())
    before = rms(misplaced(corners, k, seen.cell_from_camera))
    fits = rms(misplaced(corners, other, pose)) * BETTER < before
    stays = float(shifted(room, pose, known).max()) < moved / 2
    return fx * factor if abs(factor - 1.0) > OTHER and fits and stays else None


def _with_focal(corners: Sighted, k: Matrix3, near: Pose) -> tuple[Pose, float]:
    """The pose and the factor of the focal length that fit best."""
    start = near.inverse
    turn, shift = np.array(start.rotation), np.array(start.translation)
    base = corners.points @ turn.T + shift
    focal, centre = np.array((k[0][0], k[1][1])), np.array((k[0][2], k[1][2]))

    def apart(step: Floats) -> Floats:
        moved = base @ Rotation.from_rotvec(step[:3]).as_matrix().T + step[3:6]
        seen = focal * math.exp(step[6]) * moved[:, :2] / np.maximum(moved[:, 2:], 1e-6) + centre
        return np.asarray((seen - corners.pixels).ravel())

    best = least_squares(apart, np.zeros(7), x_scale=1e-3, loss="soft_l1")
    more = Rotation.from_rotvec(best.x[:3]).as_matrix()
    pose = Pose.from_arrays(more @ shift + best.x[3:6], more @ turn).inverse
    return pose, math.exp(float(best.x[6]))
