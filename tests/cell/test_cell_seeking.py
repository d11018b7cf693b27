"""A wanted product that nobody has seen pulls the boxes behind which it may stand."""

from types import SimpleNamespace
from typing import cast

from depal.cell.files import shipped_cell
from depal.cell.seeking import searches
from depal.cell.workplace import Workplace
from depal.domain import (
    EURO_PALLET,
    BoxId,
    Delivery,
    DeliveryLine,
    Detection,
    Gtin,
    Perceived,
    Product,
    Recognition,
    Request,
)
from depal.geometry import OrientedBox
from depal.selection import PERCEIVED, BlockingGraph
from depal.selection.access import free_ways, members

LAYOUT = shipped_cell("default")
DECK = LAYOUT.pallet.cell_from_pallet.translation[2]
SEEN, HIDDEN, STRANGE = (Gtin(f"1200090000{number:03d}0") for number in range(3))
SIZE = (0.3, 0.4, 0.3)


def _searches(boxes: list[Perceived], *wishes: Request) -> list[tuple[Request, set[str]]]:
    lines = tuple(DeliveryLine(Product(gtin, "case", SIZE, 4.0), 2) for gtin in (SEEN, HIDDEN))
    delivery = Delivery("two", EURO_PALLET, lines)
    work = cast("Workplace", SimpleNamespace(layout=LAYOUT, delivery=delivery))
    graph = BlockingGraph(boxes)
    ways = free_ways(graph.prisms, PERCEIVED, graph.used_slots.tolist())
    found = searches(work, graph, ways, wishes)
    return [(wish, {str(graph.at(slot).id) for slot in members(mask)}) for wish, mask in found]


def _box(name: str, x: float, y: float, z: float, gtin: Gtin | None = None) -> Perceived:
    shape = OrientedBox.upright((x, y, DECK + z), SIZE)
    return Detection(BoxId(name), shape) if gtin is None else Recognition(BoxId(name), shape, gtin)


STEP: list[Perceived] = [
    _box("front", 1.55, 0.0, 0.15),
    _box("upper", 1.55, 0.0, 0.45),
    _box("bridge", 1.90, 0.0, 0.45),
    _box("aside", 1.55, 0.45, 0.15, SEEN),
]
"""Two boxes on one another in front, one behind at their height: below it nobody has looked."""


def test_what_may_hide_the_wanted_product_is_removed_first() -> None:
    """The box over the unseen room, not the one that stands apart."""
    wish = Request(0.5, gtin=HIDDEN)
    ((found, boxes),) = _searches(STEP, wish)
    assert found == wish
    assert boxes
    assert "aside" not in boxes


def test_only_products_of_the_note_that_nobody_has_seen_are_searched() -> None:
    """What is seen has its own removals, what is strange may be anywhere, a box has a name."""
    wishes = [Request(0.5, gtin=SEEN), Request(0.5, gtin=STRANGE), Request(0.5, box=BoxId("b9"))]
    assert _searches(STEP, *wishes) == []
    assert _searches([], Request(0.5, gtin=HIDDEN)) == []


def test_where_nothing_can_hide_it_nothing_is_removed_for_it() -> None:
    """One box before the open: from above all else is seen to be empty."""
    assert _searches([_box("alone", 1.55, 0.0, 0.15)], Request(0.5, gtin=HIDDEN)) == []
