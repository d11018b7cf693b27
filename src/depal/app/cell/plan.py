"""The cell from above: the pallet at the top, as the robot sees it."""

import math
from collections.abc import Mapping
from dataclasses import replace

import numpy as np
import numpy.typing as npt
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection
from matplotlib.patches import Circle, Polygon

from depal.cell.checking.posture import Posture, posture
from depal.domain import CameraMount, CellLayout, PlaceId, ReaderMount, Storage, Zone
from depal.geometry import OrientedBox, Pose
from depal.studies.drawing.lettering import SMALL, write
from depal.studies.drawing.palette import (
    ASKED,
    CASE_EDGE,
    CHANGED,
    GREY,
    HAIR,
    INK,
    OURS,
    WOOD,
    Colour,
    blend,
    darker,
)

Floats = npt.NDArray[np.float64]

MIDDLE = replace(SMALL, across="center", halo=True)
ARM: Colour = (0.93, 0.55, 0.18)
STEEL: Colour = (0.80, 0.83, 0.86)
_VIEW_LENGTH = 2.4


def draw_plan(
    axes: Axes, layout: CellLayout, scale: float, reached: Mapping[PlaceId, float]
) -> None:
    """Draws a cell from above into axes to scale.

    Args:
        axes: their coordinates are the cell's -y to the right and x up [m].
        layout: the cell.
        scale: of the axes [in/m].
        reached: share of each place that is reached, in [0, 1].
    """
    _floor(axes, layout)
    for camera in layout.cameras:
        _view(axes, camera)
    _pallet(axes, layout)
    for storage in layout.storages:
        _storage(axes, storage, layout.aside, reached)
    for fixture in layout.fixtures:
        _rectangle(axes, fixture, GREY, INK, 4)
    for zone in layout.zones:
        _zone(axes, zone)
    _reader(axes, layout.reader)
    _arm(axes, posture(layout.robot, layout.tool, layout.robot.parked), scale)
    geometry = layout.robot.geometry
    radius = geometry.a1 + geometry.c2 + math.hypot(geometry.c3, geometry.a2)
    axes.add_patch(
        Circle((0.0, 0.0), radius, fill=False, edgecolor=ARM, linestyle=(0, (4, 3)), zorder=3)
    )
    at = _flat(radius * math.cos(2.45), radius * math.sin(2.45))
    write(axes, at, f"wrist's reach {radius:.2f} m", replace(MIDDLE, colour=darker(ARM, 0.25)))


def _floor(axes: Axes, layout: CellLayout) -> None:
    (x_low, y_low), (x_high, y_high) = layout.floor
    corners = [_flat(x, y) for x, y in ((x_low, y_low), (x_low, y_high), (x_high, y_high))]
    corners.append(_flat(x_high, y_low))
    axes.add_patch(Polygon(corners, facecolor="none", edgecolor=INK, linewidth=1.4, zorder=1))
    lines = [
        [_flat(x, y_low), _flat(x, y_high)] for x in range(math.ceil(x_low), math.ceil(x_high))
    ]
    lines += [
        [_flat(x_low, y), _flat(x_high, y)] for y in range(math.ceil(y_low), math.ceil(y_high))
    ]
    axes.add_collection(LineCollection(lines, colors=[HAIR], linewidths=0.6, zorder=0))


def _pallet(axes: Axes, layout: CellLayout) -> None:
    pallet = layout.pallet
    length, width, deck = pallet.size
    box = OrientedBox.from_corner((0.0, 0.0, -deck), (length, width, deck))
    _rectangle(axes, box.seen_from(pallet.cell_from_pallet), blend(WOOD, (1, 1, 1), 0.35), WOOD, 2)
    ends = [pallet.cell_from_pallet.apply(point) for point in ((0.0, 0.0, 0.0), (length, 0.0, 0.0))]
    across = [_flat(x, y) for x, y, _ in ends]
    axes.plot(*zip(*across, strict=True), color=CASE_EDGE, linewidth=3.0, zorder=2.5)
    x, y, _ = pallet.cell_from_pallet.apply((length / 2, width / 2, 0.0))
    write(axes, _flat(x, y), "pallet", MIDDLE)
    x, y, _ = pallet.cell_from_pallet.apply((length / 2, width / 6, 0.0))
    write(axes, _flat(x, y), "front", replace(MIDDLE, colour=CASE_EDGE))


def _storage(axes: Axes, storage: Storage, aside: str, reached: Mapping[PlaceId, float]) -> None:
    shares = [reached[place.id] for place in storage.places if place.id in reached]
    colour = STEEL if not shares else blend(CHANGED, ASKED, float(np.mean(shares)))
    width, depth, height = storage.size
    body = OrientedBox(Pose((depth / 2, 0.0, height / 2)), (depth, width, height))
    _rectangle(
        axes, body.seen_from(storage.cell_from_storage), blend(colour, (1, 1, 1), 0.72), GREY, 2
    )
    ends = [
        storage.cell_from_storage.apply((0.0, side * width / 2, 0.0))[:2] for side in (-1.0, 1.0)
    ]
    axes.plot(
        *zip(*(_flat(*end) for end in ends), strict=True), color=colour, linewidth=3.0, zorder=3
    )
    x, y, _ = storage.cell_from_storage.apply((depth * 0.45, 0.0, 0.0))
    name = f"{storage.id} (aside)" if storage.id == aside else storage.id
    write(axes, _flat(x, y), name, replace(MIDDLE, colour=INK))
    if shares:
        x, y, _ = storage.cell_from_storage.apply((depth * 0.45, 0.0, 0.0))
        low = _flat(x, y)
        write(axes, (low[0], low[1] - 0.17), f"{100 * np.mean(shares):.0f} %", MIDDLE)


def _view(axes: Axes, camera: CameraMount) -> None:
    """The wedge that a camera sees at the level of its lens."""
    pose = camera.cell_from_camera
    wide = math.tan(camera.vertical_view / 2) * camera.colour_size[0] / camera.colour_size[1]
    eye = pose.translation
    far = [pose.apply((side * wide * _VIEW_LENGTH, 0.0, _VIEW_LENGTH)) for side in (-1.0, 1.0)]
    corners = [_flat(x, y) for x, y, _ in (eye, *far)]
    axes.add_patch(
        Polygon(corners, facecolor=(*OURS, 0.10), edgecolor=(*OURS, 0.45), linewidth=0.8, zorder=1)
    )
    axes.plot(*_flat(eye[0], eye[1]), marker="o", color=OURS, markersize=5, zorder=6)
    style = replace(MIDDLE, colour=OURS)
    write(axes, (_flat(eye[0], eye[1])[0], _flat(eye[0], eye[1])[1] - 0.17), "camera", style)


def _zone(axes: Axes, zone: Zone) -> None:
    """A volume that tasks may avoid: hatched, for it is nothing solid."""
    points = np.array([_flat(x, y) for x, y, _ in zone.solid.corners.tolist()])
    edge = darker(CHANGED, 0.2)
    axes.add_patch(
        Polygon(
            _outline(points), facecolor="none", edgecolor=edge, hatch="//", linewidth=1.0, zorder=5
        )
    )
    x, y, _ = zone.solid.centre
    write(axes, _flat(x, y), f"zone {zone.name}", replace(MIDDLE, colour=edge))


def _reader(axes: Axes, reader: ReaderMount) -> None:
    pose = reader.cell_from_reader
    half = reader.field[0] / 2
    eye = pose.translation
    far = [pose.apply((side * half, 0.0, reader.distance)) for side in (-1.0, 1.0)]
    corners = [_flat(x, y) for x, y, _ in (eye, *far)]
    axes.add_patch(
        Polygon(corners, facecolor=(*CHANGED, 0.15), edgecolor=CHANGED, linewidth=0.8, zorder=5)
    )
    x, y = _flat(eye[0], eye[1])
    write(axes, (x, y + 0.18), "reader", replace(MIDDLE, colour=CHANGED))


def _arm(axes: Axes, arm: Posture, scale: float) -> None:
    order = np.argsort((arm.starts[:, 2] + arm.ends[:, 2]) / 2)
    for index in order:
        radius = float(arm.radii[index])
        line = [_flat(*arm.starts[index, :2]), _flat(*arm.ends[index, :2])]
        (x0, y0), (x1, y1) = line
        points = 72 * scale * 2 * radius
        for width, colour in ((points, darker(ARM, 0.35)), (points - 1.6, ARM)):
            axes.plot(
                [x0, x1 + 1e-6],
                [y0, y1],
                color=colour,
                linewidth=width,
                solid_capstyle="round",
                zorder=4,
            )
    for box in arm.tool:
        _rectangle(axes, box, blend(INK, (1, 1, 1), 0.35), INK, 4.5)


def _rectangle(axes: Axes, box: OrientedBox, face: Colour, edge: Colour, layer: float) -> None:
    """The outline of a box from above."""
    points = np.array([_flat(x, y) for x, y, _ in box.corners.tolist()])
    axes.add_patch(
        Polygon(_outline(points), facecolor=face, edgecolor=edge, linewidth=0.8, zorder=layer)
    )


def _outline(points: Floats) -> Floats:
    """The hull of eight points: by angle around the middle, which is right for an upright box."""
    outer: Floats = points[np.argsort(np.arctan2(*(points - points.mean(axis=0)).T[::-1]))]
    return outer


def _flat(x: float, y: float) -> tuple[float, float]:
    """A point of the floor in the picture: right is -y, up is x [m]."""
    return -y, x
