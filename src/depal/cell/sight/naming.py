"""From remembered boxes to what the selection works on."""

from depal.domain import Detection, Perceived, Recognition
from depal.perception.memory import Remembered


def perceived(box: Remembered) -> Perceived:
    """A box with its name: recognised where its print could be believed, else detected."""
    seen = box.seen
    if seen.gtin is None:
        return Detection(box.name, seen.shape)
    return Recognition(box.name, seen.shape, seen.gtin)
