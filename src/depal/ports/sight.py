"""What the cell sees, as values."""

from dataclasses import dataclass
from typing import Protocol

from depal.domain import BoxId, Perceived
from depal.geometry import OrientedBox


@dataclass(frozen=True, slots=True)
class View:
    """What one look at the pallet found.

    Attributes:
        taken: when the picture was taken [s].
        boxes: B_rec united with B_det (section II-C), in the cell frame; a box keeps its name
            from look to look.
        remembered: whether the boxes are all that is believed to stand there after this look and
            those before; else they are what this look alone has found.
        hidden: of what is believed, what this look did not show.
        unsized: boxes of which an edge could not be measured and is a guess.
        moved: boxes that this look shows elsewhere than those before.
        obstacles: solids where something stands that no box explains, in the cell frame; None
            where this look cannot tell.
    """

    taken: float
    boxes: tuple[Perceived, ...]
    remembered: bool = False
    hidden: frozenset[BoxId] = frozenset()
    unsized: frozenset[BoxId] = frozenset()
    moved: frozenset[BoxId] = frozenset()
    obstacles: tuple[OrientedBox, ...] | None = ()


class Sight(Protocol):
    """Perception: from a picture to boxes."""

    async def look(self) -> View:
        """Looks at the pallet; exposure and computing take the time that is charged for them.

        Raises:
            DeviceError: no picture came.
        """
        ...
