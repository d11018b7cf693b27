"""What the store knows of its products' looks."""

from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np
import numpy.typing as npt

from depal.domain import Gtin, Product

Picture = npt.NDArray[np.uint8]

SIDES = ("end", "side", "top")
"""Faces that are kept: the narrow upright one, the wide upright one, the top."""


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
