"""Whether a camera still stands where it was calibrated: asked at every look."""

from collections.abc import Iterable
from dataclasses import dataclass, field

import numpy as np
import numpy.typing as npt

from depal.domain import Fiducial
from depal.geometry import Matrix3, Pose
from depal.perception.calibration.calibration import Calibration
from depal.perception.calibration.finding import (
    Found,
    expected,
    found_anywhere,
    found_near,
    grey_of,
)
from depal.perception.calibration.solving import (
    FEWEST,
    Sighted,
    misplaced,
    pose_of,
    refined,
    rms,
    shifted,
    sighted,
    spread,
)
from depal.ports import Frame

Floats = npt.NDArray[np.float64]

LIMIT = 0.005
"""Beyond this residual a camera must not be trusted [m]."""

REACH = 0.05
"""Markers are looked for so far beside their places [m]; farther away anywhere in the picture."""

WELL_KNOWN = 0.002
"""A pose counts by itself where it is known better than this among the markers [m]."""


@dataclass(frozen=True, slots=True, eq=False)
class MarkerCheck:
    """What one look says of a calibration.

    Attributes:
        residual: how far off what the camera sees may be placed [m]; infinite where too few
            markers are seen to tell.
        expected: by pattern the corners that should be seen where nothing hides them [pixel].
        seen: by pattern the corners that are seen [pixel].
        cell_from_camera: where this frame alone puts the camera; None where it cannot tell.
    """

    residual: float
    expected: Found
    seen: Found = field(default_factory=dict)
    cell_from_camera: Pose | None = None


def check(frame: Frame, fiducials: Iterable[Fiducial], calibration: Calibration) -> float:
    """How far off what a camera sees may be placed [m]: beyond `LIMIT` it must not be trusted.

    Infinite where too few markers are seen to tell.
    """
    return checked(frame, tuple(fiducials), calibration).residual


def checked(frame: Frame, fiducials: tuple[Fiducial, ...], calibration: Calibration) -> MarkerCheck:
    """Looks where the markers are expected, and compares.

    The residual is the larger of two: by how much the middle one of the markers seen is beside
    its place, and, where the markers seen tell a pose well enough, by how much that pose moves
    the room among all markers.
    """
    size, k = (frame.colour.shape[1], frame.colour.shape[0]), frame.colour_k
    pose = calibration.cell_from_camera
    there = expected(fiducials, k, size, pose)
    grey = grey_of(frame.colour)
    seen = found_near(grey, there, REACH * k[0][0] / _distance(there, fiducials, pose))
    if len(seen) < min(FEWEST, len(there)):
        seen = found_anywhere(frame.colour, [marker.id for marker in fiducials])
    if len(seen) < FEWEST:
        return MarkerCheck(float("inf"), there, seen)
    corners = sighted(fiducials, [seen])
    apart = misplaced(corners, k, pose)
    each = [rms(apart[corners.patterns == i]) for i in np.unique(corners.patterns)]
    residual = float(np.median(each))
    own = _own_pose(corners, k, pose)
    room = room_among(fiducials)
    if own is not None and spread(corners, k, own, room) <= WELL_KNOWN:
        residual = max(residual, float(shifted(room, own, pose).max()))
    return MarkerCheck(residual, there, seen, own)


def room_among(fiducials: Iterable[Fiducial]) -> Floats:
    """Corners of a cuboid half as wide as all markers stand apart, in their middle: (8, 3) [m]."""
    places = np.array([marker.cell_from_marker.translation for marker in fiducials])
    low, high = places.min(axis=0), places.max(axis=0)
    signs = np.array(np.meshgrid(*[(-0.25, 0.25)] * 3)).reshape(3, -1).T
    return np.asarray((low + high) / 2 + signs * (high - low))


def _own_pose(corners: Sighted, k: Matrix3, near: Pose) -> Pose | None:
    """A pose from one frame's corners: near the known one, or where they are all elsewhere, new."""
    far = float(np.median(misplaced(corners, k, near))) > 2 * REACH
    return pose_of(corners, k) if far else refined(corners, k, near)


def _distance(there: Found, fiducials: Iterable[Fiducial], pose: Pose) -> float:
    """From the lens to the nearest of the markers that are expected [m]."""
    lens = np.array(pose.translation)
    return min(
        (
            float(np.linalg.norm(np.array(marker.cell_from_marker.translation) - lens))
            for marker in fiducials
            if marker.id in there
        ),
        default=1.0,
    )
