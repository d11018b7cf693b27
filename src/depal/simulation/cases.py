"""The cases of a delivery as bodies in the cell."""

from dataclasses import dataclass

from depal.domain import CellLayout, Delivery, Gtin, StackedCase
from depal.geometry import OrientedBox


@dataclass(frozen=True, slots=True)
class Case:
    """A box as the simulated world knows it.

    Attributes:
        index: in the delivery's stack.
        gtin: its product.
        mass: [kg].
        shape: where it stands, in the cell frame, and its edges as stacked.
    """

    index: int
    gtin: Gtin
    mass: float
    shape: OrientedBox


def cases_of(
    delivery: Delivery, stack: tuple[StackedCase, ...], layout: CellLayout
) -> tuple[Case, ...]:
    """The cases of a stack where the cell's pallet stands.

    Args:
        delivery: tells the masses.
        stack: where every case stands on the pallet.
        layout: tells where the pallet stands.

    Returns:
        The cases in the order of the stack.
    """
    products = delivery.products
    return tuple(
        Case(
            index,
            case.gtin,
            products[case.gtin].mass,
            case.in_pallet.seen_from(layout.pallet.cell_from_pallet),
        )
        for index, case in enumerate(stack)
    )
