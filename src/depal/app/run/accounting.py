"""Every box accounted for: what the cell's names mean, and what nobody has seen."""

from collections.abc import Mapping, Sequence

from depal.app.run.summary import UNSEEN, Left
from depal.cell.departures import Departure
from depal.cell.reporting import Journalist
from depal.cell.workplace import Workplace
from depal.domain import BoxId
from depal.executive import events as ev
from depal.simulation.referee import PALLET, Referee
from depal.simulation.witness import Witness

TAKEN_FACT = ".taken"


class Onlooker:
    """Watches the arm for the referee: which box hangs in it when the cell says one does."""

    def __init__(self, witness: Witness) -> None:
        """Tells the witness."""
        self._witness = witness

    def listen_to(self, notes: Journalist) -> None:
        """Learns of what happens."""
        notes.listen(heard=self._heard)

    def _heard(self, _: int, events: Sequence[ev.Event]) -> None:
        for event in events:
            facts = event.facts if isinstance(event, ev.Ended) else ()
            for key, value in facts:
                if key.endswith(TAKEN_FACT) and value:
                    self._witness.lifted(BoxId(key.removesuffix(TAKEN_FACT)), event.at)


def left_behind(
    work: Workplace, departures: Sequence[Departure], witness: Witness, boxes: int
) -> tuple[Left, ...]:
    """The boxes that stayed on the pallet, and those that nobody has seen.

    Args:
        work: what the cell believes at the end.
        departures: the boxes that left.
        witness: knows where boxes are.
        boxes: how many there are.
    """
    left = []
    for box in work.pile.boxes:
        index = witness.find(box.id, box.shape.centre)
        if index is None:
            continue  # what a look has made up is no box
        witness.means(box.id, index)
        left.append(Left(box.id, work.left_behind.get(box.id, "the run ended")))
    missing = boxes - len(left) - len(departures)
    return (*left, *(Left(BoxId(f"{UNSEEN} {k}"), "never seen") for k in range(1, missing + 1)))


def meant(
    names: Mapping[BoxId, int], left: Sequence[Left], referee: Referee, boxes: int
) -> dict[BoxId, int]:
    """Which box of the stack each name means; the unseen ones are those that nobody has named.

    Boxes that still stand on the pallet come first: what is elsewhere was not left unseen.
    """
    known = dict(names)
    spare = sorted(
        set(range(boxes)) - set(known.values()),
        key=lambda index: (referee.where(index) != PALLET, index),
    )
    unseen = [entry.box for entry in left if entry.box not in known]
    return {**known, **dict(zip(unseen, spare, strict=False))}
