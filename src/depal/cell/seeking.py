"""Requests for what nobody has seen yet: which boxes to remove first to find it."""

from collections.abc import Iterable

from depal.cell.workplace import Workplace
from depal.domain import Recognition, Request
from depal.selection import BlockingGraph
from depal.selection.access import Mask, Ways
from depal.selection.hidden import Region, Scene, View, owners_of, sought

AIR = 0.1
"""Above the highest box that is seen the pallet's space ends, so much above it [m]."""


def searches(
    work: Workplace, graph: BlockingGraph, ways: Ways, wishes: Iterable[Request]
) -> list[tuple[Request, Mask]]:
    """Per request for a product that no perceived box is of, the slots to empty first.

    Args:
        work: the note, and the pallet's place.
        graph: what is perceived.
        ways: over its slots.
        wishes: that are open.

    Returns:
        The requests whose product is on the note and may be hidden, each with its set.
    """
    seen = {box.gtin for box in graph if isinstance(box, Recognition)}
    products = work.delivery.products
    asked = [
        (wish, products[wish.gtin])
        for wish in wishes
        if wish.gtin is not None and wish.gtin in products and wish.gtin not in seen
    ]
    if not asked or not len(graph):
        return []
    region = _region(work, graph)
    owners = owners_of(region, graph.prisms, graph.used_slots.tolist())
    view = View.of(owners)
    scene = Scene(region, owners, view.passed, view)
    found = [(wish, sought(scene, each.size, graph.prisms, ways)) for wish, each in asked]
    return [(wish, search.boxes) for wish, search in found if search is not None and search.boxes]


def _region(work: Workplace, graph: BlockingGraph) -> Region:
    """The space over the pallet, up to the highest box."""
    stand = work.layout.pallet
    length, width, _ = stand.size
    corners = [
        stand.cell_from_pallet.apply((x, y, 0.0)) for x in (0.0, length) for y in (0.0, width)
    ]
    used = graph.prisms[graph.used_slots]
    top = float((used[:, 2] + used[:, 5]).max()) + AIR
    low = (min(c[0] for c in corners), min(c[1] for c in corners), corners[0][2])
    return Region(low, (max(c[0] for c in corners), max(c[1] for c in corners), top))
