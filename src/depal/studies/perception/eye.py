"""Perception as it is measured and shown: an observer with what it is told before a look."""

from collections.abc import Sequence
from dataclasses import dataclass, field

from depal.domain import DeliveryLine
from depal.geometry import Vector3
from depal.perception.faces import Look
from depal.perception.observing import Known, Observation, Observer
from depal.perception.pictures import PictureBook
from depal.perception.rasters import Region
from depal.perception.recognition import gallery_of
from depal.ports import Frame


@dataclass(slots=True)
class Eye:
    """Looks at one pallet, each with what the look before has found.

    Attributes:
        observer: finds the boxes.
        known: what it is told.
        before: the look before.
    """

    observer: Observer
    known: Known = field(default_factory=Known)
    before: Observation | None = None

    def look(self, frames: Sequence[Frame]) -> Look:
        """What is found in the frames of one look, one per camera, with their calibration."""
        self.before = self.observer.look(frames, self.known, self.before)
        return self.before.look


def open_eye(
    region: Region,
    note: tuple[DeliveryLine, ...] | None = None,
    book: PictureBook | None = None,
    sizes: tuple[Vector3, ...] | None = None,
) -> Eye:
    """An eye that is ready for the first look.

    Args:
        region: where boxes are looked for.
        note: what may be there, where that is known.
        book: pictures of products.
        sizes: of boxes that may be there, without a name [m].
    """
    products = tuple(line.product for line in note or ())
    gallery = gallery_of(book, note) if book is not None and book.entries else None
    return Eye(Observer(region), Known(products, sizes or (), gallery))
