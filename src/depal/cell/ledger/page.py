"""One page of the ledger: everything about a run that no sensor can tell again."""

from dataclasses import dataclass

from depal.cell.departures import Departure, Departures
from depal.cell.hand import Hand
from depal.cell.planning.promises import Promises
from depal.cell.wishes import Wish, Wishes
from depal.cell.workplace import Workplace
from depal.domain import BoxId, Detection, Gtin, Perceived, PlaceId, Recognition
from depal.geometry import OrientedBox
from depal.logistics.placing import Standing


@dataclass(frozen=True, slots=True)
class KeptBox:
    """A box that stands in a place.

    Attributes:
        place: where.
        standing: in the place's frame.
        solid: in the cell frame.
    """

    place: PlaceId
    standing: Standing
    solid: OrientedBox


@dataclass(frozen=True, slots=True)
class LeftBox:
    """A box that is off the pallet.

    Attributes:
        box: its name.
        at: when it left [s].
        gtin: what it was taken for then or later; None where nobody knows.
    """

    box: BoxId
    at: float
    gtin: Gtin | None


@dataclass(frozen=True, slots=True)
class PiledBox:
    """A box as it is believed to stand on the pallet.

    Attributes:
        box: its name.
        solid: in the cell frame.
        gtin: its product; None where it is only detected.
    """

    box: BoxId
    solid: OrientedBox
    gtin: Gtin | None

    @property
    def perceived(self) -> Perceived:
        """The same as a look would tell it."""
        if self.gtin is None:
            return Detection(self.box, self.solid)
        return Recognition(self.box, self.solid, self.gtin)


@dataclass(frozen=True, slots=True)
class Page:
    """What the cell must still know after a restart.

    Attributes:
        hand: the step that the box in the gripper is in.
        left: the boxes that are off the pallet, in the order in which they left.
        departures: what became of them.
        kept: what stands in the places.
        pile: what is believed to stand on the pallet.
        wishes: the requests and what became of them, in the order in which they came.
        strangers: what the reader saw on boxes that are not on the note.
        aside: why boxes are set aside.
        seen_to: whether a person has looked for what the note promises and no look shows.
        named: how many names the sight has given.
    """

    hand: Hand | None = None
    left: tuple[LeftBox, ...] = ()
    departures: tuple[Departure, ...] = ()
    kept: tuple[KeptBox, ...] = ()
    pile: tuple[PiledBox, ...] = ()
    wishes: tuple[Wish, ...] = ()
    strangers: tuple[tuple[BoxId, str], ...] = ()
    aside: tuple[tuple[BoxId, str], ...] = ()
    seen_to: bool = False
    named: int = 0


def page_of(work: Workplace, promises: Promises, named: int = 0) -> Page:
    """The page of this moment.

    Args:
        work: what the cell believes.
        promises: the books; what is only promised is left out.
        named: how many names the sight has given.
    """
    standing = [
        KeptBox(place, box, solid)
        for box, place, solid in promises.stored()
        if work.departures.has_ended(box.id) or _in_hand(work.hand, box.id)
    ]
    gtins = work.pile.departed
    return Page(
        hand=work.hand,
        left=tuple(LeftBox(box, at, gtins.get(box)) for box, at in work.departures.times.items()),
        departures=work.departures.sequence,
        kept=tuple(standing),
        pile=tuple(
            PiledBox(box.id, box.shape, box.gtin if isinstance(box, Recognition) else None)
            for box in work.pile.boxes
        ),
        wishes=tuple(work.wishes),
        strangers=tuple(work.strangers.items()),
        aside=tuple(work.aside_reasons.items()),
        seen_to=work.seen_to,
        named=named,
    )


def _in_hand(hand: Hand | None, box: BoxId) -> bool:
    """Whether a box is being set down: its spot is written, so that a restart finds it."""
    return hand is not None and hand.box == box and hand.place is not None


def restore(page: Page, work: Workplace, promises: Promises) -> None:
    """Brings a new workplace to where a page was written.

    The step that a box was in stays written until somebody knows how it has ended.
    """
    work.hand = page.hand
    departures = Departures()
    for left in page.left:
        departures.leaves(left.box, left.at)
    for departure in page.departures:
        departures.ends(departure)
    work.departures = departures
    work.wishes = Wishes.restored(page.wishes)
    work.strangers.update(page.strangers)
    work.aside_reasons.update(page.aside)
    work.seen_to = page.seen_to
    for left in page.left:
        work.pile.away(left.box, left.at, left.gtin)
        work.gone(left.box).set()
    work.pile.recall(box.perceived for box in page.pile)
    for kept in page.kept:
        promises.stands(kept.place, kept.standing, kept.solid)
