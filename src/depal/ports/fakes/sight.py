"""Perception that sees what a test says."""

import asyncio
from collections.abc import Sequence
from dataclasses import dataclass

from depal.domain import Perceived
from depal.errors import DeviceError
from depal.ports.sight import View


@dataclass(slots=True)
class FakeSight:
    """Every look finds the next boxes of a script; the last ones stay.

    Attributes:
        script: what each look finds; None where no picture comes.
        time: of one look [s].
        looks: how often it looked.
    """

    script: Sequence[tuple[Perceived, ...] | None]
    time: float = 1.0
    looks: int = 0

    async def look(self) -> View:
        """Looks; the picture is taken at the beginning."""
        taken = asyncio.get_running_loop().time()
        found = self.script[min(self.looks, len(self.script) - 1)]
        self.looks += 1
        await asyncio.sleep(self.time)
        if found is None:
            raise DeviceError("no picture came")
        return View(taken, found)
