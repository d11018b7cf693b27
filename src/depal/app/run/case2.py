"""The paper's second case study as a delivery: ten cases in one frontal line (section III-C)."""

from depal.domain import (
    EURO_PALLET,
    PALLET_FRONT_X,
    BoxId,
    Delivery,
    DeliveryLine,
    Gtin,
    Product,
    Request,
    StackedCase,
    cell_from_pallet,
)
from depal.geometry import Vector3
from depal.studies import paper
from depal.studies.case2 import REQUESTED, Layout, boxes_of

NAME = "case2"

LAYOUT = Layout((5, 5), 0.23)
"""The layout of Fig. 10 at a width at which five cases fit a Euro pallet's front [m]."""

MASS = 4.0
"""Of a case; the paper does not say [kg]."""

_FIRST_ARTICLE = 900_000_00


def case2_delivery() -> Delivery:
    """Ten cases, each of a product of its own; the first of the stack is b1."""
    to_pallet = cell_from_pallet(EURO_PALLET, PALLET_FRONT_X).inverse
    stack, lines = [], []
    for number, box in enumerate(boxes_of(LAYOUT), start=1):
        depth, width, height = box.shape.size
        x, y, z = to_pallet.apply(box.shape.centre)
        z += EURO_PALLET[2]  # the study's boxes stand at z = 0, the pallet's on its deck
        gtin = _gtin(number)
        product = Product(gtin, f"case {box.id}", (width, depth, height), MASS)
        corner = (_mm(x - width / 2), _mm(y - depth / 2), _mm(z - height / 2))
        stack.append(StackedCase(gtin, corner, (width, depth, height)))
        lines.append(DeliveryLine(product, 1))
    return Delivery(NAME, EURO_PALLET, tuple(lines), tuple(stack))


def case2_requests() -> tuple[Request, ...]:
    """b1 with its low priority, known from the start."""
    return (Request(priority=paper.CASE_2_PRIORITY, box=REQUESTED),)


def case2_names() -> tuple[tuple[BoxId, Vector3], ...]:
    """The paper's names of the boxes, by where they stand in the cell [m]."""
    deck = cell_from_pallet(EURO_PALLET, PALLET_FRONT_X).translation[2]
    return tuple(
        (box.id, (box.shape.centre[0], box.shape.centre[1], box.shape.centre[2] + deck))
        for box in boxes_of(LAYOUT)
    )


def _gtin(number: int) -> Gtin:
    """A made-up GTIN-14 for use in a store, as the shipped deliveries have."""
    body = f"12000{_FIRST_ARTICLE + number:08d}"
    total = sum(int(digit) * (3 if place % 2 == 0 else 1) for place, digit in enumerate(body))
    return Gtin(f"{body}{-total % 10}")


def _mm(length: float) -> float:
    """Without the last bits of rounding, and without a minus before zero [m]."""
    return round(float(length), 6) + 0.0
