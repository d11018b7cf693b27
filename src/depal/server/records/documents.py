"""A delivery as the documented JSON, and back by the product's own reader."""

import json
from pathlib import Path
from typing import Any

from depal.domain import Delivery
from depal.logistics import deliveries_in


def document_of(delivery: Delivery) -> dict[str, Any]:
    """The document that `read_delivery_text` reads."""
    document: dict[str, Any] = {
        "id": delivery.id,
        "pallet": {"size": list(delivery.pallet_size)},
        "lines": [
            {
                "gtin": line.product.gtin,
                "name": line.product.name,
                "size": list(line.product.size),
                "mass": line.product.mass,
                "count": line.count,
            }
            for line in delivery.lines
        ],
    }
    if delivery.stack is not None:
        document["stack"] = [
            {"gtin": case.gtin, "corner": list(case.corner), "size": list(case.size)}
            for case in delivery.stack
        ]
    return document


def delivery_from(document: dict[str, Any]) -> Delivery:
    """The delivery of a document that was checked before."""
    return deliveries_in(json.dumps(document), Path("kept.json"))[0]
