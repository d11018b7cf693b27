"""What planning hands out: paths in named parts, or the reasons why there are none."""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from enum import Enum

from depal.domain import Grasp
from depal.geometry import Vector3
from depal.motion.collision.values import Array, Scene
from depal.motion.grasping.bulk import EXACT


class Kind(Enum):
    """What a part of a path is."""

    FREE = "free"
    STRAIGHT = "straight"


@dataclass(frozen=True, slots=True, eq=False)
class Part:
    """A part of a path.

    Attributes:
        kind: free, with corners between which the axes move evenly, or a straight move.
        path: (n, 6) [rad]; it begins where the part before ended.
        touching: whether the held box may touch what it stands beside or on.
        most: the flange is no faster here [m/s].
    """

    kind: Kind
    path: Array
    touching: bool = False
    most: float = math.inf


@dataclass(frozen=True, slots=True)
class NoMotion:
    """Why a motion is not possible.

    Attributes:
        reasons: of each way that was tried, the most frequent first, in words.
    """

    reasons: tuple[str, ...]

    @classmethod
    def because(cls, reasons: Sequence[str]) -> "NoMotion":
        """Every reason once, the most frequent first."""
        once = dict.fromkeys(reasons)
        return cls(tuple(sorted(once, key=lambda reason: -reasons.count(reason))))

    def __str__(self) -> str:
        """In one line."""
        return "; ".join(self.reasons[:3]) or "no way to hold it"


@dataclass(frozen=True, slots=True, eq=False)
class Doubts:
    """What of a pile is not known for sure when a box is taken off it.

    Attributes:
        beyond: how much longer the box may be along its own axes, at either end: it is taken
            straight on until whatever it may be is clear [m].
        wary: what an empty hand keeps clear of, the box as it is; None for what is seen.
        roomy: what the held box is clear of where its way out of the pile ends, the box left out;
            None for what is seen.
    """

    beyond: Vector3 = EXACT
    wary: Scene | None = None
    roomy: Scene | None = None


SURE = Doubts()
"""Everything is as it looks."""


@dataclass(frozen=True, slots=True, eq=False)
class Pick:
    """A box is taken off the pile.

    Attributes:
        grasp: how.
        approach: to the plane of touch.
        lift: straight up by a little, holding.
        out: straight out of the pile, holding.
    """

    grasp: Grasp
    approach: tuple[Part, ...]
    lift: Part
    out: Part


@dataclass(frozen=True, slots=True, eq=False)
class Put:
    """A held box is put into a place.

    Attributes:
        carry: to just above where it will stand.
        descent: straight down, further than needed as long as the tool is clear: it is stopped by
            the load.
        retreat: straight out again, empty.
    """

    carry: tuple[Part, ...]
    descent: Part
    retreat: Part
