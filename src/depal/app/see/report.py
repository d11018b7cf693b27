"""What `depal see` prints, writes and draws."""

import math
from collections.abc import Sequence

import numpy as np
from matplotlib.figure import Figure

from depal.app.files import Json
from depal.app.pictures.overlay import Arrow, Mark, Panel, overlay
from depal.app.reports.report import PlainTable, Report, plain_table
from depal.app.see.given import Given
from depal.app.see.marked import Marked, box_name, direct, marked
from depal.geometry import Pose, prism_of
from depal.perception.faces import Facing, Look, Relation, SeenBox
from depal.studies.perception.truth import corners_of

DIGITS = 6
"""So many of a product's number are written on the picture."""


def see_report(seen: Given, look: Look, seconds: float) -> Report:
    """What a look found, in its three forms.

    Args:
        seen: what was looked at.
        look: what was found.
        seconds: what the look took [s].
    """
    faces = marked(look, seen.frames)

    def draw() -> Figure:
        return overlay(panels_of(seen, look, faces), _finding(seen, look), _note(seen, seconds))

    return Report(
        fields=_fields(seen, look, faces, seconds),
        shown=[_table(seen, look, faces), _finding(seen, look)],
        draw=draw,
    )


def panels_of(seen: Given, look: Look, faces: Sequence[Marked]) -> list[Panel]:
    """Each camera's picture with the faces that it shows best and the relations between them."""
    panels = []
    for camera, (name, frame) in enumerate(zip(seen.names, seen.frames, strict=True)):
        here = [face for face in faces if face.camera == camera]
        marks = tuple(_mark(face) for face in here)
        arrows = [
            Arrow(start, end, dotted)
            for relations, facing, dotted in (
                (look.on_top, Facing.FRONT, False),
                (look.occludes, Facing.TOP, True),
            )
            for relation in direct(relations)
            for start, end in _ends(relation, here, facing)
        ]
        panels.append(Panel(name, frame.colour, marks, tuple(arrows)))
    return panels


def _ends(relation: Relation, here: Sequence[Marked], facing: Facing) -> list[tuple[int, int]]:
    """The marks of one picture that a relation is drawn between, where it shows both boxes.

    Faces that look the way the relation is seen best are preferred: what stands on what between
    fronts, what hides what between tops.
    """
    spots = []
    for box in (relation.upper, relation.lower):
        own = [k for k, face in enumerate(here) if face.box == box]
        if not own:
            return []
        spots.append(min(own, key=lambda k: (here[k].face.facing is not facing, k)))
    return [(spots[0], spots[1])]


def _mark(seen: Marked) -> Mark:
    name = seen.face.name
    words = [f"{seen.name}  {_score(seen.face.score)}"]
    if name is not None:
        words.append(name.gtin[-DIGITS:] + ("" if name.certain else "?"))
    return Mark(
        seen.outline,
        tuple(words),
        top=seen.face.facing is Facing.TOP,
        sure=name is not None and name.certain,
    )


def _score(score: float) -> str:
    """Two digits without the leading zero."""
    return f"{score:.2f}".removeprefix("0")


def _finding(seen: Given, look: Look) -> str:
    """What was seen, as a sentence."""
    cameras = f"{len(seen.frames)} cameras" if len(seen.frames) > 1 else "one camera"
    boxes = len(look.boxes)
    if not boxes:
        return f"No box seen by {cameras}"
    named = sum(box.gtin is not None for box in look.boxes)
    what = f"{boxes} boxes" if boxes > 1 else "One box"
    if not seen.book.entries:
        return f"{what} seen by {cameras}, without pictures of products"
    return f"{what} seen by {cameras}, {named} of {boxes} named for certain"


def _note(seen: Given, seconds: float) -> str:
    parts = [seen.source, f"note: {seen.noted}" if seen.noted else "without a note"]
    parts.append(f"{len(seen.book.entries)} products with pictures")
    return " · ".join([*parts, f"{seconds:.2f} s"])


def _table(seen: Given, look: Look, faces: Sequence[Marked]) -> PlainTable:
    """A line a box, then the faces that belong to none."""
    table = plain_table(
        f"{seen.source}: boxes",
        "box", "faces", "centre x, y, z [m]", "size [m]", "yaw [deg]", "score", "product", "on",
    )  # fmt: skip
    lower: dict[int, list[str]] = {}
    for relation in direct(look.on_top):
        lower.setdefault(relation.upper, []).append(box_name(relation.lower))
    for index, box in enumerate(look.boxes):
        own = [face for face in faces if face.box == index]
        table.row(
            box_name(index),
            ", ".join(face.face.facing.value for face in own),
            ", ".join(f"{value:.3f}" for value in box.shape.centre),
            " x ".join(f"{edge:.3f}" for edge in box.shape.size) + ("" if box.sized else " ?"),
            f"{math.degrees(_yaw(box)):.1f}",
            f"{box.score:.2f}",
            _product(box, own),
            ", ".join(lower.get(index, [])),
        )
    for face in faces:
        if face.box is None:
            size = " x ".join(f"{edge:.3f}" for edge in face.face.size)
            at = ", ".join(f"{value:.3f}" for value in face.face.cell_from_face.translation)
            score = f"{face.face.score:.2f}"
            table.row(face.name, face.face.facing.value, at, size, "", score, "", "")
    return table


def _product(box: SeenBox, faces: Sequence[Marked]) -> str:
    """The product, or the likeliest one with a question mark."""
    if box.gtin is not None:
        return box.gtin
    names = [face.face.name for face in faces if face.face.name is not None]
    best = max(names, key=lambda name: name.score, default=None)
    return "" if best is None else f"{best.gtin} ?"


def _yaw(box: SeenBox) -> float:
    """The turn about the vertical, within 45 degrees [rad]."""
    *_, cosine, sine = prism_of(box.shape)
    return math.atan2(sine, cosine)


def _fields(seen: Given, look: Look, faces: Sequence[Marked], seconds: float) -> dict[str, Json]:
    return {
        "frame": seen.source,
        "note": seen.noted or None,
        "products": len(seen.book.entries),
        "seconds": seconds,
        "cameras": [
            {
                "name": name,
                "size": [frame.colour.shape[1], frame.colour.shape[0]],
                "cell_from_camera": _rows(frame.cell_from_camera) if placed else None,
            }
            for name, frame, placed in zip(seen.names, seen.frames, seen.placed, strict=True)
        ],
        "cell": "as recorded" if all(seen.placed) else "derived from the dominant plane",
        "detections": [_face_fields(seen, face) for face in faces],
        "boxes": [_box_fields(index, box) for index, box in enumerate(look.boxes)],
        "relations": [
            {
                "relation": kind,
                "upper": box_name(relation.upper),
                "lower": box_name(relation.lower),
                "probability": relation.probability,
            }
            for kind, relations in (("on_top", look.on_top), ("occludes", look.occludes))
            for relation in relations
        ],
    }


def _face_fields(seen: Given, marked_face: Marked) -> Json:
    face = marked_face.face
    return {
        "name": marked_face.name,
        "facing": face.facing.value,
        "camera": seen.names[marked_face.camera],
        "corners": [[float(u), float(v)] for u, v in marked_face.outline],
        "corners_cell": [
            [float(x) for x in corner] for corner in corners_of(face.cell_from_face, face.size)
        ],
        "size": list(face.size),
        "score": face.score,
        "visible": face.visible,
        "gtin": None if face.name is None else face.name.gtin,
        "certain": face.name is not None and face.name.certain,
        "name_score": None if face.name is None else face.name.score,
        "box": marked_face.box,
    }


def _box_fields(index: int, box: SeenBox) -> Json:
    spread = np.sqrt(np.diag(box.covariance))
    return {
        "name": box_name(index),
        "centre": list(box.shape.centre),
        "size": list(box.shape.size),
        "sized": box.sized,
        "yaw": _yaw(box),
        "sigma": {
            "x": float(spread[0]),
            "y": float(spread[1]),
            "z": float(spread[2]),
            "yaw": float(spread[5]),
        },
        "score": box.score,
        "gtin": box.gtin,
    }


def _rows(pose: Pose) -> list[Json]:
    """A pose as a matrix of four rows."""
    rows: list[Json] = [
        [*row, shift] for row, shift in zip(pose.rotation, pose.translation, strict=True)
    ]
    return [*rows, [0.0, 0.0, 0.0, 1.0]]
