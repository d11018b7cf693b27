"""Poses, oriented boxes and upright prisms, in metres and radians, in named frames.

One convention for names: `b_from_a` is the pose that carries coordinates in frame a to
coordinates in frame b, so `cell_from_pallet.apply(point_in_pallet)` is that point in the cell.
"""

from depal.geometry.kernel import kernel, loop_kernel
from depal.geometry.oriented_box import OrientedBox
from depal.geometry.pose import Matrix3, Pose, Vector3
from depal.geometry.prism import (
    PRISM_WIDTH,
    first_unsound,
    footprint_overlap,
    holds_centre,
    lateral_interval,
    prism_of,
    prisms_of,
    slice_at,
)
from depal.geometry.sight_lines import Blockers

__all__ = [
    "PRISM_WIDTH",
    "Blockers",
    "Matrix3",
    "OrientedBox",
    "Pose",
    "Vector3",
    "first_unsound",
    "footprint_overlap",
    "holds_centre",
    "kernel",
    "lateral_interval",
    "loop_kernel",
    "prism_of",
    "prisms_of",
    "slice_at",
]
