"""Pictures of shipped cells by their simulated cameras, for tests of markers and frames."""

import functools
from dataclasses import replace

from depal.cell.files import shipped_cell
from depal.domain import CameraMount, CellLayout
from depal.geometry import Pose
from depal.logistics import shipped_deliveries
from depal.ports import Frame
from depal.simulation.cases import Case, cases_of
from depal.simulation.imaging.model import CameraModel
from depal.simulation.imaging.scene import CellScene
from depal.simulation.imaging.severity import Severity
from depal.simulation.scenes.scene import parked
from depal.simulation.world import Snapshot

HIGHEST = max(
    shipped_deliveries(),
    key=lambda delivery: max(case.corner[2] + case.size[2] for case in delivery.stack or ()),
)


@functools.cache
def layout_of(name: str = "default") -> CellLayout:
    """A shipped cell."""
    return shipped_cell(name)


def cases(name: str, share: float = 1.0) -> tuple[Case, ...]:
    """The cases of the highest delivery from the lowest up to a share of them."""
    layout = layout_of(name)
    stack = sorted(HIGHEST.stack or (), key=lambda case: case.corner[2])
    return cases_of(HIGHEST, tuple(stack[: round(share * len(stack))]), layout)


@functools.cache
def drawn(name: str, share: float) -> tuple[CellScene, Snapshot]:
    """A cell with a load, the arm parked."""
    layout, load = layout_of(name), cases(name, share)
    scene = CellScene(layout, load)
    return scene, parked(layout, load)


def mount_of(camera: str, name: str = "default") -> CameraMount:
    """A camera of a cell."""
    return next(mount for mount in layout_of(name).cameras if mount.name == camera)


@functools.cache
def model_of(
    camera: str, share: float, name: str, moved: Pose | None, severity: Severity
) -> CameraModel:
    """A camera before a load, as the cell file has it or moved."""
    mount = mount_of(camera, name)
    there = replace(mount, cell_from_camera=mount.cell_from_camera @ (moved or Pose()))
    return CameraModel(drawn(name, share)[0], there, 5, severity)


def bias_of(camera: str, severity: Severity = Severity.NORMAL) -> float:
    """The share by which every depth of a camera's frames is wrong."""
    return model_of(camera, 1.0, "default", None, severity).bias


@functools.cache
def frame_of(
    camera: str,
    number: int = 0,
    share: float = 1.0,
    name: str = "default",
    moved: Pose | None = None,
    severity: Severity = Severity.NORMAL,
) -> Frame:
    """One picture; a camera that was moved says that it still stands where the cell file has it."""
    model, (_, snapshot) = model_of(camera, share, name, moved, severity), drawn(name, share)
    frame = model.frame(snapshot, 0.5 * number, number)
    return replace(frame, cell_from_camera=mount_of(camera, name).cell_from_camera)
