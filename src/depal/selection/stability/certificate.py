"""What is proven about how firmly a pile stands."""

from dataclasses import dataclass
from enum import Enum

from depal.domain import BoxId

Direction = tuple[float, float]

EDGE = 1e-6
"""A pile with no more margin than this stands on an edge, and falls [g]."""


class Proof(Enum):
    """How a margin is meant."""

    EXACT = "exactly"
    AT_LEAST = "at least"
    AT_MOST = "at most"


@dataclass(frozen=True, slots=True)
class Certificate:
    """The margin of a pile: the sideways acceleration that it sustains in every direction.

    Attributes:
        margin: [g]; of EDGE or less: the pile does not stand even at rest.
        proof: whether the margin is exact, or a bound.
        direction: the unit push, along x and y of the cell, that the pile sustains least.
        limiting: the boxes that would begin to move, where any would.
        cases: over so many sets of masses and poses the margin is the worst.
        worst: the one of them in which it is.
    """

    margin: float
    proof: Proof
    direction: Direction
    limiting: tuple[BoxId, ...]
    cases: int = 1
    worst: str = "as believed"

    @property
    def stands(self) -> bool:
        """Whether the pile stands at rest for certain."""
        return self.margin > EDGE and self.proof is not Proof.AT_MOST

    def __str__(self) -> str:
        """One line: "margin at least 0.120 g towards +x, limited by b3 (worst of 9 cases)"."""
        x, y = self.direction
        axis = f"{'+' if x > 0 else '-'}x" if abs(x) >= abs(y) else f"{'+' if y > 0 else '-'}y"
        if self.margin <= EDGE:
            said = "does not stand at rest"
        else:
            said = f"margin {self.proof.value} {self.margin:.3f} g towards {axis}"
        limits = f", limited by {', '.join(self.limiting)}" if self.limiting else ""
        over = f" (worst of {self.cases} cases: {self.worst})" if self.cases > 1 else ""
        return said + limits + over
