"""Where the cameras of a cell stand and how their depths are scaled: `depal calibrate`."""

import math
from collections.abc import Mapping
from pathlib import Path

import numpy as np
from matplotlib.figure import Figure
from rich.console import RenderableType
from rich.text import Text
from scipy.spatial.transform import Rotation

from depal.app.calibrate_picture import calibration_picture
from depal.app.reports.report import Report, plain_table
from depal.cell.files import find_cell
from depal.domain import CameraMount, CellLayout
from depal.errors import CellError, FrameError, Problem, SettingError, did_you_mean
from depal.geometry import Pose
from depal.logistics import shipped_deliveries
from depal.perception.calibration import LIMIT, Calibration, calibrate, checked, fields_of
from depal.perception.frames import frame_folders, read_frame_folder
from depal.ports import Frame
from depal.simulation.cases import cases_of
from depal.simulation.imaging.model import CameraModel
from depal.simulation.imaging.scene import CellScene
from depal.simulation.scenes.scene import parked
from depal.simulation.snapshot import Snapshot

Pictures = Mapping[str, tuple[Frame, ...]]
"""The frames of each camera, by its name."""

NEAR = 1.8
"""Depths are compared with the truth at this distance [m]."""


def calibration_report(
    reference: str, folder: Path | None, camera: str | None, pictures: int, seed: int
) -> Report:
    """Calibrates the cameras of a cell.

    Args:
        reference: a cell file, or the name of a shipped cell.
        folder: recorded frames; the simulated cameras where None.
        camera: this one alone; None for all.
        pictures: how many each simulated camera takes.
        seed: of the simulated cameras.

    Returns:
        The result in its three forms; it holds where every residual is within `LIMIT`.

    Raises:
        InputError: a file cannot be used, or a camera sees too few markers.
    """
    layout = find_cell(reference)
    if not layout.fiducials:
        what = "the cell has no markers to calibrate by"
        raise CellError(reference, [Problem("fiducials", what, "a list: id, size, at, normal")])
    mounts = {mount.name: mount for mount in layout.cameras}
    if camera is not None and camera not in mounts:
        what = f"there is no camera {camera!r}"
        raise SettingError("--camera", what, exists=did_you_mean(camera, mounts))
    chosen = tuple(mounts.values()) if camera is None else (mounts[camera],)
    frames: Pictures
    if folder is None:
        models, moment = simulated_cameras(layout, chosen, seed)
        frames = {
            name: tuple(model.frame(moment, 0.5 * number, number) for number in range(pictures))
            for name, model in models.items()
        }
        biases = {name: model.bias for name, model in models.items()}
    else:
        frames, biases = recorded_pictures(folder, tuple(mount.name for mount in chosen)), {}
    found = {name: _calibrated(name, these, layout) for name, these in frames.items()}

    def draw() -> Figure:
        return calibration_picture(layout, frames, found)

    source = "simulated cameras" if folder is None else str(folder)
    return Report(
        fields={
            "cell": layout.name,
            "source": source,
            "frames": {name: len(these) for name, these in frames.items()},
            "cameras": fields_of(found),
            "depth_off_truth": {
                name: _off_truth(found[name], bias) for name, bias in biases.items()
            },
        },
        shown=_shown(layout, frames, found, biases),
        draw=draw,
        holds=all(one.residual <= LIMIT for one in found.values()),
    )


def simulated_cameras(
    layout: CellLayout, mounts: tuple[CameraMount, ...], seed: int
) -> tuple[dict[str, CameraModel], Snapshot]:
    """The simulated cameras before a loaded pallet, and the moment: the arm is parked."""
    fits = [one for one in shipped_deliveries() if one.pallet_size == layout.pallet.size]
    cases = cases_of(fits[0], fits[0].stack or (), layout) if fits else ()
    drawn = CellScene(layout, cases)
    models = {mount.name: CameraModel(drawn, mount, seed) for mount in mounts}
    return models, parked(layout, cases)


def recorded_pictures(folder: Path, cameras: tuple[str, ...]) -> Pictures:
    """Pictures from folders: one folder of frames for each camera, named after it.

    The frames may lie in the folder itself where only one camera is asked for.

    Raises:
        FrameError: there are none, or one cannot be used.
    """
    own = {name: folder / name for name in cameras if (folder / name).is_dir()}
    if not own and len(cameras) == 1:
        own = {cameras[0]: folder}
    if not own:
        what = "has no folder named after a camera"
        expected = f"frames in one of {', '.join(cameras)}, or --camera for frames of one"
        raise FrameError(str(folder), [Problem("", what, expected)])
    return {
        name: tuple(read_frame_folder(one).as_frame() for one in frame_folders(path))
        for name, path in own.items()
    }


def _calibrated(name: str, frames: tuple[Frame, ...], layout: CellLayout) -> Calibration:
    try:
        return calibrate(frames, layout.fiducials, layout.fixtures)
    except FrameError as error:
        raise FrameError(f"camera {name}", error.problems) from error


def _shown(
    layout: CellLayout,
    frames: Pictures,
    found: Mapping[str, Calibration],
    biases: Mapping[str, float],
) -> list[RenderableType]:
    mounts = {mount.name: mount for mount in layout.cameras}
    columns = ["camera", "x, y, z [m]", "from the cell file", "depth scale", "residual", "markers"]
    columns += ["depths off the truth"] if biases else []
    table = plain_table(f"{layout.name}: cameras by their markers", *columns)
    lines = list[RenderableType]()
    for name, one in found.items():
        shift, turn = _apart(one.cell_from_camera, mounts[name].cell_from_camera)
        there = checked(frames[name][0], layout.fiducials, one)
        offset = f" {1000 * one.depth.offset:+.1f} mm" if one.depth.offset else ""
        unknown = one.depth.planes == 0
        table.row(
            name,
            ", ".join(f"{value:.4f}" for value in one.cell_from_camera.translation),
            f"{1000 * shift:.1f} mm, {math.degrees(turn):.2f} deg",
            "unknown" if unknown else f"{one.depth.scale:.4f} ±{one.depth.error:.4f}{offset}",
            f"{1000 * one.residual:.1f} mm",
            f"{one.markers} of {len(there.expected.keys() | one.seen.keys())}",
            *([f"{100 * _off_truth(one, biases[name]):+.2f} %"] if biases else []),
        )
        if one.residual > LIMIT:
            worst = max(one.seen, key=lambda pattern: one.seen[pattern])
            what = (
                f"camera {name}: rays miss the markers by {1000 * one.residual:.1f} mm, at most "
                f"{1000 * LIMIT:.0f} mm are allowed; marker {worst} is farthest from its place in "
                f"the cell file, {1000 * one.seen[worst]:.1f} mm"
            )
            lines.append(Text(what, style="red"))
        if unknown:
            what = f"camera {name}: no depth was measured on its markers; its scale stays 1"
            lines.append(Text(what, style="yellow"))
    return [table, *lines]


def _off_truth(found: Calibration, bias: float) -> float:
    """How far a depth of a simulated camera is off once it is calibrated, as a share of it."""
    told = NEAR * (1.0 + bias)
    return (found.depth.scale * told + found.depth.offset) / NEAR - 1.0


def _apart(one: Pose, other: Pose) -> tuple[float, float]:
    """How far two poses are apart: [m], [rad]."""
    way = other.inverse @ one
    turn = float(Rotation.from_matrix(np.array(way.rotation)).magnitude())
    return math.dist(one.translation, other.translation), turn
