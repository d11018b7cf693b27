"""The fewest removals before some boxes can be taken, with the proven bound and the gap."""

from dataclasses import dataclass
from enum import Enum

from depal.selection.access.closure import labelled, unavoidable
from depal.selection.access.program import Limits, solved
from depal.selection.access.ways import Mask, Ways, members


class Proof(Enum):
    """What the bound of a result rests on."""

    CLOSURE = "closure: no order can do without these boxes"
    PROGRAM = "integer program"


@dataclass(frozen=True, slots=True)
class Removal:
    """Boxes that can leave one after the other, until the wanted ones have left too.

    Attributes:
        boxes: all that leave, the wanted ones included.
        wanted: the boxes that all this is for.
        bound: no plan has fewer boxes, the wanted ones included.
        proof: what the bound rests on.
        rounds: programs that were solved for it.
    """

    boxes: Mask
    wanted: Mask
    bound: int
    proof: Proof
    rounds: int = 0

    @property
    def actions(self) -> int:
        """How many boxes leave beside the wanted ones."""
        return (self.boxes & ~self.wanted).bit_count()

    @property
    def least(self) -> int:
        """The proven minimum of `actions`."""
        return self.bound - self.wanted.bit_count()

    @property
    def gap(self) -> int:
        """How far `actions` may be above the minimum; 0: it is the minimum."""
        return self.boxes.bit_count() - self.bound


def fewest_removals(ways: Ways, wanted: Mask, limits: Limits | None = None) -> Removal | None:
    """The smallest set of boxes that can leave and holds the wanted ones.

    Args:
        ways: how boxes can be taken.
        wanted: boxes that are there.
        limits: of the search; what it has by then is returned with its gap. None for the usual.

    Returns:
        The set; None where a wanted box can never leave.
    """
    able = ways.peeled()
    if wanted & ~able:
        return None
    if able != ways.present:
        ways = _among(ways, able)
    bound = unavoidable(ways, wanted)
    if ways.peeled(bound) == bound:
        return Removal(bound, wanted, bound.bit_count(), Proof.CLOSURE)
    labels = labelled(ways)
    found = 0
    for box in members(wanted):
        found |= labels[box][0]
    solution = solved(ways, wanted, found, bound, limits or Limits())
    return Removal(solution.boxes, wanted, solution.bound, Proof.PROGRAM, solution.rounds)


def _among(ways: Ways, able: Mask) -> Ways:
    """Only the boxes that can leave at all, by ways that do not wait for others."""
    kept = tuple(
        tuple(way for way in each if not way.blockers & ~able) if able >> box & 1 else ()
        for box, each in enumerate(ways.of)
    )
    return Ways(ways.present, kept)
