"""Bays in which trolleys come and go as a test says."""

import asyncio
import math
from dataclasses import dataclass, field

from depal.domain import PlaceId


@dataclass(slots=True)
class FakeBays:
    """A trolley stands in every bay unless it was pulled out.

    Attributes:
        pulled: bays without a trolley.
        exchanges: when [s] which bay got another trolley.
        profiles: what the range sensors of some places read [m]; the others are empty.
    """

    pulled: set[str] = field(default_factory=set)
    exchanges: list[tuple[float, str]] = field(default_factory=list)
    profiles: dict[PlaceId, tuple[float, ...]] = field(default_factory=dict)

    def trolley(self, bay: str) -> str | None:
        """The trolley in the bay."""
        number = 1 + sum(name == bay for _, name in self.exchanges)
        return None if bay in self.pulled else f"{bay}#{number}"

    async def profile(self, place: PlaceId) -> tuple[float, ...]:
        """How far in a compartment is free."""
        return self.profiles.get(place, (math.inf,))

    def exchange(self, bay: str) -> None:
        """Another trolley stands there."""
        self.pulled.discard(bay)
        self.exchanges.append((asyncio.get_running_loop().time(), bay))
