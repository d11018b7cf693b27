"""What an active stereo camera makes of true depths.

Depth comes from a disparity d = f b / z between two lenses, b apart: its error grows with z^2,
it comes in steps, what only one lens sees is a hole, and so are edges and faces seen flatly.
"""

from dataclasses import dataclass

import cv2
import numpy as np
import numpy.typing as npt

from depal.simulation.imaging.lens import Lens
from depal.simulation.imaging.raster import Picture

Floats = npt.NDArray[np.float64]
Flags = npt.NDArray[np.bool_]


@dataclass(frozen=True, slots=True)
class DepthNoise:
    """How good the depths are; figures of the size of common industrial cameras'.

    Attributes:
        baseline: between the two lenses [m].
        sigma: of a disparity [pixel].
        steps: a disparity comes in steps of 1 / steps [pixel].
        edge: where disparities of neighbours differ by more, nothing is measured [pixel].
        flattest: cosine of the angle between sight and normal below which nothing is measured.
        reach: nearest and farthest depth that is measured [m].
    """

    baseline: float = 0.095
    sigma: float = 0.06
    steps: int = 32
    edge: float = 1.5
    flattest: float = 0.15
    reach: tuple[float, float] = (0.4, 6.0)


def measured(
    picture: Picture, lens: Lens, noise: DepthNoise, random: np.random.Generator
) -> npt.NDArray[np.float32]:
    """The depths that the camera tells.

    Args:
        picture: what its lens sees.
        lens: it.
        noise: how good it is.
        random: draws the errors.

    Returns:
        (h, w) along the optical axis [m]; 0 where nothing was measured.
    """
    scale = lens.focal[0] * noise.baseline
    true = picture.nearest * scale
    near, far = noise.reach
    holes = (picture.nearest < 1 / far) | (picture.nearest > 1 / near)
    holes |= _hidden(true) | _edges(true, noise.edge) | _flat(picture, lens, noise.flattest)
    seen = true + noise.sigma * random.standard_normal(true.shape, dtype=np.float32)
    disparity = np.round(seen * noise.steps) / noise.steps
    holes |= disparity <= 0.0
    depth = scale / np.where(holes, 1.0, disparity)
    return np.where(holes, 0.0, depth).astype(np.float32)


def _hidden(disparity: Floats) -> Flags:
    """What the second lens, to the right, does not see: something to the right is before it."""
    there = np.arange(disparity.shape[1]) - disparity
    first = np.minimum.accumulate(there[:, ::-1], axis=1)[:, ::-1]
    hidden = np.zeros(disparity.shape, dtype=np.bool_)
    hidden[:, :-1] = there[:, :-1] >= first[:, 1:]
    return hidden


def _edges(disparity: Floats, jump: float) -> Flags:
    """Pixels with a neighbour at another depth."""
    narrow = disparity.astype(np.float32)
    square = np.ones((3, 3), dtype=np.uint8)
    return np.asarray(cv2.dilate(narrow, square) - cv2.erode(narrow, square) > jump)


def _flat(picture: Picture, lens: Lens, flattest: float) -> Flags:
    """Pixels whose surface is seen flatly."""
    corners = picture.mesh.corners
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    normals /= np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), 1e-30)
    normals = np.vstack((normals @ np.array(lens.cell_from_camera.rotation), (0.0, 0.0, -1.0)))
    height, width = picture.nearest.shape
    x = (np.arange(width) - lens.centre[0])[None, :] / lens.focal[0]
    y = (np.arange(height) - lens.centre[1])[:, None] / lens.focal[1]
    a, b, c = (normals[:, k][picture.triangles] for k in range(3))
    return np.asarray(-(a * x + b * y + c) < flattest * np.sqrt(x * x + y * y + 1.0))
