"""One run of the study: what `depal run --json` writes, and what is read from it."""

from collections import Counter
from typing import Self

from pydantic import BaseModel, ConfigDict, PrivateAttr

from depal.app.files import Json
from depal.cell.departures import Fate


class _Part(BaseModel):
    """Fields that are not read here are left alone."""

    model_config = ConfigDict(frozen=True, extra="ignore")


class Exit(_Part):
    """A box that left the pallet."""

    stack: int | None
    box: str
    outcome: str
    at: float


class Wish(_Part):
    """A request."""

    served: float | None


class Unstored(_Part):
    """A box that was set aside, taken by a person or left."""

    box: str
    outcome: str
    reason: str


class Hit(_Part):
    """A collision."""

    at: float
    who: str
    against: str
    force: float


class Truth(_Part):
    """What the referee says."""

    collisions: tuple[Hit, ...]

    disagreements: tuple[str, ...]
    suction_losses: tuple[str, ...]


class Row(_Part):
    """What the study reads of a run; the names are those of `depal run --json`."""

    delivery: str
    seed: int
    boxes: int
    stored: int
    lost: int
    collisions: int
    exceptions: tuple[Unstored, ...]
    sequence: tuple[Exit, ...]
    requests: tuple[Wish, ...]
    referee: Truth
    sim_seconds: float
    waiting_seconds: float
    wall_seconds: float
    boxes_per_hour: float
    shares: dict[str, float]
    plan_seconds: tuple[float, ...]
    _fields: dict[str, Json] = PrivateAttr(default_factory=dict)

    @classmethod
    def of(cls, fields: dict[str, Json]) -> Self:
        """Reads a run.

        Raises:
            ValidationError: these are not the fields of a run.
        """
        row = cls.model_validate(fields)
        row._fields = fields
        return row

    @property
    def fields(self) -> dict[str, Json]:
        """All that the run wrote."""
        return self._fields

    @property
    def placed_twice(self) -> int:
        """Boxes of the stack that the books have stored more than once."""
        stored = Counter(gone.stack for gone in self.sequence if gone.outcome == Fate.STORED.value)
        return sum(times > 1 for stack, times in stored.items() if stack is not None)

    @property
    def holds(self) -> bool:
        """Whether nothing was lost, hit or booked wrongly, and every box is accounted for."""
        clean = not (self.lost or self.collisions or self.referee.disagreements)
        accounted = self.stored + len(self.exceptions) + self.lost == self.boxes
        return clean and accounted and not self.placed_twice
