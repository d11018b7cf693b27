"""`depal delivery check`: what the product makes of a delivery."""

from pathlib import Path

from rich.console import RenderableType

from depal.app.files import Json
from depal.app.reports.report import Report, plain_table
from depal.app.unload import deliveries_of
from depal.domain import Delivery
from depal.errors import DeliveryError, Problem
from depal.logistics import read_requests


def check_delivery(reference: str, requests: Path | None) -> Report:
    """Reads deliveries, and requests against each of them.

    Args:
        reference: FILE, FILE#ID or the name of a shipped delivery.
        requests: a file of requests, or None.

    Returns:
        A summary of what was read.

    Raises:
        InputError: everything that is wrong with the files.
    """
    if not reference:
        exists = f"shipped: {', '.join(delivery.id for delivery in deliveries_of(''))}"
        raise DeliveryError("", [Problem("FILE", "no file named", "a delivery file", exists)])
    deliveries = deliveries_of(reference)
    asked = 0
    if requests is not None:
        asked = sum(len(read_requests(requests, delivery)) for delivery in deliveries)
    title = f"{reference}: {len(deliveries)} valid {_plural(len(deliveries))}"
    table = plain_table(
        title,
        "delivery",
        "products",
        "boxes",
        "mass [kg]",
        "height [m]",
        "smallest side [m]",
        "largest side [m]",
        "stack",
    )
    for delivery in deliveries:
        height = stack_height(delivery)
        sides = [side for line in delivery.lines for side in line.product.size]
        table.row(
            delivery.id,
            str(len(delivery.lines)),
            str(len(delivery.boxes)),
            f"{delivery.mass:.1f}",
            "" if height is None else f"{height:.2f}",
            f"{min(sides):.3f}",
            f"{max(sides):.3f}",
            "note only" if delivery.stack is None else "known",
        )
    shown: list[RenderableType] = (
        [table] if requests is None else [table, f"{requests}: {asked} valid requests"]
    )
    fields: dict[str, Json] = {
        "deliveries": [_fields(delivery) for delivery in deliveries],
        "requests": asked,
    }
    return Report(fields=fields, shown=shown)


def stack_height(delivery: Delivery) -> float | None:
    """How high the stack stands above the deck [m]; None where only the note is known."""
    if delivery.stack is None:
        return None
    return max((case.corner[2] + case.size[2] for case in delivery.stack), default=0.0)


def _fields(delivery: Delivery) -> Json:
    return {
        "id": delivery.id,
        "products": len(delivery.lines),
        "boxes": len(delivery.boxes),
        "mass": delivery.mass,
        "height": stack_height(delivery),
        "stack": delivery.stack is not None,
    }


def _plural(count: int) -> str:
    return "delivery" if count == 1 else "deliveries"
