"""A box that the reader has told is remembered by its looks: the picture book grows."""

from collections.abc import Iterable, Sequence

import numpy as np

from depal.domain import Product
from depal.errors import SettingError
from depal.perception.faces import Face, Facing
from depal.perception.pictures import PictureBook, extended, side_size
from depal.perception.recognition.rectifying import rectified
from depal.ports import Frame

WHOLE = 0.9
"""Faces of which less was seen are not kept."""

ALIKE = 0.02
"""A face is the product's side whose edges differ by less [m]."""

FRONTS = ("side", "end")


def extended_by(
    book: PictureBook, product: Product, faces: Iterable[Face], frames: Sequence[Frame]
) -> PictureBook:
    """A book with the faces of a box that turned out to be of a product.

    Args:
        book: as it was; faces that it knows already stay.
        product: what the reader said.
        faces: of the box, as they were seen.
        frames: of the look that saw them.
    """
    known = book.entries[product.gtin].faces if product.gtin in book else {}
    for face in faces:
        side = side_of(face, product)
        if side is None or side in known or face.visible < WHOLE:
            continue
        patch = rectified(frames, face.facing, face.cell_from_face, face.size)
        if patch is None:
            continue
        rim = round(patch.margin / patch.step)
        picture = patch.colour[rim:-rim, rim:-rim] if rim else patch.colour
        try:
            book = extended(book, product, side, np.ascontiguousarray(picture))
        except SettingError:
            continue  # seen too slantwise for the shape of the side
    return book


def side_of(face: Face, product: Product) -> str | None:
    """Which of a product's sides a front is, by its edges; None where they do not tell.

    How a top lies is not told by its edges: tops are not kept.
    """
    if face.facing is not Facing.FRONT:
        return None
    off = {
        side: max(abs(a - b) for a, b in zip(face.size, side_size(product, side), strict=True))
        for side in FRONTS
    }
    first, second = sorted(FRONTS, key=lambda side: off[side])
    return first if off[first] < ALIKE <= off[second] else None
