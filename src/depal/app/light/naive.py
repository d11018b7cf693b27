"""A control: a controller that after a restart runs again whatever was begun and has no end.

At least once, as a queue of jobs would do it. It believes its journal and reads no sensor; nobody
works so. It shows that the referee can see what exactly one placement prevents.
"""

from collections.abc import Mapping
from dataclasses import replace

from depal.app.run.assembly import Assembly
from depal.cell.ledger import Page
from depal.cell.planning.loads import expected_mass
from depal.cell.workplace import Held
from depal.domain import BoxId, Joints
from depal.ports import Arm, Guard, Trajectory

TAKEN = ".taken"


class BlindArm:
    """An arm that follows to the end, whatever the vacuum says."""

    def __init__(self, arm: Arm) -> None:
        """In front of this one."""
        self._arm = arm

    def joints(self) -> Joints:
        """Where the axes are."""
        return self._arm.joints()

    def load(self) -> float:
        """What hangs on the flange [kg]."""
        return self._arm.load()

    async def follow(self, trajectory: Trajectory, guard: Guard | None = None) -> str | None:
        """Moves; nobody watches."""
        del guard
        return await self._arm.follow(trajectory)


def believed(page: Page, facts: Mapping[str, object]) -> Page:
    """What of a page the journal confirms: a step without an end was not done."""
    return replace(
        page,
        hand=None,
        departures=tuple(d for d in page.departures if facts.get(f"{d.box}.stored")),
        kept=tuple(kept for kept in page.kept if facts.get(f"{kept.standing.id}.stored")),
    )


class NaiveRecovery:
    """Goes on where the journal says that it was."""

    def __init__(self, wired: Assembly) -> None:
        """Before the probes of the restart: what they would tell is not heard."""
        self._wired = wired
        facts = wired.controller.runtime.engine.state.facts
        self._facts = [(key, facts.get(key)) for key in facts if key.endswith(TAKEN)]

    async def go_on(self) -> None:
        """The facts are what the journal says, and everything is run again."""
        work, desk = self._wired.work, self._wired.desk
        for motion in desk.clearing.ways_out():
            await work.ports.arm.follow(motion)
        work.pile.see(await work.ports.sight.look())
        work.tell([*self._facts, ("kr60.at", None)], "journal")
        for key, value in self._facts:
            box = BoxId(key.removesuffix(TAKEN))
            if value:
                self._hold(box)
        work.runtime.start("journal")

    def _hold(self, box: BoxId) -> None:
        """The journal says that it hangs there."""
        work = self._wired.work
        seen, product = work.pile.get(box), work.product_of(box)
        size = seen.shape.size if seen is not None else product.size if product else None
        if size is None:
            return
        mass = product.mass if product else expected_mass(seen, work.delivery) if seen else 1.0
        grasp = self._wired.desk.picking.offered(seen)[0] if seen is not None else None
        if grasp is not None:
            work.held = Held(box, grasp, size, mass)
