"""Where boxes go."""

from dataclasses import dataclass

from depal.domain.names import PlaceId
from depal.geometry import Pose


@dataclass(frozen=True, slots=True)
class Place:
    """One compartment of a trolley or a shelf, filled from the front.

    Attributes:
        id: its name, as in "trolley_1/level_2".
        cell_from_place: the middle of the opening's lower edge; x into the compartment, z up.
        opening: width and clear height of the opening [m].
        depth: from the opening to the back [m].
    """

    id: PlaceId
    cell_from_place: Pose
    opening: tuple[float, float]
    depth: float

    @property
    def volume(self) -> float:
        """What would fit at the very best [m^3]."""
        width, height = self.opening
        return width * height * self.depth
