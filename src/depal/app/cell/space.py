"""The cell in perspective, from behind the robot's left shoulder."""

import itertools
from collections.abc import Iterator, Mapping
from dataclasses import replace

import numpy as np
import numpy.typing as npt
from matplotlib.axes import Axes

from depal.app.cell.shading import Mesh, Perspective, box_mesh, capsule_mesh, shaded
from depal.cell.checking.posture import posture
from depal.cell.checking.standing import load_room
from depal.domain import CellLayout, PlaceId, Storage
from depal.geometry import OrientedBox, Pose
from depal.studies.drawing.palette import (
    ASKED,
    CASE_EDGE,
    CHANGED,
    PAPER,
    WOOD,
    Colour,
    blend,
)

ARM: Colour = (0.96, 0.58, 0.20)
TOOL: Colour = (0.42, 0.45, 0.48)
STEEL: Colour = (0.86, 0.88, 0.90)
GROUND: Colour = (0.955, 0.955, 0.945)
_DARK: Colour = (0.35, 0.37, 0.40)

SCALE = 2
"""The picture is computed this much finer, and then averaged."""

_FILLED = 0.98


def draw_space(
    axes: Axes, layout: CellLayout, pixels: tuple[int, int], reached: Mapping[PlaceId, float]
) -> None:
    """Draws a cell in perspective over the whole of some axes.

    Args:
        axes: bare ones.
        layout: the cell.
        pixels: width and height of the picture.
        reached: share of each place that is reached, in [0, 1].
    """
    view = _view(layout, pixels)
    fine = shaded(view, list(_meshes(layout, reached)), PAPER)
    width, height = pixels
    picture = fine.reshape(height, SCALE, width, SCALE, 3).mean(axis=(1, 3))
    axes.imshow(np.clip(picture, 0, 1), extent=(0, width, height, 0), interpolation="none")
    for line in _edges(load_room(layout.pallet)):
        flat = view.project(line)[:, :2] / SCALE
        axes.plot(*flat.T, color=CASE_EDGE, linewidth=0.9, linestyle=(0, (4, 3)))
    for line in (edge for zone in layout.zones for edge in _edges(zone.solid)):
        flat = view.project(line)[:, :2] / SCALE
        axes.plot(*flat.T, color=CHANGED, linewidth=0.9)
    axes.set_xlim(0, width)
    axes.set_ylim(height, 0)


def _view(layout: CellLayout, pixels: tuple[int, int]) -> Perspective:
    """The view in which the floor and what stands on it fill the picture."""
    (x_low, y_low), (x_high, y_high) = layout.floor
    span = max(x_high - x_low, y_high - y_low)
    x, y = (x_low + x_high) / 2, (y_low + y_high) / 2
    width, height = SCALE * pixels[0], SCALE * pixels[1]
    view = Perspective(
        eye=(x - 1.10 * span, y + 0.60 * span, 1.45 * span),
        target=(x, y, 0.0),
        width=width,
        height=height,
        focal=1.0,
        middle=(0.0, 0.0),
    )
    ground = [(*corner, 0.0) for corner in itertools.product((x_low, x_high), (y_low, y_high))]
    flat = view.project([*ground, *load_room(layout.pallet).corners.tolist()])[:, :2]
    low, high = flat.min(axis=0), flat.max(axis=0)
    focal = _FILLED * float(min(np.array((width, height)) / (high - low)))
    shift = np.array((width, height)) / 2 - focal * (low + high) / 2
    return replace(view, focal=focal, middle=(float(shift[0]), float(shift[1])))


def _meshes(layout: CellLayout, reached: Mapping[PlaceId, float]) -> Iterator[Mesh]:
    (x_low, y_low), (x_high, y_high) = layout.floor
    size = (x_high - x_low, y_high - y_low, 0.02)
    middle = ((x_low + x_high) / 2, (y_low + y_high) / 2, -0.012)
    yield box_mesh(OrientedBox(Pose(middle), size), GROUND)
    length, width, deck = layout.pallet.size
    board = OrientedBox.from_corner((0.0, 0.0, -0.03), (length, width, 0.03))
    yield box_mesh(board.seen_from(layout.pallet.cell_from_pallet), WOOD)
    for share in (0.0, 0.5, 1.0):
        corner = (share * (length - 0.1), 0.0, -deck)
        foot = OrientedBox.from_corner(corner, (0.1, width, deck - 0.03))
        yield box_mesh(foot.seen_from(layout.pallet.cell_from_pallet), WOOD)
    for storage in layout.storages:
        yield from _storage(storage, reached)
    for fixture in layout.fixtures:
        yield box_mesh(fixture, _DARK)
    arm = posture(layout.robot, layout.tool, layout.robot.parked)
    for start, end, radius in zip(arm.starts, arm.ends, arm.radii, strict=True):
        yield capsule_mesh(start, end, float(radius), ARM)
    for box in arm.tool:
        yield box_mesh(box, TOOL)


def _storage(storage: Storage, reached: Mapping[PlaceId, float]) -> Iterator[Mesh]:
    floors = {place.cell_from_place.translation[2]: place.id for place in storage.places}
    for panel in storage.panels:
        top = panel.centre[2] + panel.size[2] / 2
        place = next((name for z, name in floors.items() if abs(z - top) < 1e-6), None)  # noqa: PLR2004
        colour = STEEL
        if place is not None and place in reached:
            colour = blend(blend(CHANGED, ASKED, reached[place]), PAPER, 0.45)
        yield box_mesh(panel.seen_from(storage.cell_from_storage), colour)


def _edges(box: OrientedBox) -> Iterator[npt.NDArray[np.float64]]:
    """The edges of a box, as lines: of the room for the highest load, of a zone."""
    corners = box.corners
    for a in range(8):
        for bit in (1, 2, 4):
            if not a & bit:
                yield corners[[a, a | bit]]
