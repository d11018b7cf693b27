"""What the journal of a cell says about the store's stock: the movements of its boxes."""

from collections.abc import Iterator, Mapping

from depal.domain import BoxId, Gtin, PlaceId
from depal.executive.conditions import Key, Value
from depal.executive.events import Ended, decode
from depal.executive.journal import Record
from depal.ports import Movement

STORED = ".stored"


def movement_id(box: BoxId, place: PlaceId) -> str:
    """The name of a movement: told by the cell or read from its journal, it counts once."""
    return f"{box}@{place}"


def movements_in(record: Record, facts: Mapping[Key, Value]) -> Iterator[Movement]:
    """The movements that an event tells of.

    Args:
        record: of a cell's journal.
        facts: of the executive after that event, or later: a box keeps its product and target.
    """
    if record.kind != Ended.__name__:
        return
    event = decode(record.at, record.kind, record.body)
    for key, value in event.facts if isinstance(event, Ended) else ():
        if not (key.endswith(STORED) and value):
            continue
        box = BoxId(key.removesuffix(STORED))
        place, gtin = facts.get(f"{box}.target"), facts.get(f"{box}.product")
        if place is not None:
            target = PlaceId(str(place))
            yield Movement(
                movement_id(box, target),
                box,
                Gtin(str(gtin)) if gtin else None,
                target,
                event.at,
            )
