"""Scenes and looks at them that know the truth."""

import math
from dataclasses import replace

import numpy as np

from depal.domain import CameraMount, Gtin
from depal.geometry import OrientedBox, Pose
from depal.perception.faces import Face, Look, Name, Relation, SeenBox
from depal.simulation.imaging.lens import aimed
from depal.studies.perception import TrueBox, TrueFace, Truth, true_relations, truth_of

CAMERAS = (
    CameraMount("front", aimed((-0.8, -0.4, 0.7), (1.6, 0.0, 0.5)), (1080, 1920), (720, 1280), 1.2),
    CameraMount("top", aimed((1.5, 0.0, 3.4), (1.6, 0.0, 0.0)), (1920, 1080), (1280, 720), 0.75),
)


def wall_of(columns: int = 3, rows: int = 2, depths: int = 1) -> Truth:
    """Boxes of 0.3 x 0.4 x 0.25 in a block, a millimetre apart, each its own product."""
    shapes = [
        OrientedBox.upright((1.6 + 0.301 * k, 0.401 * (i - columns / 2), 0.27 + 0.25 * j), SIZE)
        for k in range(depths)
        for i in range(columns)
        for j in range(rows)
    ]
    boxes = [TrueBox(shape, Gtin(f"{n:014d}")) for n, shape in enumerate(shapes)]
    return truth_of(boxes, CAMERAS)


SIZE = (0.3, 0.4, 0.25)


def face_like(true: TrueFace, right: float = 0.0, down: float = 0.0, deep: float = 0.0) -> Face:
    """A detection of a face, moved in its own frame [m]."""
    pose = true.cell_from_face @ Pose((right, down, deep))
    return Face(true.facing, pose, true.size, 0.9, true.visible)


def turned(true: TrueFace, yaw: float) -> Face:
    """A detection of a face, turned about the vertical [rad]."""
    turn = Pose.from_yaw((0.0, 0.0, 0.0), yaw) @ Pose(rotation=true.cell_from_face.rotation)
    pose = Pose(true.cell_from_face.translation, turn.rotation)
    return Face(true.facing, pose, true.size, 0.9)


def perfect(truth: Truth, *, noise: float = 0.0, seed: int = 0) -> Look:
    """A look that sees every face that counts, a little off, and names every box."""
    random = np.random.default_rng(seed)
    faces: dict[int, list[Face]] = {}
    for face in truth.faces:
        if face.counts:
            off = random.normal(0.0, noise, 3) if noise else np.zeros(3)
            name = Name(truth.boxes[face.box].gtin, "side", 0.9, certain=True)
            moved = replace(face_like(face, *off.tolist()), name=name)
            faces.setdefault(face.box, []).append(moved)
    order = sorted(faces)
    boxes = tuple(
        SeenBox(
            truth.boxes[box].shape,
            0.9,
            np.diag([1e-6] * 3 + [math.radians(0.3) ** 2] * 3),
            tuple(faces[box]),
            truth.boxes[box].gtin,
        )
        for box in order
    )
    on_top, occludes = true_relations([truth.boxes[box].shape for box in order])
    return Look(
        boxes,
        tuple(Relation(a, b, 0.99) for a, b in sorted(on_top.asked)),
        tuple(Relation(a, b, 0.99) for a, b in sorted(occludes.asked)),
        tuple(face for box in order for face in faces[box]),
    )
