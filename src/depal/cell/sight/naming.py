"""From remembered boxes to what the selection works on."""

from collections.abc import Sequence

import numpy as np

from depal.domain import DeliveryLine, Detection, Gtin, Perceived, Recognition
from depal.geometry import OrientedBox, Vector3
from depal.perception.memory import Remembered
from depal.perception.memory.anchors import resized_at_its_face

ALIKE = 0.02
"""A box whose edges are this near to those of a product on the note has that product's size [m]."""

ANY = 0.25
"""The edges of a product that was named replace those that were seen, off by so much even [m]."""

SAME = 0.004
"""Products whose edges differ by less have one size [m]."""


def perceived(box: Remembered, note: Sequence[DeliveryLine] | None = None) -> Perceived:
    """A box with its name: recognised where its print could be believed, else detected.

    Args:
        box: as all looks show it.
        note: what may stand there; a box that is only detected takes the size of the products
            that it can be, where they agree.
    """
    seen = box.seen
    if seen.gtin is not None:
        return Recognition(box.name, _as_named(seen.shape, seen.gtin, note or ()), seen.gtin)
    return Detection(box.name, _as_promised(seen.shape, note or ()) if seen.sized else seen.shape)


def _as_named(shape: OrientedBox, gtin: Gtin, note: Sequence[DeliveryLine]) -> OrientedBox:
    """The shape with the size of its product: a name that was believed outweighs an edge."""
    for line in note:
        if line.product.gtin == gtin:
            size = turned_like(line.product.size, shape.size, ANY)
            return shape if size is None else resized_at_its_face(shape, size)
    return shape


def _as_promised(shape: OrientedBox, note: Sequence[DeliveryLine]) -> OrientedBox:
    """The shape with the one size of the note that it can have; else as it was measured."""
    fitting = {
        turned
        for line in note
        if (turned := turned_like(line.product.size, shape.size)) is not None
    }
    if not fitting:
        return shape
    sizes = np.array(sorted(fitting))
    if np.ptp(sizes, axis=0).max() > SAME:
        return shape
    a, b, c = sizes.mean(axis=0).tolist()
    return resized_at_its_face(shape, (a, b, c))


def turned_like(size: Vector3, measured: Vector3, alike: float = ALIKE) -> Vector3 | None:
    """A case's size in the order of a measured box's axes, upright; None where it cannot be it.

    How it lies the edges tell that were measured best: the third may be hidden in part.
    """
    length, width, height = size
    found = list[tuple[float, float, int, Vector3]]()
    for way in ((length, width, height), (width, length, height)):
        *_, second, most = sorted(abs(a - b) for a, b in zip(way, measured, strict=True))
        if most < alike:
            found.append((second, most, len(found), way))
    return min(found)[3] if found else None
