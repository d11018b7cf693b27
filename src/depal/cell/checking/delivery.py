"""What of a delivery a cell cannot take, as far as its note tells."""

import itertools
from collections.abc import Iterator

from depal.cell.checking.findings import CellFinding, Weight, error
from depal.domain import CellLayout, Delivery, Place, Product
from depal.errors import Problem
from depal.geometry import Vector3

GRAVITY = 9.81
"""[m/s^2]."""

PALLET_TOLERANCE = 0.005
"""Pallets whose edges differ by no more are the same [m]."""

RIM = 0.005
"""A cup lies on a face with this much to spare all round [m]."""

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


def largest_pull(layout: CellLayout, face: tuple[float, float]) -> float:
    """How much the cups that fit on a face hold together, by the planner's count [N].

    Args:
        layout: the cell.
        face: the two edges of the face [m].
    """
    tool = layout.tool
    per_cup = tool.suction.cup_force / tool.safety
    both = [tool.modules[0], tool.folded_lower]
    folded = [
        (pose.translation[1] + y, pose.translation[2] + z)
        for pose, cups in ((module.flange_from_face, module.cups) for module in both)
        for y, z in cups
    ]
    most = max(
        _cups_on(list(cups), turned, tool.suction.cup_radius + RIM)
        for cups in (*(module.cups for module in tool.modules), folded)
        for turned in (face, face[::-1])
    )
    return most * per_cup


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
    spare = layout.robot.payload - layout.tool.mass
    if product.mass > spare:
        payload = f"{layout.robot.payload:g} kg less {layout.tool.mass:g} kg of tool"
        yield Problem(where, f"weighs {product.mass:g} kg", f"at most {spare:g} kg: {payload}")
    a, b, c = product.size
    ways = ((a, b, c), (a, c, b), (b, c, a))
    if not any(fits(place, way) for place in layout.places.values() for way in ways):
        largest = max(layout.places.values(), key=lambda place: place.volume)
        width, height = largest.opening
        exists = f"the largest is {largest.id}: {width:g} x {height:g}, {largest.depth:g} m deep"
        yield Problem(where, f"{_edges(product.size)} fits no opening", exists=exists)
    faces = list(itertools.combinations(product.size, 2))
    pull = max(largest_pull(layout, face) for face in faces)
    cup = 2 * (layout.tool.suction.cup_radius + RIM)
    if pull == 0:
        what = f"{_edges(product.size)} has no face for a cup"
        yield Problem(where, what, f"a face of at least {cup:g} x {cup:g} m")
    elif product.mass * GRAVITY > pull:
        most = pull / GRAVITY
        what = f"weighs {product.mass:g} kg, more than the cups on its largest face hold"
        yield Problem(where, what, f"at most {most:.1f} kg")


def _cups_on(cups: list[tuple[float, float]], face: tuple[float, float], reach: float) -> int:
    """The greatest number of cups that lie wholly on a face, wherever it is under them."""
    most = 0
    for left, low in itertools.product({y for y, _ in cups}, {z for _, z in cups}):
        right, high = left + face[0] - 2 * reach, low + face[1] - 2 * reach
        count = sum(
            left - 1e-9 <= y <= right + 1e-9 and low - 1e-9 <= z <= high + 1e-9 for y, z in cups
        )
        most = max(most, count)
    return most


def _edges(size: Vector3) -> str:
    return " x ".join(f"{edge:.6g}" for edge in size) + " m"
