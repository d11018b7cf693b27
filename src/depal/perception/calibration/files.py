"""Calibrations of a cell's cameras in a JSON file."""

import json
from collections.abc import Mapping
from pathlib import Path

from depal.errors import FrameError, Problem, did_you_mean
from depal.geometry import Matrix3
from depal.perception.calibration.calibration import Calibration
from depal.perception.calibration.matrices import (
    lens_of_rows,
    numbers,
    pose_of_rows,
    rows_of,
    shown,
)
from depal.perception.calibration.scaling import DepthScale

Fields = dict[str, "Fields"] | list["Fields"] | str | float | int | bool | None

_LARGEST = 4
"""No calibration file is larger [MiB]."""

_EXPECTED = "a file that depal calibrate --json wrote"


def fields_of(calibrations: Mapping[str, Calibration]) -> dict[str, Fields]:
    """What a file keeps of each camera, by its name."""
    return {
        name: {
            "cell_from_camera": _rows(rows_of(one.cell_from_camera)),
            "depth_scale": one.depth.scale,
            "depth_offset": one.depth.offset,
            "depth_error": one.depth.error,
            "depth_planes": one.depth.planes,
            "residual": one.residual,
            "markers": {str(pattern): apart for pattern, apart in one.seen.items()},
            "K": _rows(one.colour_k),
            "depth_K": _rows(one.depth_k),
        }
        for name, one in calibrations.items()
    }


def read_calibrations(path: Path) -> dict[str, Calibration]:
    """The calibrations of a file by the cameras' names.

    Raises:
        FrameError: with everything that is wrong with it.
    """
    source = str(path)
    try:
        if path.stat().st_size > _LARGEST << 20:
            raise FrameError(source, [Problem("", f"is larger than {_LARGEST} MiB", _EXPECTED)])
        fields = json.loads(path.read_text(encoding="utf-8"))
    except OSError as error:
        what = f"cannot be read: {error.strerror}"
        raise FrameError(source, [Problem("", what, _EXPECTED)]) from error
    except (ValueError, RecursionError) as error:
        raise FrameError(source, [Problem("", f"is not JSON: {error}", _EXPECTED)]) from error
    cameras = fields.get("cameras") if isinstance(fields, dict) else None
    if not isinstance(cameras, dict) or not cameras:
        raise FrameError(source, [Problem("cameras", "is missing or empty", _EXPECTED)])
    wrong = list[Problem]()
    found = {str(name): _calibration(str(name), one, wrong) for name, one in cameras.items()}
    if wrong:
        raise FrameError(source, wrong)
    return {name: one for name, one in found.items() if one is not None}


def calibrations_for(path: Path, cameras: tuple[str, ...]) -> dict[str, Calibration]:
    """The calibrations of these cameras, all of which must be in the file.

    Raises:
        FrameError: the file cannot be used, or a camera is not in it.
    """
    found = read_calibrations(path)
    missing = [
        Problem("cameras", f"there is no camera {name!r}", exists=did_you_mean(name, found))
        for name in cameras
        if name not in found
    ]
    if missing:
        raise FrameError(str(path), missing)
    return {name: found[name] for name in cameras}


def _calibration(name: str, fields: object, wrong: list[Problem]) -> Calibration | None:
    where = f"cameras.{name}"
    if not isinstance(fields, dict):
        wrong.append(Problem(where, "is not an object", _EXPECTED))
        return None
    pose = pose_of_rows(fields.get("cell_from_camera"))
    if isinstance(pose, str):
        wrong.append(Problem(f"{where}.cell_from_camera", pose, "four rows of four numbers"))
    lenses = {key: lens_of_rows(fields.get(key)) for key in ("K", "depth_K")}
    for key, lens in lenses.items():
        if isinstance(lens, str):
            wrong.append(Problem(f"{where}.{key}", lens, "three rows of three numbers"))
    figures = {
        "depth_scale": _figure(fields, "depth_scale", (0.8, 1.25), where, wrong),
        "depth_offset": _figure(fields, "depth_offset", (-0.2, 0.2), where, wrong),
        "residual": _figure(fields, "residual", (0.0, 1.0), where, wrong),
    }
    colour, depth = lenses["K"], lenses["depth_K"]
    if isinstance(pose, str) or isinstance(colour, str) or isinstance(depth, str):
        return None
    return Calibration(
        pose,
        DepthScale(
            figures["depth_scale"],
            figures["depth_offset"],
            _kept(fields.get("depth_error")),
            int(_kept(fields.get("depth_planes"), 0.0)),
        ),
        figures["residual"],
        _markers(fields.get("markers")),
        colour,
        depth,
    )


def _figure(
    fields: dict[str, object],
    key: str,
    limits: tuple[float, float],
    where: str,
    wrong: list[Problem],
) -> float:
    value = fields.get(key)
    found = numbers(value, ())
    if found is None or not limits[0] <= float(found) <= limits[1]:
        expected = f"a number from {limits[0]:g} to {limits[1]:g}"
        wrong.append(Problem(f"{where}.{key}", f"is {shown(value)}", expected))
        return limits[0]
    return float(found)


def _kept(value: object, otherwise: float = float("inf")) -> float:
    found = numbers(value, ())
    return otherwise if found is None else float(found)


def _markers(value: object) -> dict[int, float]:
    """Who was seen; told in reports alone, so what cannot be read is left out."""
    if not isinstance(value, dict):
        return {}
    return {int(key): _kept(apart) for key, apart in value.items() if str(key).isdecimal()}


def _rows(rows: list[list[float]] | Matrix3) -> list[Fields]:
    return [list(row) for row in rows]
