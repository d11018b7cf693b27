"""The guard for selections that ask box by box: refusals now, the firmest when all are refused."""

from collections.abc import Mapping

from depal.domain import BoxId
from depal.selection.decision import Refused
from depal.selection.stability.certificate import Certificate
from depal.selection.stability.guard import THRESHOLD
from depal.selection.stability.pile import StandingPile


class Watch:
    """Answers for one pile; ask it first in the `grasp_for` of `select`.

    Where every graspable box was refused, select once more with `relent`: then the box whose
    removal leaves the firmest pile is let through, and no other.
    """

    def __init__(self, pile: StandingPile, threshold: float = THRESHOLD) -> None:
        """Nothing was asked yet.

        Args:
            pile: by whose names boxes are asked for.
            threshold: the least margin that is enough [g].
        """
        self._pile, self._threshold = pile, threshold
        self._rows = {name: row for row, name in enumerate(pile.names)}
        self._found: dict[BoxId, Certificate] = {}
        self._let: BoxId | None = None

    @property
    def certificates(self) -> Mapping[BoxId, Certificate]:
        """Of the piles that the boxes that were asked for would leave."""
        return self._found

    def refusal(self, box: BoxId) -> Refused | None:
        """Why a box is to be put later; None where it may go. One that is not known may."""
        if box not in self._rows:
            return None
        if box not in self._found:
            self._found[box] = self._pile.certificate([self._rows[box]], self._threshold)
        if box == self._let or self._found[box].margin >= self._threshold:
            return None
        return Refused(f"the pile that it leaves: {self._found[box]}")

    def relent(self, among: tuple[BoxId, ...]) -> BoxId | None:
        """Lets through the one of these boxes that leaves the firmest pile, the first of equals.

        Args:
            among: boxes that were refused, by falling preference.

        Returns:
            That box, or None where none of them was asked for.
        """
        asked = [box for box in among if box in self._found]
        self._let = max(asked, key=lambda box: self._found[box].margin, default=None)
        return self._let
