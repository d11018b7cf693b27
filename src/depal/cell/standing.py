"""How firmly the pile stands that a choice leaves: certificates and the guard, in the cell."""

from depal.cell.planning.plans import PickPlan
from depal.cell.workplace import Workplace
from depal.domain import BoxId, Perceived
from depal.selection import Blocking, Refused
from depal.selection.stability import (
    CAMERA,
    SEEN,
    SURE,
    THRESHOLD,
    Certificate,
    StandingPile,
    weigh,
)


class Standing:
    """The pile of one selection, asked for what it is without a box."""

    def __init__(self, work: Workplace, graph: Blocking) -> None:
        """What is perceived, with the masses of the note and the errors of the sight."""
        slots = graph.used_slots.tolist()
        boxes = [graph.at(slot) for slot in slots]
        self._rows = {box.id: row for row, box in enumerate(boxes)}
        prisms = graph.prisms[graph.used_slots]
        masses, shares = weigh(boxes, prisms, work.delivery.products)
        self._pile = StandingPile(
            prisms,
            masses,
            names=[box.id for box in boxes],
            shares=shares,
            doubt=CAMERA if work.pile.remembered else SURE,
            rule=SEEN,
            deck=work.layout.pallet.cell_from_pallet.translation[2],
        )

    def without(self, box: BoxId) -> Certificate:
        """The pile that a box leaves: whether THRESHOLD is met, and by how much where it is not."""
        return self._pile.certificate((self._rows[box],), at_least=THRESHOLD)


class Guard:
    """Puts boxes later that would leave a pile with too little margin, in one selection."""

    def __init__(self, standing: Standing) -> None:
        """Nothing was put later yet."""
        self._standing = standing
        self._later: dict[BoxId, tuple[Certificate, PickPlan]] = {}
        self._forced: BoxId | None = None

    def judged(self, box: Perceived, plan: PickPlan) -> PickPlan | Refused:
        """The plan, or why the box is put later."""
        if box.id == self._forced:
            return plan
        certificate = self._standing.without(box.id)
        if certificate.margin >= THRESHOLD:
            return plan
        self._later[box.id] = certificate, plan
        return Refused(f"the pile that it leaves: {certificate}")

    def kept(self, box: Perceived) -> PickPlan | None:
        """The plan of a box that was put later."""
        found = self._later.get(box.id)
        return None if found is None else found[1]

    def force(self) -> bool:
        """Lets the firmest of the boxes pass that were put later; whether there is one."""
        if not self._later or self._forced is not None:
            return False
        self._forced = max(self._later, key=lambda box: self._later[box][0].margin)
        return True
