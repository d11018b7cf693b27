"""A reader that decodes what a test says."""

import asyncio
from collections.abc import Sequence
from dataclasses import dataclass


@dataclass(slots=True)
class FakeReader:
    """Every reading sees the next codes of a script, and none after its end.

    Attributes:
        script: the codes of each reading.
        time: of one reading [s].
        readings: how often it was asked.
    """

    script: Sequence[tuple[str, ...]] = ()
    time: float = 0.3
    readings: int = 0

    async def read(self) -> tuple[str, ...]:
        """What it decodes now."""
        number = self.readings
        self.readings += 1
        await asyncio.sleep(self.time)
        return self.script[number] if number < len(self.script) else ()
