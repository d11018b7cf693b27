"""Boxes that no way leads to: they are planned for again where something near has changed.

A sight that errs shows a box a little elsewhere at every look, and what stands in the way of a tool
or an arm mostly goes on to do so until a neighbour has left, or has been named. Each plan costs the
arm a moment; so what was refused is tried after all that was not.
"""

import math
from collections.abc import Mapping
from dataclasses import dataclass, field

from depal.cell.pile import Pile
from depal.domain import BoxId, Perceived, Recognition

NEAR = 0.6
"""What stands this far from a box, middle to middle, may be in the way of what takes it [m]."""

Neighbours = Mapping[BoxId, bool]
"""Which boxes stand near one, itself among them, and whether they have a name."""


@dataclass(slots=True)
class Refusals:
    """What was refused, and among which neighbours."""

    _kept: dict[BoxId, tuple[Neighbours, str]] = field(default_factory=dict)

    def keep(self, box: Perceived, pile: Pile, reason: str) -> None:
        """No way leads to a box."""
        self._kept[box.id] = (_neighbours(box, pile), reason)

    def still(self, box: Perceived, pile: Pile) -> str | None:
        """Why no way led to a box among the same neighbours; None where they were others."""
        among, reason = self._kept.get(box.id, ({}, ""))
        return reason if among == _neighbours(box, pile) else None


def _neighbours(box: Perceived, pile: Pile) -> Neighbours:
    here = box.shape.centre[:2]
    return {
        other.id: isinstance(other, Recognition)
        for other in pile.boxes
        if math.dist(other.shape.centre[:2], here) < NEAR
    }
