"""An override that notes what it was told."""

from dataclasses import dataclass, field


@dataclass(slots=True)
class FakeOverride:
    """Slows nothing down.

    Attributes:
        told: every limit, in order [m/s].
    """

    told: list[float] = field(default_factory=list)

    def limit(self, speed: float) -> None:
        """Notes it."""
        self.told.append(speed)
