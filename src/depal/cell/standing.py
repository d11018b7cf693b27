"""How firmly the pile stands that a choice leaves: the note's masses, the errors of the sight."""

from depal.cell.apart import standing_apart
from depal.cell.quantities import MARGIN
from depal.cell.rules import TAKING, limits_on_box
from depal.cell.workplace import Workplace
from depal.domain import BoxId
from depal.selection import Blocking, BlockingGraph, Refused
from depal.selection.stability import (
    CAMERA,
    SEEN,
    SURE,
    THRESHOLD,
    Certificate,
    StandingPile,
    Watch,
    weigh,
)


def standing_pile(work: Workplace, graph: Blocking) -> StandingPile:
    """What is perceived, as it stands; its boxes go by their names."""
    boxes = [graph.at(slot) for slot in graph.used_slots.tolist()]
    prisms = graph.prisms[graph.used_slots]
    masses, shares = weigh(boxes, prisms, work.delivery.products)
    return StandingPile(
        prisms,
        masses,
        names=[box.id for box in boxes],
        shares=shares,
        doubt=CAMERA if work.pile.remembered else SURE,
        rule=SEEN,
        deck=work.layout.pallet.cell_from_pallet.translation[2],
    )


def left_by(pile: StandingPile, box: BoxId) -> Certificate:
    """The pile that a box leaves: whether THRESHOLD is met, and by how much where it is not."""
    return pile.certificate((pile.names.index(box),), at_least=THRESHOLD)


class Firmness:
    """Refuses boxes whose tasks want a firmer pile than they would leave."""

    def __init__(self, work: Workplace, pile: StandingPile | None = None) -> None:
        """For one state of the pile.

        Args:
            work: its boxes, and the limits of their tasks.
            pile: as it stands; None to work it out where a task asks.
        """
        self._work, self._pile = work, pile
        self._watches: dict[float, Watch] = {}

    def refusal(self, box: BoxId) -> Refused | None:
        """Why a box must stay, as long as the pile is as it is; None where nothing asks for more.

        Unlike the guard it never relents: a person takes the box, or nobody.
        """
        least = limits_on_box(self._work.engine, box, TAKING).get(MARGIN)
        if least is None:
            return None
        if self._pile is None:
            graph = BlockingGraph(standing_apart(self._work.pile))
            self._pile = standing_pile(self._work, graph)
        watch = self._watches.setdefault(least, Watch(self._pile, least))
        refused = watch.refusal(box)
        if refused is None:
            return None
        return Refused(f"{refused.reason}, and its task asks for at least {least:.3g} g")
