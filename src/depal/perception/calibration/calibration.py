"""A camera's calibration: what is known of it, found from markers."""

import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from depal.domain import CameraMount, Fiducial
from depal.errors import FrameError, Problem
from depal.geometry import Matrix3, OrientedBox, Pose
from depal.perception.calibration.finding import expected, found_anywhere
from depal.perception.calibration.planes import PlaneDepth, merged, plane_depth
from depal.perception.calibration.scaling import DepthScale, scale_of
from depal.perception.calibration.solving import FEWEST, misplaced, pose_of, refined, rms, sighted
from depal.perception.calibration.surfaces import Surface, surface_of
from depal.ports import Frame


@dataclass(frozen=True, slots=True, eq=False)
class Calibration:
    """What is known of one camera.

    Attributes:
        cell_from_camera: its pose: z forward, x right, y down.
        depth: how true depths follow from measured ones.
        residual: root mean square of how far beside the markers' corners their rays pass [m].
        seen: by pattern the same of each marker [m].
        colour_k: intrinsics of the colour picture it was found with.
        depth_k: the same of the depth picture.
    """

    cell_from_camera: Pose
    depth: DepthScale
    residual: float
    seen: Mapping[int, float]
    colour_k: Matrix3
    depth_k: Matrix3

    @classmethod
    def nominal(cls, mount: CameraMount) -> "Calibration":
        """What the cell file says of a camera, before anybody has measured it."""
        colour, depth = (
            nominal_k(size, mount.vertical_view) for size in (mount.colour_size, mount.depth_size)
        )
        return cls(mount.cell_from_camera, DepthScale(), 0.0, {}, colour, depth)

    @property
    def depth_scale(self) -> float:
        """The factor from measured to true depths."""
        return self.depth.scale

    @property
    def markers(self) -> int:
        """How many markers it was found from."""
        return len(self.seen)

    def applied(self, frame: Frame) -> Frame:
        """A frame with true depths and this pose."""
        depth = self.depth.applied(frame.depth)
        return replace(frame, depth=depth, cell_from_camera=self.cell_from_camera)


def calibrate(
    frames: Sequence[Frame],
    fiducials: Iterable[Fiducial],
    fixtures: Iterable[OrientedBox] = (),
) -> Calibration:
    """Finds pose and depth scale of a camera.

    Args:
        frames: pictures of one camera that has not moved in between; what they say of their own
            pose is not used.
        fiducials: all of the cell.
        fixtures: solid things of the cell: where a plate hangs on one, its whole face tells of
            the depths.

    Returns:
        The calibration.

    Raises:
        FrameError: no frame, frames of different intrinsics, or too few markers.
    """
    markers = tuple(fiducials)
    first = _alike(frames)
    patterns = [marker.id for marker in markers]
    found = [found_anywhere(frame.colour, patterns) for frame in frames]
    corners = sighted(markers, found)
    pose = pose_of(corners, first.colour_k) if corners.markers >= FEWEST else None
    if pose is not None:
        size = (first.colour.shape[1], first.colour.shape[0])
        well = expected(markers, first.colour_k, size, pose)
        better = sighted(markers, [{i: one[i] for i in one if i in well} for one in found])
        if better.markers >= FEWEST:
            corners, pose = better, refined(better, first.colour_k, pose)
    if pose is None:
        some = sorted({pattern for one in found for pattern in one})
        what = f"markers {_listed(some)} are seen, too few for a pose"
        wanted = f"at least {FEWEST} of {_listed(sorted(patterns))}"
        raise FrameError("calibration", [Problem("fiducials", what, wanted)])
    seen = {int(i) for i in np.unique(corners.patterns)}
    planes = known_depths(frames, pose, [one for one in markers if one.id in seen], fixtures)
    apart = misplaced(corners, first.colour_k, pose)
    return Calibration(
        pose,
        scale_of(planes),
        rms(apart),
        {i: rms(apart[corners.patterns == i]) for i in sorted(seen)},
        first.colour_k,
        first.depth_k,
    )


def nominal_k(size: tuple[int, int], vertical_view: float) -> Matrix3:
    """Intrinsics of an ideal lens.

    Args:
        size: width and height of the picture [pixel].
        vertical_view: angle of view from its top to its bottom [rad].
    """
    width, height = size
    focal = height / 2 / math.tan(vertical_view / 2)
    return ((focal, 0.0, (width - 1) / 2), (0.0, focal, (height - 1) / 2), (0.0, 0.0, 1.0))


def known_depths(
    frames: Sequence[Frame],
    pose: Pose,
    fiducials: Iterable[Fiducial],
    fixtures: Iterable[OrientedBox],
) -> tuple[PlaneDepth, ...]:
    """What frames of one camera say of the planes at markers, each plane once."""
    solids, known = tuple(fixtures), dict[bytes, Surface]()
    for one in fiducials:
        surface = surface_of(one, solids)
        known.setdefault(surface.corners.tobytes(), surface)
    each = [
        [
            plane
            for frame in frames
            if (plane := plane_depth(frame.depth, frame.depth_k, pose, surface)) is not None
        ]
        for surface in known.values()
    ]
    return tuple(merged(planes) for planes in each if planes)


def _alike(frames: Sequence[Frame]) -> Frame:
    if not frames:
        raise FrameError("calibration", [Problem("", "there is no frame", "at least one")])
    first = frames[0]
    for number, frame in enumerate(frames):
        if frame.colour_k != first.colour_k or frame.colour.shape != first.colour.shape:
            what = f"frame {number} has other intrinsics or another size than frame 0"
            raise FrameError("calibration", [Problem("", what, "frames of one camera")])
    return first


def _listed(patterns: Sequence[int]) -> str:
    return ", ".join(map(str, patterns)) or "none"
