"""One box was taken for another product: so may be others that look like it.

Of a product without a picture the size is a guess: lines printed on it may pass for its edges,
and the note has a product that is so large. All its cases look alike, so all are guessed alike.
"""

from collections import Counter
from collections.abc import Iterable

import numpy as np

from depal.cell.identity import fits, told_size
from depal.domain import BoxId, Delivery, Detection, Gtin, Perceived, Product, Recognition
from depal.geometry import Vector3

EQUAL = 0.01
"""Boxes whose edges differ by no more look equally large [m]."""


def sizes_of_the_mistaken(
    seen: Vector3,
    told: Product,
    boxes: Iterable[Perceived],
    delivery: Delivery,
    left: Iterable[Gtin | None],
) -> dict[BoxId, Vector3]:
    """What boxes measure that look like one of which the reader has told that it is another.

    Nothing is said of them where the note still promises as many cases of that look as are seen, or
    no more of what the reader has told.

    Args:
        seen: how large the one was seen [m].
        told: what it is.
        boxes: that stand on the pallet.
        delivery: what they can be.
        left: the products of boxes that have left; None where nobody knows.

    Returns:
        Sizes by name, each along the box's own axes [m].
    """
    standing = list(boxes)
    gone = Counter(gtin for gtin in left if gtin is not None)
    gone.update(box.gtin for box in standing if isinstance(box, Recognition))
    due = {line.product.gtin: line.count - gone[line.product.gtin] for line in delivery.lines}
    like = sum(
        max(due[product.gtin], 0)
        for product in delivery.products.values()
        if product.gtin != told.gtin and fits(product, seen)
    )
    alike = [box for box in standing if isinstance(box, Detection) and _equal(box, seen)]
    if len(alike) <= like or due.get(told.gtin, 0) <= 0:
        return {}
    return {box.id: told_size(told.size, box.shape.size)[0] for box in alike}


def _equal(box: Perceived, seen: Vector3) -> bool:
    (a, b, c), (d, e, f) = box.shape.size, seen
    ways = ((a, b, c), (b, a, c))
    return any(float(np.abs(np.subtract(way, (d, e, f))).max()) <= EQUAL for way in ways)
