"""What stands in a place, what is to go into it, and where it could go.

The frame of all of it is the place's: x into the compartment from the plane of the opening,
y left, z up from the floor; the middle of the opening's lower edge is the origin. In it boxes are
axis-aligned: their depth is along x, their width along y, their height along z.
"""

import math
from collections.abc import Iterable
from dataclasses import dataclass

from depal.domain import BoxId, PlaceId
from depal.geometry import OrientedBox, Pose, Vector3


@dataclass(frozen=True, slots=True)
class Standing:
    """A box that stands in a place.

    Attributes:
        id: the box.
        corner: its corner with the smallest coordinates, in the place's frame [m].
        size: depth, width, height as it stands [m].
        mass: [kg]; None where nobody knows.
    """

    id: BoxId
    corner: Vector3
    size: Vector3
    mass: float | None = None

    @property
    def volume(self) -> float:
        """Of the box [m^3]."""
        return math.prod(self.size)


@dataclass(frozen=True, slots=True)
class Envelope:
    """A part of the tool that comes in with the box, as far as it matters for a straight way in.

    Everything is relative to the middle of the lower edge of the box's outward face. Whatever is
    nearer to the opening than `reach` is taken, for the part comes from there.

    Attributes:
        reach: how far the part reaches beyond the outward face, into the place [m]; negative for
            a tool that stays in front of the box.
        left: its greatest y [m].
        right: its smallest y [m].
        low: its smallest z, from the box's bottom [m].
        high: its greatest z [m].
    """

    reach: float
    right: float
    left: float
    low: float
    high: float

    @classmethod
    def around(cls, solid: OrientedBox, size: Vector3) -> "Envelope":
        """The envelope of a solid part.

        Args:
            solid: the part, seen from the held box's centre with the axes of the place.
            size: depth, width, height of the held box [m].
        """
        low, high = solid.corners.min(axis=0).tolist(), solid.corners.max(axis=0).tolist()
        depth, _, height = size
        return cls(
            reach=high[0] + depth / 2,
            right=low[1],
            left=high[1],
            low=low[2] + height / 2,
            high=high[2] + height / 2,
        )


def envelopes(solids: Iterable[OrientedBox], size: Vector3) -> tuple[Envelope, ...]:
    """The envelopes of a tool's solid parts; see `Envelope.around`."""
    return tuple(Envelope.around(solid, size) for solid in solids)


@dataclass(frozen=True, slots=True)
class Held:
    """A box as it would be pushed into a place.

    Attributes:
        size: depth along the way in, width, height [m].
        mass: [kg]; None where nobody knows.
        tool: what comes in with it.
    """

    size: Vector3
    mass: float | None = None
    tool: tuple[Envelope, ...] = ()


@dataclass(frozen=True, slots=True)
class Margins:
    """How much room a box is given.

    Attributes:
        clearance: to boxes and walls, sideways and to the back [m].
        lift: how far above its spot it is pushed in [m].
        skim: from its raised bottom to the boxes that it passes over [m].
        above: from its raised top, and from the tool all round its heights, to anything [m].
        level: how far the tops that carry it may differ [m].
        support: the least share of its base that is carried. Beyond one half the centre is always
            between the parts that carry: half planes through the centre hold half of the base.
        heavier: how many times as heavy as a box that carries it a box may be.
    """

    clearance: float = 0.010
    lift: float = 0.015
    skim: float = 0.008
    above: float = 0.005
    level: float = 0.004
    support: float = 0.75
    heavier: float = 2.0


MARGINS = Margins()
"""The usual ones."""


@dataclass(frozen=True, slots=True)
class Spot:
    """Where a box could stand.

    Attributes:
        place: the compartment.
        corner: the box's corner with the smallest coordinates, in the place's frame [m].
        size: depth, width, height of the box as it would stand [m].
        carried_by: the boxes that it would stand on; empty on the floor.
        cost: what it spoils, to be compared with other spots for the same box; smallest is best.
    """

    place: PlaceId
    corner: Vector3
    size: Vector3
    carried_by: tuple[BoxId, ...] = ()
    cost: float = 0.0

    @property
    def depth(self) -> float:
        """How far behind the opening its outward face is [m]."""
        return self.corner[0]

    @property
    def place_from_box(self) -> Pose:
        """Its pose, the box's frame in its centre with the axes of the place."""
        (x, y, z), (depth, width, height) = self.corner, self.size
        return Pose((x + depth / 2, y + width / 2, z + height / 2))

    def standing(self, box: BoxId, mass: float | None = None) -> Standing:
        """The box as it stands there afterwards."""
        return Standing(box, self.corner, self.size, mass)
