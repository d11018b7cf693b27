"""Whether a cell file agrees with itself, once every value in it is sound."""

import math
from collections.abc import Iterable, Iterator

from depal.cell.files.cell_model import CameraEntry, CellEntry, ReaderEntry
from depal.cell.files.places_model import ModelEntry
from depal.cell.files.robot_model import RobotEntry
from depal.cell.files.tool_model import FrontEntry, SuctionEntry
from depal.logistics.findings import Finding, Loc, choices

_ROUNDING = 1e-9


def contradictions(cell: CellEntry) -> Iterator[Finding]:
    """Everything in a file that contradicts something else in it.

    Args:
        cell: the file's values, each sound on its own.

    Yields:
        One finding per contradiction.
    """
    yield from _axes(cell.robot)
    yield from _module(("tool", "front"), cell.tool.front, cell.tool.suction)
    yield from _module(("tool", "lower"), cell.tool.lower, cell.tool.suction)
    if cell.tool.mass >= cell.robot.payload:
        what = f"{cell.tool.mass:g} kg is all that the robot may carry"
        yield Finding(("tool", "mass"), what, f"less than {cell.robot.payload:g} kg")
    yield from _names(cell)
    for index, model in enumerate(cell.places.models):
        yield from _model(("places", "models", index), model)
    yield from _sights(cell)
    yield from _fiducials(cell)
    floor = cell.safety.floor
    for axis, name in enumerate("xy"):
        if not floor.lower[axis] < floor.upper[axis]:
            what = f"the floor has no extent along {name}"
            yield Finding(("safety", "floor"), what, "lower below upper")


def _axes(robot: RobotEntry) -> Iterator[Finding]:
    for index, (axis, parked) in enumerate(zip(robot.axes, robot.parked, strict=True)):
        if not axis.lower < axis.upper:
            what = f"lower {axis.lower:g} is not below upper {axis.upper:g}"
            yield Finding(("robot", "axes", index), what)
        elif not axis.lower <= parked <= axis.upper:
            expected = f"{axis.lower:g} to {axis.upper:g}"
            what = f"{parked:g} deg is outside the limits of the axis"
            yield Finding(("robot", "parked", index), what, expected)


def _module(loc: Loc, module: FrontEntry, suction: SuctionEntry) -> Iterator[Finding]:
    cups = module.cups
    for axis, (name, count) in enumerate((("y", cups.along_y), ("z", cups.along_z))):
        extent = (count - 1) * cups.pitch + suction.cup_diameter
        if extent > module.size[axis] + _ROUNDING:
            what = (
                f"the cups are {extent:.3g} m wide along {name}, the module {module.size[axis]:g}"
            )
            yield Finding((*loc, "cups"), what, "cups within the module")
    if max(cups.along_y, cups.along_z) > 1 and cups.pitch < suction.cup_diameter - _ROUNDING:
        what = f"cups of {suction.cup_diameter:g} m overlap at a pitch of {cups.pitch:g} m"
        yield Finding((*loc, "cups", "pitch"), what)


def _names(cell: CellEntry) -> Iterator[Finding]:
    places = cell.places
    models = [model.name for model in places.models]
    storages = [storage.name for storage in places.storages]
    yield from _repeated(("places", "models"), models)
    yield from _repeated(("places", "storages"), storages)
    yield from _repeated(("camera",), [camera.name for camera in cell.camera])
    yield from _repeated(("zones",), [zone.name for zone in cell.zones])
    for index, storage in enumerate(places.storages):
        if storage.model not in models:
            what = f"there is no model '{storage.model}'"
            loc: Loc = ("places", "storages", index, "model")
            yield Finding(loc, what, exists=choices(storage.model, models))
    if places.aside not in storages:
        what = f"there is no storage '{places.aside}'"
        yield Finding(("places", "aside"), what, exists=choices(places.aside, storages))


def _fiducials(cell: CellEntry) -> Iterator[Finding]:
    first: dict[int, int] = {}
    for index, fiducial in enumerate(cell.fiducials):
        loc: Loc = ("fiducials", index)
        earlier = first.setdefault(fiducial.id, index)
        if earlier != index:
            what = f"{fiducial.id} is already the pattern of"
            yield Finding((*loc, "id"), what, "every pattern once", twin=("fiducials", earlier))
        if math.hypot(*fiducial.normal) < _ROUNDING:
            yield Finding((*loc, "normal"), "points nowhere", "a direction, such as [0, 0, 1]")


def _repeated(loc: Loc, names: Iterable[str]) -> Iterator[Finding]:
    first: dict[str, int] = {}
    for index, name in enumerate(names):
        earlier = first.setdefault(name, index)
        if earlier != index:
            twin: Loc = (*loc, earlier)
            what = f"'{name}' is already the name of"
            yield Finding((*loc, index, "name"), what, "every name once", twin=twin)


def _model(loc: Loc, model: ModelEntry) -> Iterator[Finding]:
    width, depth, height = model.size
    if 2 * model.wall >= width or model.wall >= depth:
        yield Finding((*loc, "wall"), "the walls leave no room inside")
    top = model.base
    for index, level in enumerate(model.levels):
        here = (*loc, "levels", index)
        if level.floor < top + model.board - _ROUNDING:
            expected = f"{top + model.board:g} m or higher, with the board under it"
            below = "the level below it" if index else "the base"
            what = f"{level.floor:g} m reaches into {below}, which ends at {top:g} m"
            yield Finding((*here, "floor"), what, expected)
        top = level.floor + level.height
    if top > height + _ROUNDING:
        what = f"the highest level ends at {top:g} m, the storage at {height:g} m"
        yield Finding((*loc, "levels"), what, "levels within the storage's height")


def _sights(cell: CellEntry) -> Iterator[Finding]:
    lenses: list[tuple[Loc, CameraEntry | ReaderEntry]] = [
        *((("camera", index), camera) for index, camera in enumerate(cell.camera)),
        (("reader",), cell.reader),
    ]
    for loc, lens in lenses:
        if math.dist(lens.at, lens.look_at) < _ROUNDING:
            yield Finding((*loc, "look_at"), "is where the lens is", "a point before the lens")
