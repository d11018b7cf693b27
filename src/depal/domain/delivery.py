"""A delivery: the note that says what comes, and the pallet that it comes on."""

from dataclasses import dataclass

from depal.domain.box import Box
from depal.domain.names import BoxId, Gtin
from depal.domain.product import Product
from depal.geometry import OrientedBox, Pose, Vector3

EURO_PALLET: Vector3 = (1.2, 0.8, 0.144)
"""Length, width and deck height of the pallet that the default cell takes [m]."""

STACK_TOLERANCE = 0.001
"""How far the cases of a delivery's stack may overlap or hang apart and still be believed [m]."""

PALLET_FRONT_X = 1.4
"""Where the default cell's pallet begins, seen from the robot's base [m]."""


@dataclass(frozen=True, slots=True)
class DeliveryLine:
    """One line of the note: how many cases of which product."""

    product: Product
    count: int


@dataclass(frozen=True, slots=True)
class StackedCase:
    """Where one case really stands; for the simulated world and the tests alone.

    Attributes:
        gtin: its product.
        corner: its corner with the smallest coordinates, in the pallet's frame [m].
        size: its edges along x, y, z of the pallet's frame [m].
    """

    gtin: Gtin
    corner: Vector3
    size: Vector3

    @property
    def in_pallet(self) -> OrientedBox:
        """The case as a box in the pallet's frame."""
        return OrientedBox.from_corner(self.corner, self.size)


@dataclass(frozen=True, slots=True)
class Delivery:
    """What comes to the cell.

    The pallet's frame: x along the pallet's length, y along its width, z up from the deck,
    origin in a corner of the deck.

    Attributes:
        id: its name.
        pallet_size: length, width and deck height of the pallet [m].
        lines: the note (B_pall by product); each product once.
        stack: where every case stands, unordered; None where only the note is known.
    """

    id: str
    pallet_size: Vector3
    lines: tuple[DeliveryLine, ...]
    stack: tuple[StackedCase, ...] | None = None

    @property
    def products(self) -> dict[Gtin, Product]:
        """The products on the note by their number."""
        return {line.product.gtin: line.product for line in self.lines}

    @property
    def boxes(self) -> tuple[Box, ...]:
        """Every case that the note promises: B_pall (section II-C)."""
        return tuple(
            Box(BoxId(f"{line.product.gtin}/{number}"), line.product)
            for line in self.lines
            for number in range(1, line.count + 1)
        )

    @property
    def mass(self) -> float:
        """Of all cases together [kg]."""
        return sum(line.count * line.product.mass for line in self.lines)


def cell_from_pallet(pallet_size: Vector3, front_x: float = PALLET_FRONT_X) -> Pose:
    """Where a pallet stands in the cell: its long side is the front, centred on the x axis.

    Args:
        pallet_size: length, width and deck height [m].
        front_x: the x of the pallet's front side in the cell frame [m].

    Returns:
        The pose that carries the pallet's frame into the cell frame.
    """
    length, _, deck_height = pallet_size
    turn = ((0.0, 1.0, 0.0), (-1.0, 0.0, 0.0), (0.0, 0.0, 1.0))
    return Pose((front_x, length / 2, deck_height), turn)
