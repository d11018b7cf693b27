"""The prints that may come, made ready for comparing."""

import math
from collections.abc import Iterable
from dataclasses import dataclass

import cv2
import numpy as np
import numpy.typing as npt

from depal.domain import DeliveryLine, Gtin, Product
from depal.perception.faces import Facing
from depal.perception.pictures import SIDES, Picture, PictureBook, side_size
from depal.perception.recognition.details import small_print
from depal.perception.recognition.features import Features, features_of
from depal.perception.recognition.labels import inside, label_ends, without_label
from depal.perception.recognition.patches import FINE, SOFT
from depal.perception.recognition.tones import Areas, areas_of

Flags = npt.NDArray[np.bool_]

BLURS = (0.0, 1.1, 2.0, 3.0)
"""Pictures are kept as a near, a far and a farther camera sees them [mm], a Gauss curve's width."""

COARSE = 3
"""The first search takes squares of so many pixels."""

OUTLINE = 6
"""Rasters are searched in squares of so many pixels."""

EDGE = 0.0075
"""Prints are not compared so near to their edges, where boxes are folded [m]."""

MILLIMETRE = 0.001


@dataclass(frozen=True, slots=True, eq=False)
class Print:
    """A product's face, made ready.

    Attributes:
        product: whose.
        side: which face, one of `SIDES`.
        levels: its features at `FINE`, once for each of `BLURS`; places of labels have no weight.
        middle: the same in pixels twice as large, as rasters are looked at.
        coarse: the same in pixels `COARSE` times as large.
        outline: the same in pixels `OUTLINE` times as large, its colours compared with those
            around as its brightness is.
        small: where something small is printed.
        areas: where which of its colours is, in pixels `COARSE` times as large.
        label_ends: how far down its label may reach, as a share of its height.
        contrast: how much is printed: its squared features, summed over its area [m^2].
    """

    product: Product
    side: str
    levels: tuple[Features, ...]
    middle: Features
    coarse: Features
    outline: Features
    small: tuple[Flags, ...]
    areas: Areas
    label_ends: float
    contrast: float

    @property
    def size(self) -> tuple[float, float]:
        """Width and height [m]."""
        return side_size(self.product, self.side)

    @property
    def facing(self) -> Facing:
        """Which way the face looks."""
        return Facing.TOP if self.side == "top" else Facing.FRONT


@dataclass(frozen=True, slots=True)
class Gallery:
    """What may stand on the pallet.

    Attributes:
        prints: of all faces that there are pictures of.
        unpictured: faces that may come and that nobody has seen: product and side.
        complete: whether nothing else can come, as far as the note is right.
    """

    prints: tuple[Print, ...]
    unpictured: tuple[tuple[Product, str], ...]
    complete: bool

    @property
    def products(self) -> frozenset[Gtin]:
        """All products with a picture."""
        return frozenset(known.product.gtin for known in self.prints)


def gallery_of(book: PictureBook, lines: Iterable[DeliveryLine] | None = None) -> Gallery:
    """Makes the pictures of what may come ready for comparing; once for a delivery.

    Args:
        book: all pictures.
        lines: what may come: the note, or what is left of it; products without pictures matter
            too, as rivals that cannot be excluded by their looks. Without it all of the book may
            come, and other things.
    """
    if lines is None:
        products = [entry.product for _, entry in sorted(book.entries.items())]
    else:
        products = [line.product for line in lines]
    prints, unpictured = list[Print](), list[tuple[Product, str]]()
    for product in products:
        faces = book.entries[product.gtin].faces if product.gtin in book else {}
        for side in SIDES:
            if side in faces:
                prints.append(print_of(product, side, faces[side]))
            else:
                unpictured.append((product, side))
    return Gallery(tuple(prints), tuple(unpictured), lines is not None)


def print_of(product: Product, side: str, picture: Picture) -> Print:
    """Makes one picture ready."""
    levels = _levels(picture, side)
    values, weights = levels[0].values, levels[0].weights
    contrast = float((values * values).sum(axis=2).ravel() @ weights.ravel()) * FINE**2
    middle, coarse = levels[1].thinned(2), levels[1].thinned(COARSE)
    outline = middle.thinned(OUTLINE // 2).flattened()
    small = small_print(levels[0])
    ends = 0.0 if side == "top" else label_ends(*side_size(product, side))
    areas = areas_of(coarse)
    return Print(product, side, levels, middle, coarse, outline, small, areas, ends, contrast)


def _levels(picture: Picture, side: str) -> tuple[Features, ...]:
    """A picture's features at every blur.

    The face lies in the middle of a grid whose rows and columns can be thinned without a rest.
    """
    high, wide = picture.shape[:2]
    height, width = (
        OUTLINE * math.ceil(edge * MILLIMETRE / FINE / OUTLINE) for edge in (high, wide)
    )
    size = (wide * MILLIMETRE, high * MILLIMETRE)
    weights = inside((height, width), FINE, size, EDGE)
    if side != "top":
        weights *= without_label((height, width), FINE, size)
    k = FINE / MILLIMETRE
    warp = np.array(
        [
            [k, 0.0, (wide - 1) / 2 - k * (width - 1) / 2],
            [0.0, k, (high - 1) / 2 - k * (height - 1) / 2],
        ]
    )
    flags = cv2.INTER_LINEAR | cv2.WARP_INVERSE_MAP
    levels = []
    for blur in BLURS:
        width_of_blur = float(np.hypot(blur, SOFT * k))
        soft = cv2.GaussianBlur(picture.astype(np.float32), (0, 0), width_of_blur)
        small = cv2.warpAffine(
            soft, warp, (width, height), flags=flags, borderMode=cv2.BORDER_REPLICATE
        )
        levels.append(features_of(np.asarray(small, dtype=np.float32), weights, FINE))
    return tuple(levels)
