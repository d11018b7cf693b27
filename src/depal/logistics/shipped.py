"""The real deliveries that ship with the package; deliveries/NOTICE.md says where from."""

from importlib import resources

from depal.domain import Delivery
from depal.logistics.delivery_json import deliveries_of_json


def shipped_deliveries() -> tuple[Delivery, ...]:
    """The deliveries that ship with the package.

    Returns:
        Real deliveries, each with its stack, from the fewest cases to the most.
    """
    file = resources.files("depal.logistics") / "deliveries" / "shipped.json"
    deliveries = deliveries_of_json(file.read_text("utf-8"), "shipped deliveries")
    return tuple(sorted(deliveries, key=lambda delivery: (len(delivery.boxes), delivery.id)))
