"""Whether everything in a cell stands inside the fence and nothing stands in anything else."""

import itertools
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from depal.cell.checking.findings import CellFinding, error, warning
from depal.domain import CellLayout, PalletStand, Storage
from depal.geometry import OrientedBox, Pose, prisms_of
from depal.geometry.prism import HALF_HEIGHT, Z, footprint_overlap

_TOUCHING = 0.002
"""Things that reach into each other by no more are side by side [m]."""

LOAD_HEIGHT = 1.75
"""How high a load may reach above the floor [m] (CELL.md)."""

_GROUND_SLACK = 1e-6


@dataclass(frozen=True, slots=True)
class Standing:
    """Something that takes room in the cell.

    Attributes:
        name: what it is called in messages.
        parts: its room, in the cell frame.
    """

    name: str
    parts: tuple[OrientedBox, ...]


def standing_things(layout: CellLayout) -> list[Standing]:
    """Everything in a cell but the arm's moving parts.

    Args:
        layout: the cell.

    Returns:
        The robot's base, the pallet with the highest load, the storages and the fixtures.
    """
    fixtures = [
        Standing(f"fixture {number}", (box,)) for number, box in enumerate(layout.fixtures, start=1)
    ]
    storages = [Standing(storage.id, (_body(storage),)) for storage in layout.storages]
    pallet = Standing("pallet", (load_room(layout.pallet),))
    return [Standing("robot", _base(layout)), pallet, *storages, *fixtures]


def check_standing(layout: CellLayout) -> Iterator[CellFinding]:
    """What stands in something else, or outside the fence.

    Args:
        layout: the cell.

    Yields:
        One error per pair that overlaps, and per thing outside the floor.
    """
    things = standing_things(layout)
    for one, other in itertools.combinations(things, 2):
        if one.name.startswith("fixture") and other.name.startswith("fixture"):
            continue  # a post and what it carries may well be one piece
        depth = _overlap(one.parts, other.parts)
        if depth > _TOUCHING:
            yield error(one.name, f"overlaps {other.name} by {depth:.3f} m", "room for each")
    (x_low, y_low), (x_high, y_high) = layout.floor
    for thing in things:
        corners = np.concatenate([part.corners for part in thing.parts])
        out = max(
            x_low - float(corners[:, 0].min()),
            y_low - float(corners[:, 1].min()),
            float(corners[:, 0].max()) - x_high,
            float(corners[:, 1].max()) - y_high,
        )
        if out > _GROUND_SLACK:
            floor = f"within x {x_low:g} .. {x_high:g}, y {y_low:g} .. {y_high:g}"
            yield error(thing.name, f"stands {out:.3f} m outside the floor", floor)
    yield from _facing(layout)
    base = _base(layout)
    for zone in layout.zones:
        if _overlap(base, (zone.solid,)) > _TOUCHING:
            what = "holds the robot's base: no motion could keep out of it"
            yield error(f"zone {zone.name}", what, "a zone beside the robot")


def load_room(pallet: PalletStand, height: float = LOAD_HEIGHT) -> OrientedBox:
    """The room of a pallet and the highest load on it, in the cell frame.

    Args:
        pallet: where it stands.
        height: of the load's top above the floor [m].
    """
    length, width, deck = pallet.size
    box = OrientedBox.from_corner((0.0, 0.0, -deck), (length, width, height))
    return box.seen_from(pallet.cell_from_pallet)


def _facing(layout: CellLayout) -> Iterator[CellFinding]:
    """Storages that turn their back on the robot."""
    for storage in layout.storages:
        x, y, _ = storage.cell_from_storage.translation
        rows = storage.cell_from_storage.rotation
        if x * rows[0][0] + y * rows[1][0] <= 0:
            yield warning(storage.id, "its opening does not face the robot", "another turn")


def _base(layout: CellLayout) -> tuple[OrientedBox, ...]:
    """What of the arm never moves, as upright boxes around its capsules."""
    boxes = []
    for shape in layout.robot.shapes:
        if shape.link == 0:
            ends = np.array((shape.start, shape.end))
            low, high = ends.min(axis=0) - shape.radius, ends.max(axis=0) + shape.radius
            middle, size = (low + high) / 2, high - low
            boxes.append(OrientedBox(Pose.from_arrays(middle, np.eye(3)), _three(size)))
    return tuple(boxes)


def _three(values: np.ndarray[tuple[int], np.dtype[np.float64]]) -> tuple[float, float, float]:
    return float(values[0]), float(values[1]), float(values[2])


def _body(storage: Storage) -> OrientedBox:
    width, depth, height = storage.size
    box = OrientedBox(Pose((depth / 2, 0.0, height / 2)), (depth, width, height))
    return box.seen_from(storage.cell_from_storage)


def _overlap(one: Sequence[OrientedBox], other: Sequence[OrientedBox]) -> float:
    """How deep two things reach into each other at the most [m]; not positive when apart."""
    deepest = -np.inf
    prisms = prisms_of([*one, *other])
    for a, b in itertools.product(range(len(one)), range(len(one), len(prisms))):
        height = prisms[a, HALF_HEIGHT] + prisms[b, HALF_HEIGHT] - abs(prisms[a, Z] - prisms[b, Z])
        deepest = max(deepest, min(float(height), footprint_overlap(prisms, a, b)))
    return deepest
