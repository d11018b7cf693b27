"""The still parts of a cell as triangles: floor, fence line, pallet, storages, fixtures."""

from dataclasses import dataclass

import numpy as np

from depal.domain import CellLayout, Fiducial, PalletStand, Storage
from depal.geometry import OrientedBox, Pose, Vector3
from depal.perception.calibration.markers import PLATE, plate_picture
from depal.simulation.imaging.atlas import AtlasBuilder
from depal.simulation.imaging.mesh import Mesh, cuboid, joined, rectangle

FENCE = 0.05
"""Width of the line on the floor where the fence stands [m]."""

BEYOND = 0.12
"""The floor is drawn so far beyond the fence [m]."""

FACE_DOWN = ((1.0, 0.0, 0.0), (0.0, -1.0, 0.0), (0.0, 0.0, -1.0))
"""Turns a rectangle so that it is seen from above."""

BOARD = 0.022
"""Thickness of a pallet's boards [m]."""


def solid(shape: OrientedBox, skin: int, part: int) -> Mesh:
    """A box in one colour."""
    return cuboid(shape.size, (skin,), part).moved(shape.pose)


def floor(layout: CellLayout, ground: int, line: int, part: int) -> Mesh:
    """The floor up to the fence and a little beyond, and the fence's line."""
    (x0, y0), (x1, y1) = layout.floor
    middle, size = ((x0 + x1) / 2, (y0 + y1) / 2), (x1 - x0, y1 - y0)

    def flat(x: float, y: float, z: float, along: float, across: float, skin: int) -> Mesh:
        return rectangle(Pose((x, y, z), FACE_DOWN), (along, across), skin, part)

    above, longer = 0.002, size[0] + FENCE
    return joined(
        [
            flat(*middle, 0.0, size[0] + 2 * BEYOND, size[1] + 2 * BEYOND, ground),
            flat(middle[0], y0, above, longer, FENCE, line),
            flat(middle[0], y1, above, longer, FENCE, line),
            flat(x0, middle[1], above, FENCE, size[1], line),
            flat(x1, middle[1], above, FENCE, size[1], line),
        ]
    )


def pallet(stand: PalletStand, skin: int, part: int) -> Mesh:
    """Five boards on three beams, on nine blocks, on three boards."""
    length, width, height = stand.size
    rows, across = (0.0725, length / 2, length - 0.0725), (0.05, width / 2, width - 0.05)
    blocks = height - 3 * BOARD
    deck = [width * (0.09 + 0.205 * i) for i in range(5)]
    shapes = [
        *(((length / 2, y, -BOARD / 2), (length, width * 0.16, BOARD)) for y in deck),
        *(((x, width / 2, -1.5 * BOARD), (0.145, width, BOARD)) for x in rows),
        *(((x, y, -2 * BOARD - blocks / 2), (0.145, 0.1, blocks)) for x in rows for y in across),
        *(((length / 2, y, BOARD / 2 - height), (length, 0.1, BOARD)) for y in across),
    ]
    boards = joined([cuboid(size, (skin,), part).moved(Pose(at)) for at, size in shapes])
    return boards.moved(stand.cell_from_pallet)


def fiducials(markers: tuple[Fiducial, ...], builder: AtlasBuilder, part: int) -> list[Mesh]:
    """Markers with their white rims, as flat plates; no plate has a back."""
    return [
        rectangle(
            marker.cell_from_marker,
            (marker.size * PLATE, marker.size * PLATE),
            builder.add(np.repeat(plate_picture(marker.id)[..., None], 3, axis=2)),
            part,
        )
        for marker in markers
    ]


@dataclass(frozen=True, slots=True)
class Wall:
    """The back or a side of a storage.

    Attributes:
        part: its number in pictures.
        at: its middle [m].
        outward: unit normal away from what is stored.
        back: whether it is the back.
    """

    part: int
    at: Vector3
    outward: Vector3
    back: bool


def storage(shelf: Storage, skin: int, part: int) -> tuple[Mesh, tuple[Wall, ...]]:
    """The panels of a trolley or a shelf.

    Args:
        shelf: which.
        skin: its colour.
        part: its number in pictures; its walls have the numbers after it.

    Returns:
        The panels, and which of them are walls.
    """
    meshes, walls = list[Mesh](), list[Wall]()
    turn = Pose(rotation=shelf.cell_from_storage.rotation)
    for panel in shelf.panels:
        placed = panel.seen_from(shelf.cell_from_storage)
        outward = _outward(panel, shelf.size)
        own = part
        if outward is not None:
            own = part + 1 + len(walls)
            walls.append(Wall(own, placed.centre, turn.apply(outward), back=outward[0] > 0.0))
        meshes.append(solid(placed, skin, own))
    return joined(meshes), tuple(walls)


def _outward(panel: OrientedBox, size: Vector3) -> Vector3 | None:
    """Where the outside of a wall is, in the storage's frame; None where it is no wall."""
    width, depth, height = size
    if panel.size[2] < height / 2:
        return None
    if panel.size[0] < depth / 4 and panel.centre[0] > depth / 2:
        return (1.0, 0.0, 0.0)
    if panel.size[1] < width / 4:
        return (0.0, 1.0 if panel.centre[1] > 0.0 else -1.0, 0.0)
    return None
