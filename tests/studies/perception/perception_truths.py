"""Scenes and looks at them that know the truth."""

import math
from dataclasses import replace

import numpy as np

from depal.domain import Gtin
from depal.geometry import OrientedBox, Pose
from depal.perception.faces import Face, Facing, Look, Name, Relation, SeenBox
from depal.simulation.scenes.truth import front_and_top
from depal.studies.perception import TrueBox, TrueFace, Truth, true_relations

SIZE = (0.3, 0.4, 0.25)


def wall_of(columns: int = 3, rows: int = 2, depths: int = 1) -> Truth:
    """Boxes of 0.3 x 0.4 x 0.25 in a block, a millimetre apart, each its own product."""
    boxes: list[TrueBox] = []
    faces: list[TrueFace] = []
    for depth in range(depths):
        for column in range(columns):
            for row in range(rows):
                at = (1.6 + 0.301 * depth, 0.401 * (column - columns / 2), 0.27 + 0.25 * row)
                box = len(boxes)
                boxes.append(TrueBox(OrientedBox.upright(at, SIZE), Gtin(f"{box:014d}")))
                front, top = faces_of(box, boxes[-1].shape)
                faces.append(replace(front, visible=float(depth == 0)))
                faces.append(replace(top, visible=float(row == rows - 1)))
    return Truth(tuple(boxes), tuple(faces))


def faces_of(index: int, shape: OrientedBox) -> tuple[TrueFace, TrueFace]:
    """The front and the top of an upright box of `SIZE`."""
    front, top = front_and_top(shape, np.array((-1.0, 0.0, 0.0)))
    x, y, z = shape.size
    return TrueFace(Facing.FRONT, index, front, (y, z)), TrueFace(Facing.TOP, index, top, (y, x))


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
