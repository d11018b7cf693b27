"""An arm that loses boxes, leaves its path, meets a torque, or is stopped."""

from collections.abc import Callable

from depal.domain import Joints
from depal.errors import DeviceError
from depal.executive.clock import Clock
from depal.ports import Arm, Guard, Trajectory, Watch
from depal.simulation.devices.safety import SimulatedSafety, Visit
from depal.simulation.faults.catalogue import Phase
from depal.simulation.faults.chances import Chances
from depal.simulation.faults.pile import FaultyPile
from depal.simulation.faults.plan import Struck
from depal.simulation.world import World

PATH = "the arm has left its path by more than it may (-4)"
TORQUE = "the arm met a torque that it did not expect, and waits for a person"

ANY, EARLY = (0.1, 0.9), (0.05, 0.25)
"""In this part of a motion something happens; a box that is set down stands before its end."""


class FaultyArm:
    """G3, M5, M6, M7 and O1 strike while it moves, M6 and M7 until a person has seen to them.

    Attributes:
        began: when each motion began [s], for the referee.
        most_held: so many boxes hung on it together when a motion after the lift began.
        fell: when each box was pulled off the cups [s].
        watchers: told of each motion before it begins.
    """

    def __init__(
        self,
        arm: Arm,
        world: World,
        clock: Clock,
        safety: SimulatedSafety,
        chances: Chances,
        pile: FaultyPile,
    ) -> None:
        """An arm of this world in which faults strike."""
        self._arm, self._world, self._clock = arm, world, clock
        self._safety, self._chances, self._pile = safety, chances, pile
        self._lifted: int | None = None
        self._torque = False
        self.began: list[float] = []
        self.most_held = 0
        self.fell: dict[int, float] = {}
        self.watchers: list[Callable[[Trajectory], None]] = []

    def joints(self) -> Joints:
        """Where the axes are [rad]."""
        return self._arm.joints()

    def load(self) -> float:
        """What hangs on the flange [kg]."""
        return self._arm.load()

    def acknowledged(self) -> None:
        """A person has seen to what stopped it."""
        self._torque = False

    async def follow(self, trajectory: Trajectory, guard: Guard | None = None) -> str | None:
        """Moves, unless something happens on the way.

        Raises:
            DeviceError: as the arm does; and where it has left its path or met a torque.
        """
        if self._torque:
            raise DeviceError(TORQUE)
        self._begins(trajectory)
        phase, box = self._phase(guard)
        if phase is Phase.REACH:
            self._pile.reached_for(trajectory.end)
        elif phase is not None:
            self.most_held = max(self.most_held, len(self._world.suction.held_boxes))
        found = None if phase is None else self._struck(phase, box)
        if found is None:
            return await self._arm.follow(trajectory, guard)
        struck, doing = found
        early, late = EARLY if phase is Phase.PLACE else ANY
        share = float(self._chances.dice(1).uniform(early, late))
        when = self._clock.now() + share * trajectory.duration
        said: list[str] = []

        def watched() -> str | None:
            if not said and self._clock.now() >= when:
                said.append(doing() or "")
            return (said[0] if said else "") or (guard() if guard is not None else None)

        try:
            reason = await self._arm.follow(trajectory, watched)
        finally:
            if not said:
                self._chances.take_back(struck)
        if reason in {PATH, TORQUE}:
            raise DeviceError(reason)
        return reason

    def _begins(self, trajectory: Trajectory) -> None:
        if self._safety.state().stopped:
            return
        self.began.append(self._clock.now())
        for watcher in self.watchers:
            watcher(trajectory)

    def _phase(self, guard: Guard | None) -> tuple[Phase | None, int | None]:
        """What this motion is; the lift belongs to the grasp, in which nothing strikes the arm."""
        held = self._world.suction.held_boxes
        if not held:
            self._lifted = None
            return Phase.REACH, None
        box = held[0]
        if box != self._lifted:
            self._lifted = box
            self._chances.step += 1
            return None, box
        watch = getattr(guard, "watch", None)
        lowering = isinstance(watch, Watch) and watch.load is not None
        return Phase.PLACE if lowering else Phase.CARRY, box

    def _struck(
        self, phase: Phase, box: int | None
    ) -> tuple[Struck, Callable[[], str | None]] | None:
        """What happens during this motion."""
        visited = self._chances.strikes("O1", phase, box)
        if visited is not None:
            return visited, lambda: self._let_in(visited)
        doings = {"G3": self._drop, "M5": _leave, "M6": self._meet, "M7": self._stop}
        for name, doing in doings.items():
            struck = self._chances.strikes(name, phase, box)
            if struck is not None:
                return struck, doing
        return None

    def _let_in(self, visited: Struck) -> str | None:
        lasts = visited.fault.lasts
        self._safety.visits.append(Visit(self._clock.now(), lasts))
        return None

    def _drop(self) -> str | None:
        for box in self._world.suction.held_boxes:
            self._world.suction.detach(box, self._world.now)
            self.fell[box] = self._world.now
        self._world.wake()
        return None

    def _meet(self) -> str | None:
        self._torque = True
        return TORQUE

    def _stop(self) -> str | None:
        self._safety.stopped = True
        return None


def _leave() -> str | None:
    return PATH
