"""The planning desk: plans motions from what the cell believes, ahead of the arm where it can."""

import asyncio
import math
from collections.abc import Callable, Sequence
from typing import TypeVar

import numpy as np

from depal.cell.planning.placing import as_pushed_in, turn_into
from depal.cell.planning.plans import CarryPlan, Load, PickPlan, ShowPlan
from depal.cell.planning.showing import shown_poses
from depal.cell.planning.surroundings import Surroundings, target_of
from depal.cell.planning.timing import Timing, rebased
from depal.cell.timekeeping import PLANNING, Timekeeper
from depal.cell.workplace import Workplace
from depal.domain import (
    Approach,
    BoxId,
    Grasp,
    Joints,
    Perceived,
    PlaceId,
    Recognition,
    StorageKind,
)
from depal.geometry import OrientedBox
from depal.logistics.placing import MARGINS, Books, Spot, find_spots
from depal.motion.collision.values import Array
from depal.motion.grasping import Holding, grasps
from depal.motion.moves import OPEN, Berth, Kind, Mover, NoMotion, Part, Pick
from depal.motion.planning.free import Effort
from depal.ports import Trajectory

T = TypeVar("T")

HEAVIEST = 600.0
"""An unknown box is not expected to be denser than this [kg/m^3]."""

SAME_SIZE = 0.02
"""A detected box may be a product whose edges differ by less than this [m]."""

MOVED = 0.008
"""A plan is good for a box that is seen this far from where it was planned for [m]."""

HERE = 0.01
"""A plan is good for an arm that stands this near to where it begins [rad]."""

AWAY = math.radians(40)
"""The view of the pallet is clear when the flange's heading is this far from the pallet's."""

ASIDE = PlaceId("aside")
"""What task files call the storage that boxes are set aside into."""

SPOTS = 4
"""So many spots of one place are tried."""


class Desk:
    """Plans for one cell.

    Attributes:
        books: what stands where, planned placements included.
        planned: how many motions were planned so far; each is charged unless the arm moves.
        spent: how long each took to compute [s of wall time], for reports.
    """

    def __init__(
        self,
        work: Workplace,
        times: Timekeeper,
        *,
        cone: bool = True,
        seed: int = 0,
        stopwatch: Callable[[], float] | None = None,
    ) -> None:
        """A desk with nothing on it.

        Args:
            work: what the cell believes.
            times: told when planning is charged.
            cone: whether motions respect the suction's limits.
            seed: of the planner's samples.
            stopwatch: real time for reports [s]; nothing is decided by it.
        """
        self._work = work
        self._times = times
        self._mover = Mover(work.layout)
        self._timing = Timing(work.layout, work.settings.speed, cone)
        self._around = Surroundings(work.layout)
        self._seed = seed
        self._stopwatch = stopwatch or (lambda: 0.0)
        self._picks: dict[BoxId, PickPlan] = {}
        self._carries: dict[BoxId, CarryPlan] = {}
        self._searching: dict[BoxId, asyncio.Event] = {}
        self._reached: set[BoxId] = set()
        self._lists: dict[BoxId, tuple[PlaceId, ...]] = {}
        self._next_start: Joints | None = None
        self.books = Books.empty(work.layout.places.values())
        self.planned = 0
        self.spent: list[float] = []

    async def charge(self, motions: int) -> None:
        """Lets the simulated time of planning pass; motions go on meanwhile."""
        if motions:
            with self._times.during(PLANNING):
                await asyncio.sleep(motions * self._work.settings.charges.plan)

    # Picking

    def try_pick(
        self,
        box: Perceived,
        without: frozenset[Approach] = frozenset(),
        first: Grasp | None = None,
    ) -> PickPlan | str:
        """A pick of a box from where the arm will be next, or why there is none.

        Args:
            box: which.
            without: ways to hold it that are of no use.
            first: the way to hold it that is tried before all others.
        """
        start = np.array(self._next_start or self._work.ports.arm.joints())
        mass = self.mass_of(box)
        tool, front = self._work.layout.tool, self._front()
        ways = [g for g in grasps(box.shape, mass, tool, front) if g.approach not in without]
        if first is not None:
            ways = [first, *(grasp for grasp in ways if grasp != first)]
        scene = self._around.scene(self._work.pile)
        found = self._measured(
            lambda: self._mover.pick(start, box.shape, ways, scene, str(box.id), self._effort())
        )
        if isinstance(found, NoMotion):
            return str(found)
        return self._timed_pick(box, mass, found)

    def _timed_pick(self, box: Perceived, mass: float, pick: Pick) -> PickPlan | str:
        scene = self._around.scene(self._work.pile)
        empty = self._mover.checker(scene, OPEN, folded=pick.grasp.folded)
        holding = Holding.of(pick.grasp, mass, self._work.layout.tool, size=box.shape.size)
        approach = self._timing.along(pick.approach, checker=empty)
        lift = self._timing.slowly(pick.lift, holding)
        if approach is None or lift is None:
            return "the suction would not hold it"
        return PickPlan(box, mass, pick, approach, lift)

    def keep_pick(self, plan: PickPlan) -> None:
        """This is how the box will be taken."""
        self._picks[plan.box.id] = plan

    def forget_pick(self, box: BoxId) -> None:
        """The box is to be planned for anew."""
        self._picks.pop(box, None)
        self._reached.discard(box)
        self._release_spot(box)

    async def pick(self, box: BoxId) -> PickPlan | str:
        """The pick of a box from where the arm stands; planned anew where the kept one is off.

        Where a place is being searched for the box, this waits: the way to hold it may change.
        """
        await asyncio.sleep(0)
        if box in self._searching:
            await self._searching[box].wait()
        self._reached.add(box)
        seen = self._work.pile.get(box)
        if seen is None:
            return f"box {box} is not seen on the pallet"
        kept = self._picks.get(box)
        if kept is not None and self._is_good(kept, seen):
            return kept
        before = self.planned
        self._next_start = None
        plan = self.try_pick(seen, first=None if kept is None else kept.grasp)
        await self.charge(self.planned - before)
        if not isinstance(plan, str):
            if kept is not None and plan.grasp != kept.grasp:
                self._release_spot(box)
            self._picks[box] = plan
        return plan

    def _is_good(self, plan: PickPlan, seen: Perceived) -> bool:
        moved = math.dist(plan.box.shape.centre, seen.shape.centre)
        return moved < MOVED and _near(self._work.ports.arm.joints(), plan.approach.start)

    def pick_in_hand(self, box: BoxId) -> PickPlan:
        """The pick that brought the arm to the box."""
        return self._picks[box]

    def draw_back(self, plan: PickPlan) -> Trajectory | None:
        """Back along the straight approach, with an empty hand."""
        back = plan.pick.approach[-1].path[::-1]
        here = np.array(self._work.ports.arm.joints())
        part = Part(Kind.STRAIGHT, rebased(back.copy(), here))
        return self._timing.along([part])

    async def pick_from(self, box: BoxId, place: PlaceId) -> PickPlan | str:
        """The pick of a box that stands in a place."""
        work = self._work
        solid = self._around.where(box)
        if solid is None or self.books.where(box) != place:
            return f"box {box} does not stand in {place}"
        inward = np.array(work.layout.places[place].cell_from_place.rotation)[:, 0]
        front = (float(-inward[0]), float(-inward[1]), 0.0)
        gtin = work.product_of(box)
        mass = gtin.mass if gtin else HEAVIEST * math.prod(solid.size)
        scene = self._around.scene(work.pile)
        start = np.array(work.ports.arm.joints())
        ways = grasps(solid, mass, work.layout.tool, front)
        found = self._measured(
            lambda: self._mover.pick(start, solid, ways, scene, str(box), self._effort())
        )
        await self.charge(1)
        if isinstance(found, NoMotion):
            return str(found)
        seen = Recognition(box, solid, gtin.gtin) if gtin else None
        if seen is None:
            return f"nobody knows the product of box {box}"
        plan = self._timed_pick(seen, mass, found)
        if not isinstance(plan, str):
            self._picks[box] = plan
        return plan

    # Holding

    def load_of(self, box: BoxId) -> Load | None:
        """The box as the next motion will find it: in the hand now, or after its pick."""
        held, plan = self._work.held, self._picks.get(box)
        if held is not None and held.box == box:
            here = np.array(self._work.ports.arm.joints())
            fresh = plan is not None and _near(here, plan.pick.lift.path[-1])
            if fresh and plan is not None:
                out = plan.pick.out
                return Load(box, held.grasp, held.size, self._felt(box), (out,), out.path[-1])
            return Load(box, held.grasp, held.size, self._felt(box), (), here)
        if plan is None:
            return None
        out = plan.pick.out
        return Load(box, plan.grasp, plan.box.shape.size, plan.mass, (out,), out.path[-1])

    def _felt(self, box: BoxId) -> float:
        """What a held box weighs: what its product should, or what the arm feels."""
        product, held = self._work.product_of(box), self._work.held
        felt = held.mass if held is not None else 0.0
        return max(felt, product.mass if product else 0.0)

    # Placing

    async def find_place(self, box: BoxId, places: Sequence[PlaceId]) -> CarryPlan | str:
        """The first place in a list into which a box can be put, with the motion there."""
        load = self.load_of(box)
        if load is None:
            return f"box {box} is neither held nor about to be"
        self._lists.setdefault(box, tuple(places))
        before, searching = self.planned, self._searching.setdefault(box, asyncio.Event())
        try:
            plan = self._first_place(load, places)
            if isinstance(plan, str) and box not in self._reached and box in self._picks:
                plan = self._by_another_grasp(box, places) or plan
            if not isinstance(plan, str):
                self._keep_carry(plan)
            await self.charge(self.planned - before)
        finally:  # broken off or not: nobody waits for it any more
            searching.set()
            self._searching.pop(box, None)
        return plan

    def _by_another_grasp(self, box: BoxId, places: Sequence[PlaceId]) -> CarryPlan | None:
        """Held the other way it may fit."""
        kept = self._picks[box]
        seen = self._work.pile.get(box)
        if seen is None:
            return None
        other = self.try_pick(seen, frozenset({kept.grasp.approach}))
        if isinstance(other, str):
            return None
        self._picks[box] = other
        load = self.load_of(box)
        plan = self._first_place(load, places) if load is not None else ""
        if isinstance(plan, str):
            self._picks[box] = kept
            return None
        return plan

    def _first_place(self, load: Load, places: Sequence[PlaceId]) -> CarryPlan | str:
        reasons: list[str] = []
        for place in places:
            bay = place.split("/", maxsplit=1)[0]
            if self._work.ports.bays.trolley(bay) is None and not self._is_fixed(place):
                reasons.append(f"no trolley in {bay}")
                continue
            plan = self._into(load, place)
            if not isinstance(plan, str):
                return plan
            reasons.append(f"{place}: {plan}")
        return "; ".join(reasons[:3]) or "the list of places is empty"

    def _into(self, load: Load, place: PlaceId) -> CarryPlan | str:
        """Into one place, at the first of its spots that the arm reaches."""
        layout = self._work.layout
        turn = turn_into(load)
        held = as_pushed_in(load, turn, layout.tool)
        cell_from_place = layout.places[place].cell_from_place
        scene = self._around.scene(self._work.pile, without=load.box)
        reason = "no room"

        def berth_at(spot: Spot) -> Berth:
            target = target_of(cell_from_place, spot, turn)
            return Berth(load.grasp, load.size, cell_from_place, target, MARGINS.lift)

        spots = find_spots(
            self.books.at(place),
            held,
            limit=SPOTS,
            reachable=lambda spot: not self._mover.why_no_put(load.start, berth_at(spot), scene),
        )
        for spot in spots:
            berth = berth_at(spot)
            put = self._measured(
                lambda berth=berth: self._mover.put(
                    load.lead, load.start, berth, scene, self._effort()
                )
            )
            if isinstance(put, NoMotion):
                reason = str(put)
                continue
            holding = Holding.of(load.grasp, load.mass, layout.tool, size=load.size)
            clear = self._mover.checker(scene, OPEN, load.grasp, load.size)
            motion = self._timing.along(put.carry, holding, clear)
            descent = self._timing.slowly(put.descent, holding)
            if motion is None or descent is None:
                reason = "the suction would not hold it"
                continue
            return CarryPlan(load, place, spot, berth.target, motion, descent, put.retreat.path)
        return reason

    def _is_fixed(self, place: PlaceId) -> bool:
        return self._work.layout.storage(place).kind is StorageKind.SHELF

    def _keep_carry(self, plan: CarryPlan) -> None:
        """The place is promised: nobody else gets it, and the next motion begins there."""
        box = plan.load.box
        self._release_spot(box)
        self._carries[box] = plan
        self.books = self.books.put(plan.place, plan.spot.standing(box, plan.load.mass))
        self._around.put(box, plan.place, OrientedBox(plan.target, plan.load.size))
        held = self._work.held
        if held is None or held.box == box:
            self._next_start = plan.end

    def _release_spot(self, box: BoxId) -> None:
        if self._carries.pop(box, None) is not None:
            self.books = self.books.take(box)
            self._around.take(box)

    async def carry(self, box: BoxId, place: PlaceId) -> CarryPlan | str:
        """The motion of the held box into a place, from where it is."""
        kept = self._carries.get(box)
        here = self._work.ports.arm.joints()
        if kept is not None and kept.place == place and _near(here, kept.motion.start):
            self._next_start = kept.end
            return kept
        self._release_spot(box)
        there = self._places_named(place)
        elsewhere = () if place == ASIDE else tuple(self._lists.get(box, ()))
        return await self.find_place(box, (*there, *(p for p in elsewhere if p not in there)))

    def _places_named(self, place: PlaceId) -> tuple[PlaceId, ...]:
        """The place itself, or all of the storage that boxes are set aside into."""
        if place != ASIDE:
            return (place,)
        storage = self._work.layout.storage(self._work.layout.aside)
        return tuple(each.id for each in storage.places)

    def carry_in_hand(self, box: BoxId) -> CarryPlan:
        """The plan that brought the held box into its place."""
        return self._carries[box]

    def forget_carry(self, box: BoxId) -> None:
        """The box did not get to its place."""
        self._release_spot(box)
        self._next_start = None

    def confirm(self, plan: CarryPlan) -> None:
        """The box stands where it was planned."""
        self._carries.pop(plan.load.box, None)
        self._picks.pop(plan.load.box, None)

    def retreat(self, plan: CarryPlan) -> Trajectory | None:
        """Straight out of the place from where the arm has come to rest."""
        here = np.array(self._work.ports.arm.joints())
        return self._timing.along([Part(Kind.STRAIGHT, rebased(plan.retreat, here))])

    def exchanged(self, trolley: str) -> None:
        """An empty trolley stands in the bay."""
        self.books, gone = self.books.exchanged(trolley)
        self._around.empty(place_map.place.id for place_map in gone)

    # Showing

    async def show(self, box: BoxId) -> ShowPlan | str:
        """The motions of a held box to the reader, one for each side that can be shown."""
        load = self.load_of(box)
        if load is None:
            return f"box {box} is not held"
        before = self.planned
        plan = self._sides(load)
        await self.charge(min(self.planned - before, 1))
        return plan

    def _sides(self, load: Load) -> ShowPlan | str:
        scene = self._around.scene(self._work.pile, without=load.box)
        holding = Holding.of(load.grasp, load.mass, self._work.layout.tool, size=load.size)
        clear = self._mover.checker(scene, OPEN, load.grasp, load.size)
        found: list[Trajectory] = []
        reason = "no side can be shown"
        lead, start = load.lead, load.start
        for _, pose in shown_poses(load, self._work.layout.reader):
            shown = self._measured(
                lambda lead=lead, start=start, pose=pose: self._mover.show(
                    lead, start, load.grasp, load.size, [pose], scene, self._effort()
                )
            )
            if isinstance(shown, NoMotion):
                reason = str(shown)
                continue
            parts, _ = shown
            trajectory = self._timing.along(parts, holding, clear)
            if trajectory is None:
                continue
            found.append(trajectory)
            lead, start = (), parts[-1].path[-1]
        return ShowPlan(found[0], tuple(found[1:])) if found else reason

    # Beside the motions

    def clear_view_later(self, box: BoxId, trajectory: Trajectory) -> None:
        """The box counts as gone once the arm is out of the view of the pallet."""
        gone = self._work.gone(box)
        if not gone.is_set():
            delay = self._clear_at(trajectory)
            asyncio.get_running_loop().call_later(delay, gone.set)

    def _clear_at(self, trajectory: Trajectory) -> float:
        x, y, _ = self._middle()
        pallet = math.atan2(y, x)
        for time, q in zip(trajectory.times, trajectory.positions, strict=True):
            p = self._mover.body.kinematics.flange(q).translation
            turn = math.atan2(p[1], p[0]) - pallet
            if abs(math.atan2(math.sin(turn), math.cos(turn))) > AWAY:
                return float(time)
        return trajectory.duration

    def mass_of(self, box: Perceived) -> float:
        """What a box should weigh: its product, or the heaviest of the note of its size [kg]."""
        products = self._work.delivery.products
        if isinstance(box, Recognition) and box.gtin in products:
            return products[box.gtin].mass
        size = sorted(box.shape.size)
        fitting = [
            product.mass
            for product in products.values()
            if max(abs(a - b) for a, b in zip(sorted(product.size), size, strict=True)) < SAME_SIZE
        ]
        return max(fitting, default=HEAVIEST * math.prod(size))

    def _front(self) -> tuple[float, float, float]:
        """Towards the robot from the pallet: the pallet's side that faces it."""
        rotation = np.array(self._work.layout.pallet.cell_from_pallet.rotation)
        x, y, _ = self._middle()
        away = np.array([x, y, 0.0])
        axis = max((rotation[:, 0], rotation[:, 1]), key=lambda side: abs(float(side @ away)))
        toward = -axis * math.copysign(1.0, float(axis @ away))
        return (float(toward[0]), float(toward[1]), 0.0)

    def _middle(self) -> tuple[float, float, float]:
        stand = self._work.layout.pallet
        length, width, _ = stand.size
        return stand.cell_from_pallet.apply((length / 2, width / 2, 0.0))

    def _effort(self) -> Effort:
        return Effort(seed=self._seed + self.planned)

    def _measured(self, plan: Callable[[], T]) -> T:
        self.planned += 1
        began = self._stopwatch()
        found = plan()
        self.spent.append(self._stopwatch() - began)
        return found


def _near(a: Joints | Array, b: Joints | Array) -> bool:
    return bool(np.abs(np.array(a) - np.array(b)).max() < HERE)
