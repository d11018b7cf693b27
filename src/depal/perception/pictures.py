"""What the store knows of its products' looks."""

from collections.abc import Mapping
from dataclasses import dataclass, field

import cv2
import numpy as np
import numpy.typing as npt

from depal.domain import Gtin, Product
from depal.errors import SettingError

Picture = npt.NDArray[np.uint8]

SIDES = ("end", "side", "top")
"""Faces that are kept: the narrow upright one, the wide upright one, the top."""

SMALLEST, LARGEST = 0.01, 3.0
"""Edges of a case that pictures are kept of [m]."""

BENT = 0.15
"""A picture's edges may differ from the product's by this share before it is another face's."""


@dataclass(frozen=True, slots=True, eq=False)
class ProductPictures:
    """A product with a picture of each face that somebody has taken.

    Attributes:
        product: number, size, mass.
        faces: by `SIDES`: (h, w, 3) uint8 RGB at one pixel per millimetre; "end" is width by
            height of the case, "side" is length by height, "top" is length by width, its upper
            edge being the one that a viewer of a "side" sees at the back.
    """

    product: Product
    faces: Mapping[str, Picture] = field(default_factory=dict)


@dataclass(frozen=True, slots=True, eq=False)
class PictureBook:
    """All products with pictures.

    Attributes:
        entries: by number.
    """

    entries: Mapping[Gtin, ProductPictures] = field(default_factory=dict)

    def __contains__(self, gtin: object) -> bool:
        """Whether there are pictures of a product."""
        return gtin in self.entries


def side_size(product: Product, side: str) -> tuple[float, float]:
    """Width and height of one of a product's faces [m].

    Args:
        product: which.
        side: one of `SIDES`.
    """
    length, width, height = product.size
    return {"end": (width, height), "side": (length, height), "top": (length, width)}[side]


def pixels(size: tuple[float, float]) -> tuple[int, int]:
    """Width and height of a face's picture at one pixel per millimetre."""
    width, height = (max(round(edge * 1000), 8) for edge in size)
    return width, height


def extended(book: PictureBook, product: Product, side: str, picture: Picture) -> PictureBook:
    """A book with one more picture, as when a worker has shown an unknown box to the reader.

    Args:
        book: as it was.
        product: what the barcode said, with the size and the mass that the note or the store has.
        side: which face is shown, one of `SIDES`.
        picture: (h, w, 3) the rectified face in any resolution; it is brought to one pixel per
            millimetre.

    Returns:
        A new book; an older picture of the same face gives way.

    Raises:
        SettingError: no such side, a picture that is none, or one of a face of another shape.
    """
    if side not in SIDES:
        listed = ", ".join(SIDES)
        raise SettingError("side", f"no face is called {side!r}", exists=f"there is: {listed}")
    if picture.ndim != len(SIDES) or picture.shape[2] != len("RGB") or picture.dtype != np.uint8:
        what = f"an array {picture.shape} of {picture.dtype} is no colour picture"
        raise SettingError("picture", what, "(h, w, 3) of uint8")
    width, height = pixels(side_size(product, side))
    bent = (picture.shape[1] * height) / (picture.shape[0] * width)
    if not 1 - BENT < bent < 1 / (1 - BENT):
        seen = f"is {picture.shape[1]} pixels wide and {picture.shape[0]} high"
        face = f"the shape of {product.gtin}'s {side}, {width} x {height} mm"
        raise SettingError("picture", seen, face)
    flat = np.asarray(cv2.resize(picture, (width, height), interpolation=cv2.INTER_AREA))
    old = book.entries[product.gtin].faces if product.gtin in book else {}
    entry = ProductPictures(product, {**old, side: flat.astype(np.uint8)})
    return PictureBook({**book.entries, product.gtin: entry})
