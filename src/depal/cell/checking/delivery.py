"""What of a delivery a cell cannot take, as far as its note tells."""

from collections.abc import Iterator

from depal.cell.checking.findings import CellFinding, Weight, error
from depal.domain import CellLayout, Delivery, Place, Product
from depal.errors import Problem
from depal.geometry import Vector3
from depal.motion.grasping import refusal

PALLET_TOLERANCE = 0.005
"""Pallets whose edges differ by no more are the same [m]."""

CLEARANCE = 0.010
"""A box goes through an opening with this much room on each side [m]."""

LIFT = 0.015
"""And is carried in this far above the floor [m]."""


def check_delivery_against_cell(layout: CellLayout, delivery: Delivery) -> tuple[CellFinding, ...]:
    """Everything that the cell cannot do with a delivery, before anything moves.

    Only the note is looked at, not how the cases are stacked; a product passes when one way up
    fits.

    Args:
        layout: the cell.
        delivery: the delivery.

    Returns:
        Errors: a pallet of another size, and products that are too heavy, larger than any
        opening, or without a face for the cups. Each names its product.
    """
    findings = list(_pallet(layout, delivery))
    for line in delivery.lines:
        findings += [
            CellFinding(Weight.ERROR, problem, gtin=line.product.gtin)
            for problem in _product(layout, line.product)
        ]
    return tuple(findings)


def fits(place: Place, size: Vector3) -> bool:
    """Whether a box as it stands, in either quarter turn, goes through an opening and in.

    Args:
        place: the compartment.
        size: two edges of its base, then its height [m].
    """
    width, height = place.opening
    return size[2] + LIFT + CLEARANCE <= height and any(
        across + 2 * CLEARANCE <= width and deep + CLEARANCE <= place.depth
        for across, deep in (size[:2], size[1::-1])
    )


def _pallet(layout: CellLayout, delivery: Delivery) -> Iterator[CellFinding]:
    theirs, ours = delivery.pallet_size, layout.pallet.size
    if any(abs(a - b) > PALLET_TOLERANCE for a, b in zip(theirs, ours, strict=True)):
        what = f"the delivery comes on a pallet of {_edges(theirs)}"
        yield error("pallet", what, f"{_edges(ours)}, which {layout.name} takes")


def _product(layout: CellLayout, product: Product) -> Iterator[Problem]:
    where = f"'{product.gtin}' {product.name}"
    a, b, c = product.size
    ways = ((a, b, c), (a, c, b), (b, c, a))
    said = ""
    for way in ways:
        said = refusal(way, product.mass, layout.tool, layout.robot.payload)
        if not said:
            break
    if said:
        yield Problem(where, f"cannot be held: {said}")
    if not any(fits(place, way) for place in layout.places.values() for way in ways):
        largest = max(layout.places.values(), key=lambda place: place.volume)
        width, height = largest.opening
        exists = f"the largest is {largest.id}: {width:g} x {height:g}, {largest.depth:g} m deep"
        yield Problem(where, f"{_edges(product.size)} fits no opening", exists=exists)


def _edges(size: Vector3) -> str:
    return " x ".join(f"{edge:.6g}" for edge in size) + " m"
