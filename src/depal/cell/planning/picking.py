"""How boxes are taken: off the pallet, or out of a place."""

import asyncio
import math
from collections.abc import Iterator
from collections.abc import Set as AbstractSet
from dataclasses import replace

import numpy as np

from depal.cell.breadth import as_broad_as_it_may_be, astray, named_astray
from depal.cell.identity import beyond_seen, strange_height
from depal.cell.laden import raised
from depal.cell.planning.facing import pallet_front
from depal.cell.planning.loads import expected_mass, expected_masses, heaviest
from depal.cell.planning.planner import Planner
from depal.cell.planning.plans import PickPlan
from depal.cell.planning.promises import Promises
from depal.cell.planning.timing import rebased, stands_at
from depal.cell.planning.wary import with_room
from depal.cell.rules import TAKING, Rules, rules_on
from depal.cell.workplace import Workplace
from depal.domain import Approach, BoxId, Detection, Grasp, Perceived, PlaceId, Recognition
from depal.geometry import OrientedBox, Vector3
from depal.motion.collision import Scene
from depal.motion.grasping import EXACT, Holding, grasps, in_a_row
from depal.motion.moves import OPEN, Doubts, NoMotion, Part, Pick
from depal.motion.planning.straight import straight
from depal.ports import Trajectory

ROOM = 0.03
"""With a sight that errs a box is taken straight on until so much around it is clear [m]."""

BESIDE = 0.5
"""Boxes whose middles are no farther from that of another may be under a tool that takes it [m]."""

FEELING = 0.25
"""So fast the flange comes down where something may be higher than it looks [m/s]."""

SHORT = 0.018
"""So far before its plane of touch the tool stops at a front that no print has named [m]."""

RUBBING = 0.21
"""No faster a box that hangs on one row of cups is taken out of a pile whose boxes may not be where
they seem: what rubs against it across the row peels it off [m/s]."""

MOVED = 0.008
"""A plan is good for a box that is seen this far from where it was planned for [m]."""

Alike = tuple[Vector3, float, int, bool, frozenset[str]]
"""Boxes of one size and mass, turned alike, that are held by the same modules."""


class Picking:
    """Plans picks; a kept one is planned anew where it does not fit any more."""

    def __init__(self, work: Workplace, planner: Planner, promises: Promises) -> None:
        """Picks from the pile and the places, as the cell believes them."""
        self._work = work
        self._planner = planner
        self._promises = promises
        self._offered: dict[Alike, tuple[Grasp, ...]] = {}

    def try_pick(
        self,
        box: Perceived,
        first: Grasp | None = None,
        *,
        only: bool = False,
    ) -> PickPlan | str:
        """A pick of a box from where the arm will be next, or why there is none.

        The tool keeps clear of all that boxes without a name may be.

        Args:
            box: which.
            first: the way to hold it that is tried before all others.
            only: no other way is tried.
        """
        work = self._work
        start = np.array(self._promises.next_start or work.ports.arm.joints())
        mass = expected_mass(box, work.delivery)
        ways = [first] if first is not None else []
        if not only:
            ways += [grasp for grasp in self.ways(box) if grasp != first]
        rules = rules_on(work.engine, box.id, TAKING)
        scene = self._promises.scene(work.pile, zones=rules.zones)
        wary = self._wary(box, rules.zones)
        stands = self._planner.why_no_start(start, scene) if rules.zones else ""
        if stands:
            return stands
        reason, name = "", str(box.id)
        for doubts in self._doubts(box, wary, rules.zones):
            found = self._planner.pick(start, box.shape, ways, scene, name, doubts, rules.tilt)
            if not isinstance(found, NoMotion):
                beyond = EXACT if doubts.beyond == EXACT else self._beyond(box)
                return self._timed(box, mass, found, scene, rules, beyond)
            reason = str(found)
        return rules.after(reason)

    def _doubts(
        self, box: Perceived, wary: Scene | None, zones: AbstractSet[str]
    ) -> Iterator[Doubts]:
        """How much room a box is taken out with: less where no way out has as much."""
        roomy = with_room(box.id, zones, self._work, self._promises)
        if roomy is not None:
            yield Doubts(self._wide(box), wary, roomy)
        for room in dict.fromkeys((self._wide(box), self._beyond(box), EXACT)):
            yield Doubts(room, wary)

    def _wary(self, box: Perceived, zones: AbstractSet[str]) -> Scene | None:
        """What the tool keeps clear of on its way to a box; None where that is what is seen."""
        pile, delivery = self._work.pile, self._work.delivery
        if not pile.remembered or all(isinstance(other, Recognition) for other in pile.boxes):
            return None

        strange = pile.strange

        def shape_of(other: Perceived) -> OrientedBox:
            if other.id == box.id or isinstance(other, Recognition):
                return other.shape
            unsized = other.id in pile.unsized
            room = as_broad_as_it_may_be(other, delivery, unsized=unsized)
            return raised(room, other.shape, strange)

        return self._promises.scene(pile, zones=zones, shape_of=shape_of)

    def _beyond(self, box: Perceived) -> Vector3:
        """How much longer a box may be than it looks.

        A sight that is exact tells, and mostly a name.
        """
        work = self._work
        if not work.pile.remembered:
            return EXACT
        if isinstance(box, Recognition):
            pallet, tried = work.layout.pallet.cell_from_pallet, bool(work.tries.get(box.id))
            return named_astray(box.shape, pallet, tried=tried)
        unsized = box.id in work.pile.unsized
        return astray(beyond_seen(work.delivery, box.shape.size), unsized=unsized)

    def _wide(self, box: Perceived) -> Vector3:
        """The same and the room around it that a box is taken straight out of.

        What stands close by may reach farther than it looks; a box without a name may be of a
        product that is not on the note, and higher than those of its size.
        """
        a, b, c = self._beyond(box)
        work = self._work
        if not work.pile.remembered:
            return a, b, c
        if not isinstance(box, Recognition):
            c = max(c, strange_height(work.delivery, box.shape.size[2]))
        return a + ROOM, b + ROOM, c

    def ways(self, box: Perceived) -> tuple[Grasp, ...]:
        """Every way to hold a box on the pallet, best first."""
        failed = self._work.doubted.get(box.id, frozenset())
        return tuple(sorted(self.offered(box), key=lambda grasp: grasp.approach in failed))

    def offered(self, box: Perceived) -> tuple[Grasp, ...]:
        """The ways to hold a box, whatever has failed; worked out once for boxes that are alike."""
        work = self._work
        front = pallet_front(work.layout.pallet)
        mass = expected_mass(box, work.delivery)
        toward = np.array(box.shape.pose.rotation).T @ np.array(front)
        axis = int(np.argmax(np.abs(toward[:2])))
        dead = self._silent(box.id)
        key = (box.shape.size, mass, axis, bool(toward[axis] > 0), dead)
        if key not in self._offered:
            ways = grasps(box.shape, mass, work.layout.tool, front)
            if dead:  # they come last: where nothing else reaches, they are tried again
                live = grasps(box.shape, mass, work.layout.tool, front, dead)
                ways = tuple(dict.fromkeys((*live, *ways)))
            self._offered[key] = ways
        return self._offered[key]

    def _silent(self, box: BoxId) -> frozenset[str]:
        """The modules that do not work, or do not on this box."""
        work = self._work
        return work.modules.dead | work.modules.suspects(box, work.tries.get(box, 0))

    def masses(self, box: Perceived) -> tuple[float | None, float | None]:
        """The least and the most that a box can weigh, by the note [kg]."""
        return expected_masses(box, self._work.delivery)

    def _timed(
        self,
        box: Perceived,
        mass: float,
        pick: Pick,
        scene: Scene,
        rules: Rules,
        beyond: Vector3 = EXACT,
    ) -> PickPlan | str:
        planner, work = self._planner, self._work
        if work.pile.remembered and in_a_row(pick.grasp, work.layout.tool):
            pick = replace(pick, out=replace(pick.out, most=RUBBING))
        empty = planner.mover.checker(scene, OPEN, folded=pick.grasp.folded)
        holding = Holding.of(pick.grasp, mass, work.layout.tool, size=box.shape.size)
        feeling = self._feels(box, pick.grasp)
        *free, down = pick.approach
        before = self._before(down) if self._may_be_nearer(box, pick.grasp) else None
        felt = planner.timing.along([replace(down, most=FEELING)]) if feeling else None
        last = [] if feeling else [down if before is None else before]
        approach = planner.timing.along([*free, *last], checker=empty)
        lift = planner.timing.slowly(pick.lift, holding)
        if approach is None or lift is None or (feeling and felt is None):
            return "the suction would not hold it"
        short = 0.0 if before is None else SHORT
        return PickPlan(box, mass, pick, approach, lift, beyond, rules, felt, short)

    def _may_be_nearer(self, box: Perceived, grasp: Grasp) -> bool:
        """Whether a front may stand before where it looks; nothing at the flange feels that."""
        horizontal = grasp.approach is Approach.HORIZONTAL
        return horizontal and self._work.pile.remembered and isinstance(box, Detection)

    def _before(self, down: Part) -> Part | None:
        """The last part of an approach, less the end that is felt for; None where it is short."""
        kinematics = self._planner.mover.body.kinematics
        begin, end = (kinematics.flange(row).translation for row in (down.path[0], down.path[-1]))
        length = math.dist(begin, end)
        if length <= SHORT:
            return None
        x, y, z = ((1.0 - SHORT / length) * np.subtract(end, begin)).tolist()
        path = straight(kinematics, down.path[0], (x, y, z))
        return None if path is None else replace(down, path=path)

    def _feels(self, box: Perceived, grasp: Grasp) -> bool:
        """Whether something below the tool may be higher than it looks: no print has named it."""
        pile = self._work.pile
        return (
            pile.remembered
            and grasp.approach is Approach.VERTICAL
            and any(
                isinstance(other, Detection)
                and math.dist(other.shape.centre[:2], box.shape.centre[:2]) < BESIDE
                for other in pile.boxes
            )
        )

    async def pick(self, box: BoxId) -> PickPlan | str:
        """The pick of a box from where the arm stands; planned anew where the kept one is off.

        Where a place is being searched for the box, this waits: the way to hold it may change.
        """
        await asyncio.sleep(0)
        promises, planner = self._promises, self._planner
        await promises.searched(box)
        promises.reach(box)
        seen = self._work.pile.get(box)
        if seen is None:
            return f"box {box} is not seen on the pallet"
        kept = promises.pick_of(box)
        if kept is not None and not self._silent(box).isdisjoint(m for m, _ in kept.grasp.cups):
            promises.forget_pick(box)
            kept = None
        if kept is not None and self._is_good(kept, seen):
            return kept
        before = planner.planned
        promises.next_start = None
        first = None if kept is None else kept.grasp
        plan = self.try_pick(seen, first)
        await planner.charge(planner.planned - before)
        if not isinstance(plan, str):
            if kept is not None and plan.grasp != kept.grasp:
                promises.release(box)
            promises.keep_pick(plan)
        return plan

    def _is_good(self, plan: PickPlan, seen: Perceived) -> bool:
        moved = math.dist(plan.box.shape.centre, seen.shape.centre)
        kept = plan.rules.cover(rules_on(self._work.engine, seen.id, TAKING))
        return kept and moved < MOVED and stands_at(self._planner.here, plan.approach.start)

    async def pick_from(self, box: BoxId, place: PlaceId) -> PickPlan | str:
        """The pick of a box that stands in a place."""
        work, planner = self._work, self._planner
        solid = self._promises.standing(box, place)
        if solid is None:
            return f"box {box} does not stand in {place}"
        inward = np.array(work.layout.places[place].cell_from_place.rotation)[:, 0]
        front = (float(-inward[0]), float(-inward[1]), 0.0)
        product = work.product_of(box)
        mass = product.mass if product else heaviest(solid.size)
        rules = rules_on(work.engine, box, TAKING)
        scene = self._promises.scene(work.pile, zones=rules.zones)
        ways = grasps(solid, mass, work.layout.tool, front)
        found = planner.pick(planner.here, solid, ways, scene, str(box), tilt=rules.tilt)
        await planner.charge(1)
        if isinstance(found, NoMotion):
            return rules.after(str(found))
        if product is None:
            return f"nobody knows the product of box {box}"
        plan = self._timed(Recognition(box, solid, product.gtin), mass, found, scene, rules)
        if not isinstance(plan, str):
            self._promises.keep_pick(plan)
        return plan

    def park(self) -> Trajectory | None:
        """To where the arm stands idle, with an empty hand."""
        planner, folded = self._planner, self._work.ports.gripper.folded()
        scene = self._promises.scene(self._work.pile, zones=self._work.bounds.zones)
        part = planner.park(scene, folded=folded)
        if isinstance(part, NoMotion):
            return None
        self._promises.next_start = None
        empty = planner.mover.checker(scene, OPEN, folded=folded)
        return planner.timing.along([part], checker=empty)

    def way_back(self, plan: PickPlan) -> Iterator[Trajectory]:
        """Back along the whole approach, with an empty hand: first straight off the box."""
        for part in reversed(plan.pick.approach):
            back = rebased(part.path[::-1].copy(), self._planner.here)
            trajectory = self._planner.timing.along([Part(part.kind, back)])
            if trajectory is None:
                return
            yield trajectory
