"""The words of the cell as immutable values. Metres, kilograms, seconds, radians."""

from depal.domain.box import Box, Detection, Perceived, Recognition
from depal.domain.delivery import (
    EURO_PALLET,
    PALLET_FRONT_X,
    STACK_TOLERANCE,
    Delivery,
    DeliveryLine,
    StackedCase,
    cell_from_pallet,
)
from depal.domain.names import BoxId, Gtin, PlaceId
from depal.domain.place import Place
from depal.domain.product import Product
from depal.domain.request import Request
from depal.domain.settings import checked_share

__all__ = [
    "EURO_PALLET",
    "PALLET_FRONT_X",
    "STACK_TOLERANCE",
    "Box",
    "BoxId",
    "Delivery",
    "DeliveryLine",
    "Detection",
    "Gtin",
    "Perceived",
    "Place",
    "PlaceId",
    "Product",
    "Recognition",
    "Request",
    "StackedCase",
    "cell_from_pallet",
    "checked_share",
]
