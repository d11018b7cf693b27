"""What is believed to stand on the pallet, as far as it can stand in one world."""

from contextlib import suppress

from depal.cell.pile import Pile
from depal.domain import BoxId, Perceived, Recognition
from depal.errors import PileError
from depal.selection import BlockingGraph


def standing_apart(pile: Pile) -> tuple[Perceived, ...]:
    """The boxes of a pile without those that another is in the place of.

    A sight that errs may believe two boxes in one place. What is better known stays: a box with a
    name, one that the last look has shown, one whose edges were all seen. What is left out is an
    obstacle still, and has its turn when the other one has left. Of a sight that is exact nothing
    is left out.
    """
    if not pile.remembered:
        return pile.boxes

    def doubts(box: Perceived) -> tuple[bool, bool, bool, BoxId]:
        named = isinstance(box, Recognition)
        return not named, box.id in pile.hidden, box.id in pile.unsized, box.id

    graph = BlockingGraph()
    boxes = pile.boxes
    for box in sorted(boxes, key=doubts):
        with suppress(PileError):
            graph.add(box)
    return tuple(box for box in boxes if box.id in graph)
