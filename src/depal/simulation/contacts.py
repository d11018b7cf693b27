"""Collisions: what touches the arm, the tool or a held box, when, and how hard."""

from dataclasses import dataclass

import mujoco
import numpy as np
import numpy.typing as npt

from depal.simulation.model import CellModel

FORCE_LIMIT = 50.0
"""A held box may press on something, beyond its own weight, with this [N]."""

SAME_CONTACT = 0.2
"""Contacts of one pair closer together in time than this are one collision [s]."""

SMOOTHING = 0.5
"""Share of a new step in the force of a pair."""

STILL, BOX, ARM, TOOL = range(4)


@dataclass(frozen=True, slots=True)
class Collision:
    """A contact that should not have been.

    Attributes:
        at: when it began [s].
        who: the part of the arm, "tool", or the held box, as in "box 3".
        against: what it touched.
        force: the greatest normal force of the contact [N].
        held: whether it was the held box that touched.
        allowed: whether the held box was in a straight part, and pressed too hard.
    """

    at: float
    who: str
    against: str
    force: float
    held: bool
    allowed: bool


@dataclass(slots=True)
class _Pair:
    force: float = 0.0
    tick: int = -1


class ContactWatch:
    """Looks at the contacts of every step."""

    def __init__(self, model: CellModel, data: mujoco.MjData) -> None:
        """Nothing was touched yet."""
        self.model, self.data = model, data
        self.collisions: list[Collision] = []
        self.greatest = 0.0
        self.touched = -np.inf
        self._last: dict[tuple[str, str], float] = {}
        self._pairs: dict[tuple[int, int], _Pair] = {}
        self._force = np.zeros(6)
        mj = model.mj
        self._names = [_name(mj, geom) for geom in range(mj.ngeom)]
        self._kinds = np.full(mj.ngeom, STILL)
        self._kinds[model.box_geoms] = BOX
        bodies = [*model.arm_bodies.tolist(), mj.body("base").id]
        self._kinds[np.isin(mj.geom_bodyid, bodies)] = ARM
        self._kinds[mj.geom_bodyid == model.tool_body] = TOOL
        self._watched = self._kinds >= ARM
        self._held: tuple[int, ...] = ()

    def after_step(self, tick: int, now: float, held: tuple[int, ...], *, free: bool) -> None:
        """Looks at the contacts of the step that has just been made.

        Args:
            tick: number of the step.
            now: the time [s].
            held: boxes in the hand.
            free: whether the arm moves where a held box may not touch anything.
        """
        if held != self._held:
            self._watched = self._kinds >= ARM
            self._watched[self.model.box_geoms[list(held)]] = True
            self._held = held
        if not self.data.ncon:
            return
        geoms = self.data.contact.geom
        found = np.flatnonzero(self._watched[geoms].any(axis=1))
        if len(found):
            for (a, b), force, support in self._forces(found, geoms[found]):
                self._judge(tick, now, a, b, force, support=support, free=free)

    def _forces(
        self, found: npt.NDArray[np.int64], geoms: npt.NDArray[np.int32]
    ) -> list[tuple[tuple[int, int], float, bool]]:
        """The normal force of each pair, and whether it holds something up."""
        sums: dict[tuple[int, int], npt.NDArray[np.float64]] = {}
        normals = self.data.contact.frame[found, :3]
        for row, (a, b) in enumerate(geoms.tolist()):
            if self._kinds[a] == self._kinds[b] == BOX and not self._watched[a]:
                a, b = b, a  # noqa: PLW2901 - the held box first
            mujoco.mj_contactForce(self.model.mj, self.data, int(found[row]), self._force)
            push = self._force[0] * np.abs(normals[row])
            sums[a, b] = sums.get((a, b), np.zeros(3)) + push
        return [
            (pair, float(np.linalg.norm(push)), bool(push[2] > max(push[0], push[1])))
            for pair, push in sums.items()
        ]

    def _judge(
        self, tick: int, now: float, a: int, b: int, force: float, *, support: bool, free: bool
    ) -> None:
        pair = self._pairs.setdefault((a, b), _Pair())
        before = pair.force if pair.tick == tick - 1 else 0.0
        pair.force, pair.tick = before + SMOOTHING * (force - before), tick
        if self._kinds[a] >= ARM or self._kinds[b] >= ARM:
            who, against = (a, b) if self._kinds[a] >= self._kinds[b] else (b, a)
            self._count(now, who, against, pair.force, allowed=False)
            return
        who, against = (a, b) if self._watched[a] else (b, a)
        weight = 9.81 * float(self.model.mj.body_mass[self.model.mj.geom_bodyid[who]])
        beyond = pair.force - (weight if support else 0.0)
        self.greatest = max(self.greatest, beyond)
        if free or beyond > FORCE_LIMIT:
            self._count(now, who, against, pair.force, allowed=not free)

    def _count(self, now: float, who: int, against: int, force: float, *, allowed: bool) -> None:
        names = (self._names[who], self._names[against])
        self.touched = now
        held = self._kinds[who] == BOX
        known = self._last.get(names, -np.inf)
        self._last[names] = now
        if now - known > SAME_CONTACT:
            self.collisions.append(Collision(now, *names, force, bool(held), allowed))
            return
        for row in reversed(range(len(self.collisions))):
            last = self.collisions[row]
            if (last.who, last.against) == names:
                if force > last.force:
                    self.collisions[row] = Collision(
                        last.at, *names, force, last.held, last.allowed and allowed
                    )
                return


def _name(model: mujoco.MjModel, geom: int) -> str:
    body = str(model.body(model.geom_bodyid[geom]).name)
    return body if body not in {"world", ""} else str(model.geom(geom).name or "fixture")
