"""What the cell sees, as values."""

from dataclasses import dataclass
from typing import Protocol

from depal.domain import Perceived


@dataclass(frozen=True, slots=True)
class View:
    """What one look at the pallet found.

    Attributes:
        taken: when the picture was taken [s].
        boxes: B_rec united with B_det (section II-C), in the cell frame; a box keeps its name
            from look to look.
    """

    taken: float
    boxes: tuple[Perceived, ...]


class Sight(Protocol):
    """Perception: from a picture to boxes."""

    async def look(self) -> View:
        """Looks at the pallet; exposure and computing take the time that is charged for them.

        Raises:
            DeviceError: no picture came.
        """
        ...
