"""`depal study unload`: from files to unloadings."""

from collections.abc import Sequence
from pathlib import Path

from depal.domain import Delivery, Request
from depal.logistics import read_deliveries, read_delivery, read_requests, shipped_deliveries
from depal.studies.real import Unloading, unload_delivery
from depal.studies.sweep import Progress


def unload_all(
    reference: str, requests: Path | None, w: float, progress: Progress
) -> list[Unloading]:
    """Unloads deliveries on geometry alone.

    Args:
        reference: a file of deliveries, FILE#ID, or "" for those that ship.
        requests: a file of requests for each of them, or None.
        w: the weight of Eq. (3).
        progress: told how far it is.

    Returns:
        One unloading per delivery.

    Raises:
        InputError: a file or the weight cannot be used.
    """
    deliveries = deliveries_of(reference)
    wanted = [_requests(requests, delivery) for delivery in deliveries]
    results = []
    for done, (delivery, asked) in enumerate(zip(deliveries, wanted, strict=True)):
        progress(done, len(deliveries))
        results.append(unload_delivery(delivery, asked, w))
    return results


def deliveries_of(reference: str) -> Sequence[Delivery]:
    """The deliveries that a reference names; "" names those that ship."""
    if not reference:
        return shipped_deliveries()
    if Path(reference).is_file():
        return read_deliveries(Path(reference))
    return [read_delivery(reference)]


def _requests(path: Path | None, delivery: Delivery) -> Sequence[Request]:
    return () if path is None else read_requests(path, delivery)
