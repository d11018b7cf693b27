"""Cartons that stand like those of the real frame, for depths to be compared with it."""

import numpy as np

from depal.geometry import Pose
from depal.simulation.imaging.kernels import cover
from depal.simulation.imaging.lens import Lens
from depal.simulation.imaging.mesh import Mesh, cuboid, joined, rectangle

# First and last column and row of the lids in the real picture, and their depth [m].
LIDS = (
    (227, 334, 381, 455, 1.590),
    (235, 339, 317, 391, 1.597),
    (442, 562, 400, 469, 1.543),
    (441, 549, 328, 396, 1.555),
    (336, 441, 319, 392, 1.578),
    (333, 435, 393, 460, 1.574),
    (280, 341, 240, 302, 1.692),
    (341, 432, 260, 318, 1.679),
    (438, 536, 271, 328, 1.672),
    (221, 279, 237, 317, 1.721),
    (166, 222, 234, 304, 1.751),
)
OTHERS = ((118, 232, 303, 448, 1.505), (142, 526, 222, 600, 1.86))
FOCAL, MIDDLE, FLOOR = 607.0, (316.0, 250.0), 2.2


def replica(lens: Lens) -> tuple[Mesh, list[np.ndarray]]:
    """The cartons before a lens that looks down from the origin, and the masks of their lids."""
    random = np.random.default_rng(1)
    turns = random.normal(0.0, 0.02, len(LIDS) + len(OTHERS)).tolist()
    boxes = [
        _box(lid, 0.108 if number < len(LIDS) else 0.2, turns[number], number)
        for number, lid in enumerate((*LIDS, *OTHERS))
    ]
    floor = rectangle(Pose((0.0, 0.0, FLOOR)), (6.0, 6.0), 0, len(boxes))
    mesh = joined([*boxes, floor])
    width, height = lens.size
    owner = np.full((height, width), -1, dtype=np.int32)
    cover(mesh.corners, lens.values, np.zeros((height, width)), owner, 0)
    lids = np.abs(mesh.normals[:, 0, 2]) > 0.5
    parts = np.append(np.where(lids, mesh.parts, -1), -1)[owner]
    return mesh, [parts == number for number in range(len(LIDS))]


def _box(lid: tuple[int, int, int, int, float], high: float, turn: float, part: int) -> Mesh:
    left, right, top, bottom, z = lid
    at = (
        ((left + right) / 2 - MIDDLE[0]) / FOCAL * z,
        ((top + bottom) / 2 - MIDDLE[1]) / FOCAL * z,
        z + high / 2,
    )
    size = ((right - left) / FOCAL * z - 0.004, (bottom - top) / FOCAL * z - 0.004, high)
    return cuboid(size, (0,), part).moved(Pose.from_yaw(at, turn))
