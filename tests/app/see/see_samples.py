"""A little look to be drawn and told: two boxes on each other, one before them, a stray face."""

import numpy as np

from depal.domain import Gtin
from depal.geometry import OrientedBox, Pose, Vector3
from depal.perception.faces import Face, Facing, Look, Name, Relation, SeenBox
from depal.perception.frames import RecordedFrame
from depal.simulation.imaging.lens import aimed

K = ((500.0, 0.0, 319.5), (0.0, 500.0, 239.5), (0.0, 0.0, 1.0))
GTIN, OTHER = Gtin("12000823098180"), Gtin("12000807013116")


def frame() -> RecordedFrame:
    """A grey picture of the cell from its front, looking a little down."""
    colour = np.full((480, 640, 3), 120, dtype=np.uint8)
    colour[:, 320:] = 160
    depth = np.full((480, 640), 1.5, dtype=np.float32)
    depth[200:300, 200:400] = 1.2
    return RecordedFrame(colour, depth, K, K, aimed((0.0, -0.2, 1.2), (1.6, 0.0, 0.5)))


def front(at: Vector3, size: tuple[float, float], name: Name | None = None) -> Face:
    """A face that looks to the robot."""
    turn = ((0.0, 0.0, 1.0), (-1.0, 0.0, 0.0), (0.0, -1.0, 0.0))
    return Face(Facing.FRONT, Pose(at, turn), size, 0.97, name=name)


def top(at: Vector3, size: tuple[float, float], name: Name | None = None) -> Face:
    """A face that looks up."""
    turn = ((0.0, -1.0, 0.0), (-1.0, 0.0, 0.0), (0.0, 0.0, -1.0))
    return Face(Facing.TOP, Pose(at, turn), size, 0.884, 0.8, name=name)


def look() -> Look:
    """Three boxes, one of them named, one of them nearly, and a face of none."""
    known = Name(GTIN, "side", 0.9, certain=True)
    maybe = Name(OTHER, "top", 0.6, certain=False)
    shapes = [
        OrientedBox.upright((1.7, 0.0, 0.4), (0.2, 0.4, 0.2)),
        OrientedBox.upright((1.7, 0.0, 0.6), (0.2, 0.4, 0.2)),
        OrientedBox.upright((1.4, 0.3, 0.4), (0.2, 0.2, 0.2), 0.02),
    ]
    faces = (
        front((1.6, 0.0, 0.4), (0.4, 0.2), known),
        top((1.7, 0.0, 0.7), (0.4, 0.2), maybe),
        front((1.6, 0.0, 0.6), (0.4, 0.2)),
        front((1.3, 0.3, 0.4), (0.2, 0.2)),
        front((1.5, -0.5, 0.4), (0.2, 0.2)),
    )
    owners = ((0,), (1, 2), (3,))
    boxes = tuple(
        SeenBox(
            shape,
            0.95,
            np.diag([0.001**2, 0.002**2, 0.003**2, 1e-6, 1e-6, 0.004**2]),
            tuple(faces[k] for k in own),
            GTIN if index == 0 else None,
            sized=index != 2,
        )
        for index, (shape, own) in enumerate(zip(shapes, owners, strict=True))
    )
    return Look(boxes, (Relation(1, 0, 0.99),), (Relation(2, 0, 0.7),), faces)
