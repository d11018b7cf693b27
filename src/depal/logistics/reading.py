"""Deliveries from files and by name."""

from pathlib import Path

from depal.domain import Delivery
from depal.errors import DeliveryError, Problem
from depal.logistics.delivery_csv import delivery_of_csv
from depal.logistics.delivery_json import deliveries_of_json
from depal.logistics.findings import choices, shown
from depal.logistics.shipped import shipped_deliveries
from depal.logistics.source_text import read_text

ENDINGS = (".json", ".csv")
"""How delivery files end."""

LIMIT = 64
"""No delivery file is larger [MiB]."""


def read_deliveries(path: Path) -> tuple[Delivery, ...]:
    """All deliveries of a file.

    Args:
        path: a CSV note when it ends in .csv, else JSON: one delivery or a list of them.

    Returns:
        The deliveries in the order of the file, at least one, each checked as a whole.

    Raises:
        DeliveryError: the file cannot be used; with everything that is wrong with it.
    """
    text = read_text(path, DeliveryError, ENDINGS, LIMIT)
    return deliveries_in(text, path)


def deliveries_in(text: str, path: Path) -> tuple[Delivery, ...]:
    """All deliveries of a text that came under a file's name.

    Args:
        text: a CSV note when the name ends in .csv, else JSON.
        path: the name; nothing is read from it.

    Raises:
        DeliveryError: the text cannot be used; with everything that is wrong with it.
    """
    if path.suffix.lower() == ".csv":
        return (delivery_of_csv(text, path.stem, str(path)),)
    return deliveries_of_json(text, str(path))


def read_delivery(reference: str) -> Delivery:
    """One delivery.

    Args:
        reference: a file with one delivery, `FILE#ID` for one of several, or the id of a
            delivery that ships with the package. A file of exactly this name wins.

    Returns:
        The delivery.

    Raises:
        DeliveryError: nothing or no single delivery is meant by this, or its file is unusable.
    """
    if _is_file(reference):
        return _only(read_deliveries(Path(reference)), reference)
    splits = [(reference[:end], reference[end + 1 :]) for end in _marks(reference)]
    if splits:
        file, name = next((split for split in splits if _is_file(split[0])), splits[0])
        return _named(read_deliveries(Path(file)), name, file)
    if "/" in reference or Path(reference).suffix.lower() in ENDINGS:
        return _only(read_deliveries(Path(reference)), reference)
    shipped = {delivery.id: delivery for delivery in shipped_deliveries()}
    if reference not in shipped:
        what = f"neither a file nor a shipped delivery is called {shown(reference)}"
        expected = "FILE, FILE#ID or a shipped delivery's id"
        raise DeliveryError(
            "", [Problem("", what, expected, choices(reference[:100], list(shipped)))]
        )
    return shipped[reference]


def _is_file(reference: str) -> bool:
    """Whether something that can be read has this name: a file or a pipe, not a directory."""
    try:
        path = Path(reference)
        return path.exists() and not path.is_dir()
    except (OSError, ValueError):
        return False


def _marks(reference: str) -> list[int]:
    """Where a file's name may end; both a name and an id may hold the mark themselves."""
    return [end for end, letter in enumerate(reference) if letter == "#" and end > 0]


def _only(deliveries: tuple[Delivery, ...], source: str) -> Delivery:
    if len(deliveries) > 1:
        ids = [delivery.id for delivery in deliveries]
        problem = Problem("", f"has {len(ids)} deliveries", f"{source}#ID", choices("", ids))
        raise DeliveryError(source, [problem])
    return deliveries[0]


def _named(deliveries: tuple[Delivery, ...], name: str, source: str) -> Delivery:
    for delivery in deliveries:
        if delivery.id == name:
            return delivery
    ids = [delivery.id for delivery in deliveries]
    problem = Problem("", f"no delivery is called {shown(name)}", exists=choices(name[:100], ids))
    raise DeliveryError(source, [problem])
