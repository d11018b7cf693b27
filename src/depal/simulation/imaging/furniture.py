"""The still parts of a cell as triangles: floor, fence line, pallet, storages, fixtures."""

from depal.domain import CellLayout, PalletStand, Storage
from depal.geometry import OrientedBox, Pose
from depal.simulation.imaging.mesh import Mesh, cuboid, joined, rectangle

FENCE = 0.05
"""Width of the line on the floor where the fence stands [m]."""

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
    beyond = 0.3

    def flat(x: float, y: float, z: float, along: float, across: float, skin: int) -> Mesh:
        return rectangle(Pose((x, y, z), FACE_DOWN), (along, across), skin, part)

    above, longer = 0.002, size[0] + FENCE
    return joined(
        [
            flat(*middle, 0.0, size[0] + 2 * beyond, size[1] + 2 * beyond, ground),
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


def storage(shelf: Storage, skin: int, part: int, back: int | None = None) -> Mesh:
    """The panels of a trolley or a shelf.

    Args:
        shelf: which.
        skin: its colour.
        part: its number in pictures.
        back: the number of those panels that stand at its back, the same where nothing is said.
    """
    depth = shelf.size[1]
    meshes = []
    for panel in shelf.panels:
        at_back = panel.centre[0] > depth * 0.8 and panel.size[0] < depth / 2
        own = back if back is not None and at_back else part
        meshes.append(solid(panel.seen_from(shelf.cell_from_storage), skin, own))
    return joined(meshes)
