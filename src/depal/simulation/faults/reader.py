"""A barcode reader before labels that nobody can read."""

from depal.ports import BarcodeReader
from depal.simulation.faults.catalogue import Phase
from depal.simulation.faults.chances import Chances
from depal.simulation.world import World


class FaultyReader:
    """N1: a box has no readable label, on none of its sides."""

    def __init__(self, reader: BarcodeReader, world: World, chances: Chances) -> None:
        """A reader of this world."""
        self._reader, self._world, self._chances = reader, world, chances

    async def read(self) -> tuple[str, ...]:
        """What it decodes now."""
        codes = await self._reader.read()
        held = self._world.suction.held_boxes
        box = held[0] if held else None
        blank = any(each.fault.id == "N1" and each.box == box for each in self._chances.struck)
        if box is not None and not blank:
            blank = self._chances.strikes("N1", Phase.READ, box) is not None
        return () if blank else codes
