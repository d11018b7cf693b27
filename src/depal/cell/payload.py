"""What the tasks let be lifted: asked before a box is touched, and once it hangs on the arm."""

import math
from dataclasses import dataclass, field

from depal.cell.quantities import PAYLOAD
from depal.domain import BoxId
from depal.executive.limits import Limits


@dataclass(slots=True)
class Payload:
    """What is known of boxes that are too heavy.

    Attributes:
        weighed: what boxes have weighed that were put back for it [kg].
    """

    weighed: dict[BoxId, float] = field(default_factory=dict)

    def refusal(self, box: BoxId, least: float | None, limits: Limits) -> str | None:
        """Why a box must not be lifted; None where it may be tried.

        Args:
            box: which.
            least: what it weighs at the least, by what it is or by its size; None for unknown [kg].
            limits: of the action that is to lift it.
        """
        mass = self.weighed.get(box, least or 0.0)
        most = limits.get(PAYLOAD, math.inf)
        return _too_heavy(mass, most) if mass > most else None

    def felt(self, box: BoxId, mass: float, limits: Limits) -> str | None:
        """Why a box that hangs on the arm must be put back; it is remembered what it weighed."""
        most = limits.get(PAYLOAD, math.inf)
        if mass <= most:
            return None
        self.weighed[box] = mass
        return _too_heavy(mass, most)


def _too_heavy(mass: float, most: float) -> str:
    return f"it weighs {mass:.1f} kg, and the task lets at most {most:.1f} kg be lifted"
