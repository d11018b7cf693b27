"""The pose of a camera from markers that it sees."""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass

import cv2
import numpy as np
import numpy.typing as npt
from scipy.optimize import least_squares
from scipy.spatial.transform import Rotation

from depal.domain import Fiducial
from depal.geometry import Matrix3, Pose
from depal.perception.calibration.finding import Found, corners_of, projected

Floats = npt.NDArray[np.float64]

TRUSTED = 1.0
"""A corner that is farther from where the pose puts it counts less and less [pixel]."""

CORNER = 0.25
"""How well a corner is found, as a standard deviation [pixel]; measured on simulated pictures."""

OUTLIER = 2.5
"""A marker is left out where all others agree so many times better without it."""

FEWEST = 3
"""So few markers give a pose; with fewer a single wrong one could decide it."""


@dataclass(frozen=True, slots=True, eq=False)
class Sighted:
    """Corners of markers, in the cell and in a picture.

    Attributes:
        patterns: (n,) the marker of each corner.
        points: (n, 3) in the cell frame [m].
        pixels: (n, 2) in the picture [pixel].
    """

    patterns: npt.NDArray[np.int64]
    points: Floats
    pixels: Floats

    @property
    def markers(self) -> int:
        """How many different ones."""
        return len(np.unique(self.patterns))

    def without(self, pattern: int) -> "Sighted":
        """The corners of all other markers."""
        kept = self.patterns != pattern
        return Sighted(self.patterns[kept], self.points[kept], self.pixels[kept])


def sighted(fiducials: Iterable[Fiducial], seen: Iterable[Found]) -> Sighted:
    """What was found, in one or more pictures of one camera."""
    known: Mapping[int, Floats] = {one.id: corners_of(one) for one in fiducials}
    each = [(i, at) for found in seen for i, at in sorted(found.items()) if i in known]
    if not each:
        return Sighted(np.zeros(0, dtype=np.int64), np.zeros((0, 3)), np.zeros((0, 2)))
    return Sighted(
        np.repeat([i for i, _ in each], 4),
        np.concatenate([known[i] for i, _ in each]),
        np.concatenate([at for _, at in each]),
    )


def pose_of(corners: Sighted, k: Matrix3) -> Pose | None:
    """Where a camera stands.

    Args:
        corners: of at least `FEWEST` markers.
        k: intrinsics of the picture.

    Returns:
        `cell_from_camera`; None where the corners allow no pose.
    """
    solved, turn, shift = cv2.solvePnP(
        corners.points, corners.pixels, np.array(k), None, flags=cv2.SOLVEPNP_SQPNP
    )
    if not solved:
        return None
    camera_from_cell = Pose.from_arrays(
        np.asarray(shift).ravel(), Rotation.from_rotvec(np.asarray(turn).ravel()).as_matrix()
    )
    return refined(corners, k, camera_from_cell.inverse)


def refined(corners: Sighted, k: Matrix3, cell_from_camera: Pose) -> Pose:
    """The pose near another one that brings the corners nearest to where they are seen.

    Corners far from their place count less (soft L1). Where the markers do not agree, each is left
    out in turn: one that was moved or misread is the one without which the others do.
    """
    pose = _nearest(corners, k, cell_from_camera)
    while corners.markers > FEWEST:
        worst = _beside(corners, k, pose)
        if worst <= TRUSTED:
            break
        tried = [corners.without(int(i)) for i in np.unique(corners.patterns)]
        poses = [_nearest(rest, k, pose) for rest in tried]
        left = [_beside(rest, k, one) for rest, one in zip(tried, poses, strict=True)]
        best = int(np.argmin(left))
        if left[best] * OUTLIER > worst:
            break
        corners, pose = tried[best], poses[best]
    return pose


def _beside(corners: Sighted, k: Matrix3, pose: Pose) -> float:
    """How far corners are seen beside their places, as a root mean square [pixel]."""
    return rms(projected(corners.points, k, pose)[:, :2] - corners.pixels)


def _nearest(corners: Sighted, k: Matrix3, cell_from_camera: Pose) -> Pose:
    start = cell_from_camera.inverse
    turn, shift = np.array(start.rotation), np.array(start.translation)
    base = corners.points @ turn.T + shift
    focal, centre = np.array((k[0][0], k[1][1])), np.array((k[0][2], k[1][2]))

    def apart(step: Floats) -> Floats:
        moved = base @ Rotation.from_rotvec(step[:3]).as_matrix().T + step[3:]
        seen = focal * moved[:, :2] / np.maximum(moved[:, 2:], 1e-6) + centre
        return np.asarray((seen - corners.pixels).ravel())

    scales = np.array((1e-3, 1e-3, 1e-3, 1e-3, 1e-3, 1e-3))
    best = least_squares(apart, np.zeros(6), x_scale=scales, loss="soft_l1", f_scale=TRUSTED)
    more = Rotation.from_rotvec(best.x[:3]).as_matrix()
    return Pose.from_arrays(more @ shift + best.x[3:], more @ turn).inverse


def misplaced(corners: Sighted, k: Matrix3, cell_from_camera: Pose) -> Floats:
    """How far beside its corner each ray passes: (n,) [m], at the corner's depth."""
    at = projected(corners.points, k, cell_from_camera)
    focal = (k[0][0], k[1][1])
    return np.asarray(np.linalg.norm((at[:, :2] - corners.pixels) / focal, axis=1) * at[:, 2])


def shifted(points: Floats, one: Pose, other: Pose) -> Floats:
    """How far points seen from one pose lie from where the other puts them: (n,) [m].

    Args:
        points: (n, 3) in the cell frame [m].
        one: a camera's pose.
        other: what is believed of it.
    """
    way = other @ one.inverse
    moved = points @ np.array(way.rotation).T + np.array(way.translation)
    return np.asarray(np.linalg.norm(moved - points, axis=1))


def spread(corners: Sighted, k: Matrix3, cell_from_camera: Pose, points: Floats) -> float:
    """How far points may be off by what corners tell of the pose: the worst's deviation [m].

    Args:
        corners: what the pose was found from.
        k: intrinsics of the picture.
        cell_from_camera: the pose.
        points: (n, 3) in the cell frame [m].
    """
    seen, z = _turned(corners.points, cell_from_camera)
    fx, fy = k[0][0], k[1][1]
    x, y = seen[:, 0] / z, seen[:, 1] / z
    zero = np.zeros_like(z)
    by_place = np.stack(
        (
            np.column_stack((fx / z, zero, -fx * x / z)),
            np.column_stack((zero, fy / z, -fy * y / z)),
        ),
        axis=1,
    )
    rows = np.einsum("nij,njk->nik", by_place, _steps(seen)).reshape(-1, 6)
    covariance = np.linalg.pinv(rows.T @ rows, rcond=1e-12) * CORNER**2
    steps = _steps(_turned(points, cell_from_camera)[0])
    traces = np.einsum("nij,jk,nik->n", steps, covariance, steps)
    return float(np.sqrt(traces.max()))


def _turned(points: Floats, cell_from_camera: Pose) -> tuple[Floats, Floats]:
    """Points in the camera's frame, and their depths."""
    turn, shift = np.array(cell_from_camera.rotation), np.array(cell_from_camera.translation)
    seen = (points - shift) @ turn
    return seen, seen[:, 2]


def _steps(points: Floats) -> Floats:
    """How points move with a small turn and a small shift: (n, 3, 6)."""
    moves = np.zeros((len(points), 3, 6))
    x, y, z = points.T
    moves[:, 0, 1], moves[:, 0, 2] = z, -y
    moves[:, 1, 0], moves[:, 1, 2] = -z, x
    moves[:, 2, 0], moves[:, 2, 1] = y, -x
    moves[:, :, 3:] = np.eye(3)
    return moves


def rms(values: Floats) -> float:
    """The root of the mean of the squares."""
    return float(np.sqrt(np.mean(values**2)))
