"""How firmly the pile stands that a choice leaves: the note's masses, the errors of the sight."""

from depal.cell.workplace import Workplace
from depal.domain import BoxId
from depal.selection import Blocking
from depal.selection.stability import (
    CAMERA,
    SEEN,
    SURE,
    THRESHOLD,
    Certificate,
    StandingPile,
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
