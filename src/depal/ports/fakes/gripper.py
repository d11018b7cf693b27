"""A gripper whose vacuum comes and breaks as a test says."""

import asyncio
from math import inf
from dataclasses import dataclass, field

from depal.domain import Cup

FULL, RISE, VENT = 30_000.0, 0.25, 0.2  # [Pa], [s], [s]


@dataclass(slots=True)
class FakeGripper:
    """Suction by numbers: the first grip is number 0.

    Attributes:
        breaks: when its vacuum breaks, by the number of the grip [s after the valves open].
        weight: of everything that it holds [kg].
        grips: the cups of every grip, in order.
        until: when the vacuum ends [s].
    """

    breaks: dict[int, float] = field(default_factory=dict)
    weight: float = 4.0
    grips: list[tuple[Cup, ...]] = field(default_factory=list)
    until: float = -inf
    up: bool = False

    def load(self) -> float:
        """What hangs on the flange [kg]."""
        return self.weight if any(self.vacuum().values()) else 0.0

    def vacuum(self) -> dict[str, float]:
        """What each module's sensor reads [Pa]."""
        holds = asyncio.get_running_loop().time() < self.until
        used = {module for module, _ in self.grips[-1]} if holds else set()
        return {name: FULL if name in used else 0.0 for name in ("front", "lower")}

    def folded(self) -> bool:
        """Whether the lower module is hinged up."""
        return self.up

    async def fold(self, *, up: bool) -> None:
        """Moves the hinge at once."""
        self.up = up

    async def suck(self, cups: tuple[Cup, ...]) -> bool:
        """Makes vacuum, or not."""
        lasts = self.breaks.get(len(self.grips), inf)
        self.grips.append(cups)
        self.until = asyncio.get_running_loop().time() + lasts
        await asyncio.sleep(RISE)
        return bool(self.load())

    async def release(self) -> None:
        """Vents."""
        await asyncio.sleep(VENT)
        self.until = -inf
