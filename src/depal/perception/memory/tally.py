"""What the note promises, beside what is there and what has left: unseen boxes, contradictions."""

from collections import Counter
from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from depal.domain import DeliveryLine, Gtin


@dataclass(frozen=True, slots=True)
class Surplus:
    """A product of which there is more than the note promises.

    Attributes:
        gtin: which.
        found: how many cases were seen or taken.
        promised: how many the note has; 0 where the product is not on it.
    """

    gtin: Gtin
    found: int
    promised: int

    def __str__(self) -> str:
        """As a reason."""
        if not self.promised:
            return f"product {self.gtin} is not on the note"
        return f"the note promises {self.promised} of product {self.gtin}, this is one more"


@dataclass(frozen=True, slots=True)
class Tally:
    """The note after so many looks and picks.

    Attributes:
        unseen: by product: how many the note promises that nobody has named yet.
        unnamed: boxes that are there, or have left, whose product nobody knows.
        surplus: products of which there are too many.
    """

    unseen: dict[Gtin, int]
    unnamed: int
    surplus: tuple[Surplus, ...]

    @property
    def missing(self) -> int:
        """How many boxes of the note nobody has seen at all."""
        return max(0, sum(self.unseen.values()) - self.unnamed)


def tally_of(note: Sequence[DeliveryLine], found: Iterable[Gtin | None]) -> Tally:
    """Counts what was found against the note.

    Args:
        note: the lines.
        found: the product of every box that is there or has left; None where nobody knows it.
    """
    counts: Counter[Gtin] = Counter()
    unnamed = 0
    for gtin in found:
        if gtin is None:
            unnamed += 1
        else:
            counts[gtin] += 1
    promised = {line.product.gtin: line.count for line in note}
    unseen = {
        gtin: count - counts[gtin] for gtin, count in promised.items() if count > counts[gtin]
    }
    surplus = tuple(
        Surplus(gtin, counts[gtin], promised.get(gtin, 0))
        for gtin in sorted(counts)
        if counts[gtin] > promised.get(gtin, 0)
    )
    return Tally(unseen, unnamed, surplus)
