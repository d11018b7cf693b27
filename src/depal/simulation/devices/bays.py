"""The simulated sensors of the bays."""

from depal.domain import PlaceId
from depal.executive.clock import Clock
from depal.geometry import OrientedBox
from depal.simulation.devices.ranging import profile_of
from depal.simulation.model import STRAY
from depal.simulation.world import World


class SimulatedBays:
    """Which trolley stands where, and how far in its compartments are free."""

    def __init__(self, world: World, clock: Clock) -> None:
        """The bays of this world."""
        self._world = world
        self._clock = clock

    def trolley(self, bay: str) -> str | None:
        """The name of the trolley that stands locked in the bay, None where none does."""
        return self._world.bays.get(bay)

    async def profile(self, place: PlaceId) -> tuple[float, ...]:
        """How far in a compartment is free, strip by strip [m]."""
        self._world.advance(self._clock.now())
        return profile_of(self._world.layout.places[place], self._things())

    def _things(self) -> list[OrientedBox]:
        """Whatever may stand there: every box but those in the hand, and what people leave."""
        world = self._world
        things = [
            OrientedBox(world.box(case.index), case.shape.size)
            for case in world.cases
            if case.index not in world.suction.held_boxes
        ]
        stray = world.stray_pose
        return things if stray is None else [*things, OrientedBox(stray, STRAY)]
