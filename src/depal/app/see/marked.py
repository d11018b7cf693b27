"""The faces of a look in the pictures that they were seen in."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from depal.perception.faces import Face, Look, Relation
from depal.ports import Frame
from depal.studies.perception.boxes import all_faces
from depal.studies.perception.real import outline
from depal.studies.perception.truth import corners_of

Floats = npt.NDArray[np.float64]


@dataclass(frozen=True, slots=True, eq=False)
class Marked:
    """A detected face.

    Attributes:
        name: of its box, b1, b2, ...; f1, f2, ... where it belongs to none.
        face: as it was detected.
        box: its box's place in the look; None where it belongs to none.
        camera: the place of the frame that shows it most squarely.
        outline: (4, 2) in that frame's colour picture [pixel].
    """

    name: str
    face: Face
    box: int | None
    camera: int
    outline: Floats


def box_name(index: int) -> str:
    """What the box at a place of a look is called."""
    return f"b{index + 1}"


def marked(look: Look, frames: Sequence[Frame]) -> tuple[Marked, ...]:
    """Every face of a look, those of the boxes first, box by box."""
    owners = {face: index for index, box in enumerate(look.boxes) for face in box.faces}
    faces = all_faces(look)
    order = sorted(range(len(faces)), key=lambda k: (owners.get(faces[k], len(owners)), k))
    found, alone = [], 0
    for face in (faces[k] for k in order):
        box = owners.get(face)
        alone += box is None
        name = f"f{alone}" if box is None else box_name(box)
        camera = max(range(len(frames)), key=lambda k: (squareness(face, frames[k]), -k))
        found.append(Marked(name, face, box, camera, outline(face, frames[camera])))
    return tuple(found)


def squareness(face: Face, frame: Frame) -> float:
    """How well a frame shows a face: the cosine of the angle that it is seen at.

    Less than 0 where the face looks away or does not lie in the picture whole.
    """
    eye = np.array(frame.cell_from_camera.translation)
    way = eye - face.cell_from_face.translation
    cosine = -float(np.array(face.cell_from_face.rotation)[:, 2] @ way) / float(np.linalg.norm(way))
    ahead = (corners_of(face.cell_from_face, face.size) - eye) @ np.array(
        frame.cell_from_camera.rotation
    )[:, 2]
    height, width = frame.colour.shape[:2]
    corners = outline(face, frame)
    inside = (corners >= 0).all() and (corners <= (width - 1, height - 1)).all()
    return cosine if inside and (ahead > 0).all() else cosine - 2.0


def direct(relations: Sequence[Relation]) -> tuple[Relation, ...]:
    """Without the relations that follow from two others."""
    pairs = {(relation.upper, relation.lower) for relation in relations}
    below: dict[int, set[int]] = {}
    for upper, lower in pairs:
        below.setdefault(upper, set()).add(lower)
    return tuple(
        relation
        for relation in relations
        if not any(
            (between, relation.lower) in pairs
            for between in below[relation.upper] - {relation.lower}
        )
    )
