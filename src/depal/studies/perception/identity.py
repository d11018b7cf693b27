"""Whether the boxes that were named are what they were named."""

from collections.abc import Mapping
from dataclasses import dataclass, field

from depal.perception.faces import SeenBox
from depal.studies.perception.truth import TrueBox


@dataclass(frozen=True, slots=True)
class Names:
    """Counts of boxes of one kind.

    Attributes:
        boxes: that were found.
        right: named as what they are.
        wrong: named as another product.
    """

    boxes: int = 0
    right: int = 0
    wrong: int = 0

    def __add__(self, other: "Names") -> "Names":
        """Both together."""
        return Names(self.boxes + other.boxes, self.right + other.right, self.wrong + other.wrong)


@dataclass(frozen=True, slots=True)
class Identities:
    """What became of names, by kind of box.

    Attributes:
        known: boxes whose product has pictures, by their stock.
        siblings: those of the known whose product has a sibling, by their stock.
        unknown: boxes whose product has no pictures; a name is always wrong.
        unknown_siblings: those of the unknown whose sibling has pictures.
        phantoms: names of boxes that are not there.
        twice: names of boxes that are there and were seen as two, by their own names: a fault of
            putting faces together, and not of names.
    """

    known: Mapping[str, Names] = field(default_factory=dict)
    siblings: Mapping[str, Names] = field(default_factory=dict)
    unknown: Names = field(default_factory=Names)
    unknown_siblings: Names = field(default_factory=Names)
    phantoms: int = 0
    twice: int = 0

    def __add__(self, other: "Identities") -> "Identities":
        """Both together."""
        return Identities(
            _together(self.known, other.known),
            _together(self.siblings, other.siblings),
            self.unknown + other.unknown,
            self.unknown_siblings + other.unknown_siblings,
            self.phantoms + other.phantoms,
            self.twice + other.twice,
        )

    @property
    def all_known(self) -> Names:
        """The known of every stock."""
        return sum(self.known.values(), Names())

    @property
    def all_siblings(self) -> Names:
        """The known with a sibling, of every stock."""
        return sum(self.siblings.values(), Names())


def identities(
    seen: tuple[SeenBox, ...],
    true: tuple[TrueBox, ...],
    matched: Mapping[int, int],
    again: Mapping[int, int],
) -> Identities:
    """Counts what was believed of the boxes that were found.

    Args:
        seen: the boxes of a look.
        true: the boxes that are there.
        matched: seen boxes with the true ones that they are.
        again: seen boxes that are true ones which another seen box is already.
    """
    total = Identities()
    for index, box in enumerate(seen):
        if index not in matched:
            twice = index in again and box.gtin == true[again[index]].gtin
            named = int(box.gtin is not None)
            total += Identities(phantoms=named * (not twice), twice=named * twice)
            continue
        really = true[matched[index]]
        right = box.gtin == really.gtin
        names = Names(1, int(right), int(box.gtin is not None and not right))
        if really.known:
            kind = {really.stock: names}
            total += Identities(known=kind, siblings=kind if really.sibling else {})
        else:
            none = Names(1, 0, int(box.gtin is not None))
            total += Identities(unknown=none, unknown_siblings=none if really.sibling else Names())
    return total


def _together(first: Mapping[str, Names], second: Mapping[str, Names]) -> dict[str, Names]:
    kinds = sorted({*first, *second})
    return {kind: first.get(kind, Names()) + second.get(kind, Names()) for kind in kinds}
