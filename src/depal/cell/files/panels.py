"""The solid parts of a trolley or a shelf, and its places, from a few measures."""

from dataclasses import dataclass

from depal.domain import Place, PlaceId
from depal.geometry import OrientedBox, Pose, Vector3

_CLEAR_OF_GROUND = 0.005
"""Solid parts begin above the ground [m], so that they never count as touching it."""


@dataclass(frozen=True, slots=True)
class Level:
    """One level of a storage.

    Attributes:
        floor: what boxes stand on, above the ground [m].
        height: clear height above it [m].
    """

    floor: float
    height: float


@dataclass(frozen=True, slots=True)
class Body:
    """The measures of a trolley or a shelf.

    Attributes:
        size: width, depth and height over all [m].
        wall: thickness of the sides and the back [m].
        board: thickness of what boxes stand on [m].
        base: height of the wheels and the frame [m]; may be none.
        levels: from the lowest up.
    """

    size: Vector3
    wall: float
    board: float
    base: float
    levels: tuple[Level, ...]

    @property
    def opening_width(self) -> float:
        """Between the sides [m]."""
        return self.size[0] - 2 * self.wall

    @property
    def inner_depth(self) -> float:
        """From the front to the back [m]."""
        return self.size[1] - self.wall


def solid_parts(body: Body) -> tuple[OrientedBox, ...]:
    """Sides, back, boards and base.

    Args:
        body: the measures.

    Returns:
        The parts in the storage's frame: x to the back from the middle of the front, z up.
    """
    width, depth, height = body.size
    wall, bottom = body.wall, _CLEAR_OF_GROUND
    side = (depth, wall, height - bottom)
    up = bottom + side[2] / 2
    parts = [
        _part((depth / 2, (width - wall) / 2, up), side),
        _part((depth / 2, -(width - wall) / 2, up), side),
        _part((depth - wall / 2, 0.0, up), (wall, body.opening_width, side[2])),
    ]
    inside = (body.inner_depth, body.opening_width)
    parts += [
        _part((inside[0] / 2, 0.0, level.floor - body.board / 2), (*inside, body.board))
        for level in body.levels
    ]
    if body.base > bottom:
        parts.append(
            _part((inside[0] / 2, 0.0, (bottom + body.base) / 2), (*inside, body.base - bottom))
        )
    return tuple(parts)


def places_of(body: Body, name: str, cell_from_storage: Pose) -> tuple[Place, ...]:
    """The compartments, from the lowest up.

    Args:
        body: the measures.
        name: of the storage; places are called name/level_1 and so on.
        cell_from_storage: where it stands.
    """
    return tuple(
        Place(
            id=PlaceId(f"{name}/level_{number}"),
            cell_from_place=cell_from_storage @ Pose((0.0, 0.0, level.floor)),
            opening=(body.opening_width, level.height),
            depth=body.inner_depth,
        )
        for number, level in enumerate(body.levels, start=1)
    )


def _part(centre: Vector3, size: Vector3) -> OrientedBox:
    return OrientedBox(Pose(centre), size)
