"""A frame as it is kept in a folder."""

from dataclasses import dataclass

import cv2
import numpy as np
import numpy.typing as npt

from depal.geometry import Matrix3, Pose, Vector3
from depal.ports import Frame


@dataclass(frozen=True, slots=True, eq=False)
class RecordedFrame:
    """A picture with depth, and what was kept with it. Colour and depth share one lens.

    Attributes:
        colour: (h, w, 3) uint8, RGB.
        depth: (h', w') float32 along the optical axis [m]; 0 where nothing was measured.
        colour_k: intrinsics of the colour picture, rows.
        depth_k: intrinsics of the depth picture, rows; the same where both have one size.
        cell_from_camera: where it was taken from: z forward, x right, y down; None where unknown.
        sizes: edges of the boxes that may be in it [m]; None where unknown.
        masks: (h, w) bool each, a face or a box; in the order of their files' names.
        taken: when [s].
    """

    colour: npt.NDArray[np.uint8]
    depth: npt.NDArray[np.float32]
    colour_k: Matrix3
    depth_k: Matrix3
    cell_from_camera: Pose | None = None
    sizes: tuple[Vector3, ...] | None = None
    masks: tuple[npt.NDArray[np.bool_], ...] = ()
    taken: float = 0.0

    @classmethod
    def of_frame(cls, frame: Frame, sizes: tuple[Vector3, ...] | None = None) -> "RecordedFrame":
        """A camera's frame, to be kept."""
        return cls(
            frame.colour,
            frame.depth,
            frame.colour_k,
            frame.depth_k,
            frame.cell_from_camera,
            sizes,
            taken=frame.taken,
        )

    def as_frame(self, cell_from_camera: Pose | None = None) -> Frame:
        """The frame as a camera would have given it.

        Args:
            cell_from_camera: where it was taken from, if the frame itself does not know; the
                frame's own pose wins. Without either the camera's frame is the cell's.
        """
        pose = self.cell_from_camera or cell_from_camera or Pose()
        return Frame(self.taken, self.colour, self.depth, self.colour_k, self.depth_k, pose)


def registered(
    depth: npt.NDArray[np.float32], depth_k: Matrix3, colour_k: Matrix3, size: tuple[int, int]
) -> npt.NDArray[np.float32]:
    """Depth at the pixels of the colour picture: of each the nearest that was measured, unmixed.

    Args:
        depth: (h', w') [m].
        depth_k: its intrinsics.
        colour_k: of the colour picture, which looks through the same lens.
        size: width and height of the colour picture [pixel].

    Returns:
        (h, w) [m]; 0 where nothing was measured, and outside of the depth picture.
    """
    width, height = size
    (fx, _, cx), (_, fy, cy), _ = colour_k
    (gx, _, dx), (_, gy, dy), _ = depth_k
    x = np.rint((np.arange(width) - cx) * (gx / fx) + dx)
    y = np.rint((np.arange(height) - cy) * (gy / fy) + dy)
    across, down = np.meshgrid(x.astype(np.float32), y.astype(np.float32))
    return np.asarray(cv2.remap(depth, across, down, cv2.INTER_NEAREST, borderValue=0.0))
