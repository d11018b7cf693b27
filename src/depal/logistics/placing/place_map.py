"""One compartment and what stands in it."""

from collections.abc import Mapping
from dataclasses import dataclass, replace

from depal.domain import BoxId, Place
from depal.errors import SettingError, did_you_mean
from depal.logistics.placing.values import Standing


@dataclass(frozen=True, slots=True)
class PlaceMap:
    """A place with the boxes that stand in it, as the cell believes.

    Attributes:
        place: the compartment.
        boxes: in the order in which they came.
    """

    place: Place
    boxes: tuple[Standing, ...] = ()

    @property
    def by_id(self) -> Mapping[BoxId, Standing]:
        """The boxes by their names."""
        return {box.id: box for box in self.boxes}

    @property
    def fill(self) -> float:
        """The share of the compartment's volume that boxes take."""
        return sum(box.volume for box in self.boxes) / self.place.volume

    def with_box(self, box: Standing) -> "PlaceMap":
        """The place after a box came.

        Raises:
            SettingError: it stands there already.
        """
        if box.id in self.by_id:
            raise SettingError(
                f"box {box.id}", f"stands in {self.place.id} already", "a box that stands nowhere"
            )
        return replace(self, boxes=(*self.boxes, box))

    def without_box(self, box: BoxId) -> "PlaceMap":
        """The place after a box left.

        Raises:
            SettingError: it does not stand there.
        """
        if box not in self.by_id:
            exists = did_you_mean(box, self.by_id)
            raise SettingError(f"box {box}", f"does not stand in {self.place.id}", exists=exists)
        return replace(self, boxes=tuple(other for other in self.boxes if other.id != box))
