"""What a served cell sees with: its cameras in a thread of their own, or the simulator's truth."""

import asyncio
from collections.abc import Sequence
from dataclasses import dataclass, replace

from depal.app.run.eyes import sight_over
from depal.app.serve.outside import World
from depal.cell.ledger import Page
from depal.cell.pile import seen_as
from depal.cell.sight import CameraSight
from depal.domain import CellLayout, Delivery
from depal.executive.clock import Clock
from depal.ports import Frame, Sight


@dataclass(slots=True)
class Seen:
    """A sight, its names, and the pictures of its last look.

    Attributes:
        sight: behind the port.
    """

    sight: Sight

    def named(self) -> int:
        """How many names it has given; 0 where names are not its own."""
        return self.sight.memory.named if isinstance(self.sight, CameraSight) else 0

    def recall(self, page: Page) -> None:
        """What was seen and named before a restart keeps its name where it still stands."""
        if isinstance(self.sight, CameraSight):
            known = [(piled.box, seen_as(piled.perceived)) for piled in page.pile]
            self.sight.memory = replace(self.sight.memory.told(known, 0.0), named=page.named)

    @property
    def frames(self) -> tuple[Frame, ...]:
        """Of the last look; none where no camera is asked."""
        if not isinstance(self.sight, CameraSight) or self.sight.last is None:
            return ()
        return self.sight.frames


async def seen_with(
    perception: str, layout: CellLayout, told: Delivery, world: World, clock: Clock, seed: int
) -> Seen:
    """The sight of a run.

    Args:
        perception: "camera" or "truth".
        layout: the cell.
        told: the note.
        world: whose cameras take the pictures.
        clock: of the cell.
        seed: of the simulated store's product pictures.

    Raises:
        FrameError: a camera cannot be calibrated.
        DeviceError: no picture came.
    """
    if perception == "truth":
        return Seen(world.truth_sight)
    frames: Sequence[Frame] = await asyncio.gather(*(camera.take() for camera in world.cameras))
    sight = sight_over(layout, told.lines, seed, world.cameras, frames, clock)
    sight.compute = asyncio.to_thread
    return Seen(sight)
