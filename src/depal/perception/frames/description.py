"""`frame.json`: what is known of a frame beside its pictures."""

import json
import math
from collections.abc import Iterator
from dataclasses import dataclass, field

from depal.errors import Problem, did_you_mean
from depal.geometry import Matrix3, Pose, Vector3
from depal.perception.calibration.matrices import (
    FARTHEST,
    lens_of_rows,
    numbers,
    pose_of_rows,
    rows_of,
    shown,
)

NAME = "frame.json"
"""Of the file in a frame's folder."""

KEYS = ("K", "depth_K", "depth_unit", "cell_from_camera", "sizes", "taken")
"""What the file may hold; other keys are left alone, unless they are nearly one of these."""

_MATRIX = "three rows of three numbers: [[fx, 0, cx], [0, fy, cy], [0, 0, 1]], in pixels"
_POSE = "four rows of four numbers, the last 0 0 0 1, or null"
_SIZES = "a list of [length, width, height] in metres, or null"


@dataclass(slots=True)
class Description:
    """What the file says, as far as it can be used.

    Attributes:
        k: intrinsics of the colour picture.
        depth_k: of the depth picture, where it has its own.
        depth_unit: of one count in the depth picture [m].
        cell_from_camera: where the camera stood.
        sizes: of the boxes that may be in the picture [m].
        taken: when [s].
        problems: everything that is wrong with the file.
    """

    k: Matrix3 | None = None
    depth_k: Matrix3 | None = None
    depth_unit: float | None = None
    cell_from_camera: Pose | None = None
    sizes: tuple[Vector3, ...] | None = None
    taken: float = 0.0
    problems: list[Problem] = field(default_factory=list)


def description_of(text: str) -> Description:
    """Reads a text; nothing is raised, the problems are listed."""
    found = Description()
    wrong = found.problems
    try:
        fields = json.loads(text)
    except (ValueError, RecursionError) as error:
        wrong.append(Problem(NAME, f"is not JSON: {error}", "an object with K and depth_unit"))
        return found
    if not isinstance(fields, dict):
        wrong.append(Problem(NAME, "is not an object", "an object with K and depth_unit"))
        return found
    wrong += _nearly_known(fields)
    found.k = _matrix(fields, "K", wrong, needed=True)
    found.depth_k = _matrix(fields, "depth_K", wrong, needed=False)
    found.depth_unit = _unit(fields, wrong)
    found.cell_from_camera = _pose(fields, wrong)
    found.sizes = _sizes(fields, wrong)
    taken = fields.get("taken", 0.0)
    if numbers(taken, ()) is None:
        wrong.append(Problem(f"{NAME}, taken", f"{shown(taken)} is no time", "seconds"))
    else:
        found.taken = float(taken)
    return found


def text_of(found: Description) -> str:
    """The text of a sound description."""
    pose = found.cell_from_camera
    fields: dict[str, object] = {"K": found.k}
    if found.depth_k is not None:
        fields["depth_K"] = found.depth_k
    fields |= {
        "depth_unit": found.depth_unit,
        "cell_from_camera": None if pose is None else rows_of(pose),
        "sizes": found.sizes,
        "taken": found.taken,
    }
    return json.dumps(fields, indent=1) + "\n"


def implausible(k: Matrix3, size: tuple[int, int]) -> str:
    """Why intrinsics do not fit a picture of this width and height; empty where they do."""
    (fx, _, cx), (_, fy, cy), _ = k
    width, height = size
    wide = 2 * math.degrees(math.atan(width / 2 / fx))
    if not 10.0 <= wide <= 150.0:  # noqa: PLR2004 - lenses that are sold
        return f"fx {fx:g} is {wide:.0f} degrees across a picture {width} pixels wide"
    if not 0.8 <= fy / fx <= 1.25:  # noqa: PLR2004
        return f"fx {fx:g} and fy {fy:g} do not belong to one lens"
    if abs(cx / width - 0.5) > 0.2 or abs(cy / height - 0.5) > 0.2:  # noqa: PLR2004
        return f"its centre ({cx:g}, {cy:g}) is far from the middle of {width} x {height} pixels"
    return ""


def _nearly_known(fields: dict[str, object]) -> Iterator[Problem]:
    for key in fields:
        hint = did_you_mean(key, KEYS)
        if key not in KEYS and hint.startswith("did you mean"):
            yield Problem(f"{NAME}, {key[:40]}", "is no key of a frame", exists=hint)


def _matrix(
    fields: dict[str, object], key: str, wrong: list[Problem], *, needed: bool
) -> Matrix3 | None:
    where, value = f"{NAME}, {key}", fields.get(key)
    if value is None:
        if needed:
            wrong.append(Problem(where, "is missing", _MATRIX))
        return None
    k = lens_of_rows(value)
    if isinstance(k, str):
        wrong.append(Problem(where, k, _MATRIX))
        return None
    return k


def _unit(fields: dict[str, object], wrong: list[Problem]) -> float | None:
    where, value = f"{NAME}, depth_unit", fields.get("depth_unit")
    expected = "metres per count of depth.png, such as 0.001"
    unit = numbers(value, ())
    if unit is None:
        what = "is missing" if value is None else f"{shown(value)} is no number"
        wrong.append(Problem(where, what, expected))
        return None
    if not 1e-6 <= float(unit) <= 0.1:  # noqa: PLR2004
        hint = "; counts per metre?" if float(unit) > 1.0 else ""
        wrong.append(
            Problem(where, f"{float(unit):g} is no unit of a depth picture{hint}", expected)
        )
        return None
    return float(unit)


def _pose(fields: dict[str, object], wrong: list[Problem]) -> Pose | None:
    value = fields.get("cell_from_camera")
    if value is None:
        return None
    pose = pose_of_rows(value)
    if isinstance(pose, Pose):
        return pose
    wrong.append(Problem(f"{NAME}, cell_from_camera", pose, _POSE))
    return None


def _sizes(fields: dict[str, object], wrong: list[Problem]) -> tuple[Vector3, ...] | None:
    where, value = f"{NAME}, sizes", fields.get("sizes")
    if value is None:
        return None
    if not isinstance(value, list):
        wrong.append(Problem(where, f"{shown(value)} is no list", _SIZES))
        return None
    kept = list[Vector3]()
    for index, size in enumerate(value):
        edges = numbers(size, (3,))
        if edges is None or edges.min() <= 0.0 or edges.max() > FARTHEST:
            wrong.append(Problem(f"{where}[{index}]", f"{shown(size)} is no size", _SIZES))
        else:
            kept.append((float(edges[0]), float(edges[1]), float(edges[2])))
    return tuple(kept)
