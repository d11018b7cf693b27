"""Names of things, as types that cannot be mixed up."""

from typing import NewType

Gtin = NewType("Gtin", str)
"""A Global Trade Item Number with its check digit, as printed: what a barcode says."""

BoxId = NewType("BoxId", str)
"""One case. On a note it is the product and a running number; perceived, it is a track."""

PlaceId = NewType("PlaceId", str)
"""One compartment of a trolley or a shelf."""
