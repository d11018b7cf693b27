"""How a box is held."""

from dataclasses import dataclass
from enum import Enum

from depal.geometry import Pose


class Approach(Enum):
    """Which face the cups touch."""

    HORIZONTAL = "horizontal"
    VERTICAL = "vertical"


Cup = tuple[str, int]
"""A cup: its module's name and its index in the module."""


@dataclass(frozen=True, slots=True)
class Grasp:
    """A way to hold a box.

    Attributes:
        approach: from the front (horizontal) or from above (vertical).
        folded: whether the lower module is hinged up.
        box_from_flange: where the flange stands, seen from the box's own frame (its centre).
        cups: the cups that are switched on: each wholly on the face, each with its own valve.
    """

    approach: Approach
    folded: bool
    box_from_flange: Pose
    cups: tuple[Cup, ...]

    @property
    def flange_from_box(self) -> Pose:
        """Where the held box is, seen from the flange."""
        return self.box_from_flange.inverse
