"""The simulated sensors of the bays."""

from depal.simulation.world import World


class SimulatedBays:
    """Which trolley stands where."""

    def __init__(self, world: World) -> None:
        """The bays of this world."""
        self._world = world

    def trolley(self, bay: str) -> str | None:
        """The name of the trolley that stands locked in the bay, None where none does."""
        return self._world.bays.get(bay)
