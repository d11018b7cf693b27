"""Boxes: as the delivery knows them and as the camera sees them."""

from dataclasses import dataclass

from depal.domain.names import BoxId, Gtin
from depal.domain.product import Product
from depal.geometry import OrientedBox


@dataclass(frozen=True, slots=True)
class Box:
    """A case that the delivery note promises: an element of B_pall (section II-C).

    Attributes:
        id: the product's number and a running number, as in "12000823098180/3".
        product: what is inside.
    """

    id: BoxId
    product: Product


@dataclass(frozen=True, slots=True)
class Detection:
    """A box that was perceived and not recognised: an element of B_det (section II-C).

    Attributes:
        id: the perceived box's own name, kept from look to look.
        shape: pose and size in the cell frame [m].
    """

    id: BoxId
    shape: OrientedBox


@dataclass(frozen=True, slots=True)
class Recognition:
    """A box that was perceived and recognised: an element of B_rec (section II-C).

    Attributes:
        id: the perceived box's own name, kept from look to look.
        shape: pose and size in the cell frame [m].
        gtin: the product that it was recognised as.
    """

    id: BoxId
    shape: OrientedBox
    gtin: Gtin


Perceived = Detection | Recognition
"""B_det united with B_rec: what perception hands to the selection."""
