"""Pictures for the database: simulated products, photographed when they were first listed.

A photograph is of another box than any on a pallet, so its print sits elsewhere by a few
millimetres and its inks differ; and it was taken under other light, by another camera.
"""

from collections.abc import Iterable
from dataclasses import dataclass

import cv2
import numpy as np
import numpy.typing as npt

from depal.domain import Gtin, Product
from depal.perception.pictures import (
    SIDES,
    Picture,
    PictureBook,
    ProductPictures,
    pixels,
    side_size,
)
from depal.simulation.imaging.prints import artwork
from depal.simulation.imaging.prints.design import design_of
from depal.simulation.imaging.prints.label import label_for, label_image

Floats = npt.NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class Studio:
    """How much photographs of one face differ.

    Attributes:
        gain: pictures are darker than the drawing by up to this share, never much brighter.
        balance: each channel's gain, the same way.
        gradient: light falls off by up to this share from edge to edge.
        shift: the print sits up to so far from where the drawing has it [m].
        scale: the print's size differs by up to this share.
        ink: contrast and colours of the print differ by up to this share.
        blur: a point is spread over up to so much, as a Gauss curve's width [m].
        grain: standard deviation of a pixel's value.
        labelled: share of the faces that were photographed with their label on.
    """

    gain: float = 0.4
    balance: float = 0.1
    gradient: float = 0.2
    shift: float = 0.003
    scale: float = 0.005
    ink: float = 0.06
    blur: float = 0.0012
    grain: float = 3.0
    labelled: float = 0.5


def book_of(
    products: Iterable[Product], seed: int, known_share: float = 0.9, studio: Studio | None = None
) -> PictureBook:
    """The database that a store may have of simulated products.

    A product is in the book or not, and looks there as it does, by the seed and its number
    alone, whatever other products there are.

    Args:
        products: all that may come; their artwork follows from their numbers.
        seed: of everything in it.
        known_share: of the products that are in the book.
        studio: how the photographs differ from the drawing and from each other.

    Returns:
        A book with all three faces of every product that it knows.
    """
    entries = dict[Gtin, ProductPictures]()
    for product in products:
        random = np.random.default_rng([seed, 12, int(product.gtin)])
        if random.random() < known_share:
            entries[product.gtin] = photographed(product, random, studio or Studio())
    return PictureBook(entries)


def photographed(product: Product, random: np.random.Generator, studio: Studio) -> ProductPictures:
    """Pictures of all faces of a simulated product.

    Args:
        product: which.
        random: draws light and print.
        studio: how far they go.
    """
    return ProductPictures(
        product,
        {side: taken(drawn(product, side, random, studio), random, studio) for side in SIDES},
    )


def drawn(product: Product, side: str, random: np.random.Generator, studio: Studio) -> Picture:
    """A face as the printer meant it, at one pixel per millimetre; maybe with its label."""
    design, size = design_of(product.gtin), side_size(product, side)
    if side == "top":
        return artwork.top(design, size)
    face = artwork.side(design, size).copy()
    label = label_for(size)
    if label is None or random.random() >= studio.labelled:
        return face
    image = label_image(product.gtin, f"{design.brand} {design.variety}", label)
    width, height = pixels(label.size)
    small = cv2.resize(image, (width, height), interpolation=cv2.INTER_AREA)
    left = (face.shape[1] - width) // 2
    top = round(face.shape[0] / 2 + label.below * 1000 - height / 2)
    face[top : top + height, left : left + width] = small
    return face


def taken(face: Picture, random: np.random.Generator, studio: Studio) -> Picture:
    """A photograph of a face.

    Args:
        face: (h, w, 3) as drawn.
        random: draws light and print.
        studio: how far they go.
    """
    height, width = face.shape[:2]
    scale = 1.0 + random.uniform(-studio.scale, studio.scale)
    shift = random.uniform(-studio.shift, studio.shift, 2) * 1000
    middle = np.array(((width - 1) / 2, (height - 1) / 2))
    warp = np.column_stack((np.eye(2) * scale, shift + middle * (1.0 - scale)))
    moved = cv2.warpAffine(face, warp, (width, height), borderMode=cv2.BORDER_REPLICATE)
    ink = 1.0 + random.uniform(-studio.ink, studio.ink, 3)
    light = 1.0 - random.uniform(0.0, studio.gain)
    balance = 1.0 + random.uniform(-studio.balance, studio.balance, 3)
    bright = moved.mean(axis=(0, 1))
    values = (bright + (moved - bright) * ink) * balance * light * _falling(face, random, studio)
    blur = max(random.uniform(0.3, 1.0) * studio.blur * 1000, 0.1)
    soft = cv2.GaussianBlur(values, (0, 0), blur)
    grain = studio.grain * random.standard_normal(face.shape)
    return np.asarray(np.clip(np.round(soft + grain), 0, 255), dtype=np.uint8)


def _falling(face: Picture, random: np.random.Generator, studio: Studio) -> Floats:
    """(h, w, 1) brightness of the light over the face, one in its middle."""
    height, width = face.shape[:2]
    way, much = random.uniform(0, 2 * np.pi), random.uniform(0, studio.gradient)
    x = np.linspace(-0.5, 0.5, width)[None, :] * np.cos(way)
    y = np.linspace(-0.5, 0.5, height)[:, None] * np.sin(way)
    return np.asarray(1.0 + much * (x + y))[..., None]
