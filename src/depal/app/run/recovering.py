"""How long the software takes to go on after a fault: from its notice to the next command."""

from collections.abc import Callable, Sequence

from depal.cell.reporting import Journalist
from depal.executive import events as ev
from depal.executive.events import Outcome
from depal.ports import Trajectory
from depal.simulation.world import World

WRONG = (".stopped", ".on_floor")
"""Facts that say that something is wrong."""


class TimedWorld(World):
    """A world that knows how long it has computed.

    Attributes:
        stopwatch: real time [s]; nothing is decided by it.
        spent: in its physics [s].
    """

    stopwatch: Callable[[], float] = staticmethod(lambda: 0.0)
    spent: float = 0.0

    def advance(self, to: float) -> None:
        """Goes on, and measures it."""
        began = self.stopwatch()
        super().advance(to)
        self.spent += self.stopwatch() - began


class RecoveryTimes:
    """Real time between a failed attempt and the next motion, without the world's own computing.

    Attributes:
        seconds: one for each time that the cell has recovered.
    """

    def __init__(self, world: World) -> None:
        """Nothing has failed yet; a world that measures nothing has none."""
        self._world = world
        self._noticed: float | None = None
        self.seconds: list[float] = []

    def listen_to(self, notes: Journalist) -> None:
        """Hears of what fails."""
        notes.listen(heard=self._heard)

    def _heard(self, _: int, events: Sequence[ev.Event]) -> None:
        if self._noticed is None and any(map(_is_notice, events)):
            self._noticed = self._now()

    def moves(self, _: Trajectory) -> None:
        """A motion is commanded."""
        if self._noticed is not None:
            self.seconds.append(self._now() - self._noticed)
            self._noticed = None

    def _now(self) -> float:
        world = self._world
        return world.stopwatch() - world.spent if isinstance(world, TimedWorld) else 0.0


def _is_notice(event: ev.Event) -> bool:
    """Whether an attempt failed, or a fact says that something is wrong."""
    facts = event.facts if isinstance(event, ev.Ended | ev.Changed) else ()
    failed = isinstance(event, ev.Ended) and event.outcome is not Outcome.DONE
    return failed or any(key.endswith(WRONG) and value for key, value in facts)
