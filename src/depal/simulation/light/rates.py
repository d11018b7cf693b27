"""How often things go wrong in a light world."""

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Rates:
    """The probability of each fault at each of its chances.

    Attributes:
        missed: the vacuum is not reached, of a suction at a box (G1).
        double: a neighbour sticks to the box, of a suction that has one beside it (G4).
        infeasible: nothing reaches a box in the pile as it stands (M3).
        dropped: the box falls, of a way through the cell with a box (G3).
    """

    missed: float = 0.0
    double: float = 0.0
    infeasible: float = 0.0
    dropped: float = 0.0


NO_FAULTS = Rates()

SOAK = Rates(missed=0.02, double=0.009, infeasible=0.045)
"""Published for a large fleet of picking arms."""
