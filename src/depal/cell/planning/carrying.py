"""How a held box gets into a place, and which place that is."""

from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np

from depal.cell.planning.compartments import Compartments
from depal.cell.planning.loads import load_of
from depal.cell.planning.picking import Picking
from depal.cell.planning.placing import as_pushed_in, turn_into
from depal.cell.planning.planner import Planner
from depal.cell.planning.plans import CarryPlan, Load
from depal.cell.planning.promises import Promises
from depal.cell.planning.surroundings import target_of
from depal.cell.planning.timing import rebased, stands_at, straight_to_end
from depal.cell.planning.trolleys import Trolleys
from depal.cell.planning.wary import scenes_around
from depal.cell.rules import LEAVING, rules_on
from depal.cell.workplace import Workplace
from depal.domain import BoxId, PlaceId, StorageKind
from depal.logistics.placing import MARGINS, Spot, find_spots
from depal.motion.collision import Scene
from depal.motion.moves import Berth, Kind, NoMotion, Part, Put
from depal.ports import Trajectory

ASIDE = PlaceId("aside")
"""What task files call the storage that boxes are set aside into."""

SPOTS = 4
"""So many spots of one place are tried."""


class Carrying:
    """Finds places, promises them, and plans the motions there.

    Attributes:
        compartments: what stands in places that the cell has not put there.
    """

    def __init__(
        self, work: Workplace, planner: Planner, promises: Promises, picking: Picking
    ) -> None:
        """No box has a list of places yet.

        Args:
            work: what the cell believes.
            planner: of the motions.
            promises: the books, and the motions that were found.
            picking: asked for another way to hold a box that fits nowhere.
        """
        self._work = work
        self._planner = planner
        self._promises = promises
        self._picking = picking
        self._lists: dict[BoxId, tuple[PlaceId, ...]] = {}
        self._trolleys = Trolleys(work.ports.bays, work.layout.storages)
        self.compartments = Compartments(work, promises)

    @property
    def blocked(self) -> Mapping[PlaceId, float]:
        """Places with something in them that the cell has not put there, and since when [s]."""
        return self.compartments.blocked

    async def find_place(self, box: BoxId, places: Sequence[PlaceId]) -> CarryPlan | str:
        """The first place in a list into which a box can be put, with the motion there."""
        self._look_at_bays()
        await self.compartments.look_again()
        load = self._load_of(box)
        if load is None:
            return f"box {box} is neither held nor about to be"
        self._lists.setdefault(box, tuple(places))
        before, held = self._planner.planned, self._work.held
        if held is not None and held.box == box:
            self._promises.give_way(box, places)
        with self._promises.searching(box):
            plan = self._first_place(load, places)
            if isinstance(plan, str) and self._promises.may_change(box):
                plan = self._by_another_grasp(box, places) or plan
            if not isinstance(plan, str):
                self._promise(plan)
            await self._planner.charge(self._planner.planned - before)
        return plan

    def _look_at_bays(self) -> None:
        """The books follow what stands there, whoever has brought it."""
        for bay in self._trolleys.exchanged():
            self._promises.replaced(bay)

    def _load_of(self, box: BoxId) -> Load | None:
        load = load_of(box, self._work, self._promises.pick_of(box))
        if load is None:
            return None
        return replace(load.bulky, rules=rules_on(self._work.engine, box, LEAVING))

    def _by_another_grasp(self, box: BoxId, places: Sequence[PlaceId]) -> CarryPlan | None:
        """Held another way it may fit: the first way that has room somewhere."""
        kept, load = self._promises.pick_in_hand(box), self._load_of(box)
        seen = self._work.pile.get(box)
        if seen is None or load is None:
            return None
        for grasp in self._picking.ways(seen):
            fits = grasp != kept.grasp and any(
                self._spots(replace(load, grasp=grasp), place, 1) for place in self._open(places)
            )
            other = self._picking.try_pick(seen, grasp, only=True) if fits else ""
            if isinstance(other, str):
                continue
            self._promises.keep_pick(other)
            held = self._load_of(box)
            plan = self._first_place(held, places) if held is not None else ""
            if not isinstance(plan, str):
                return plan
        self._promises.keep_pick(kept)
        return None

    def _open(self, places: Sequence[PlaceId]) -> list[PlaceId]:
        """The places that are there, and hold nothing that the books do not know."""
        return [place for place in places if self._why_not(place) is None]

    def _why_not(self, place: PlaceId) -> str | None:
        """Why nothing can be put into a place, whatever it is."""
        if place in self.compartments.blocked:
            return "something stands in it that nobody has put there"
        bay = place.split("/", maxsplit=1)[0]
        if self._is_fixed(place) or self._work.ports.bays.trolley(bay) is not None:
            return None
        return "no trolley is in its bay"

    def _first_place(self, load: Load, places: Sequence[PlaceId]) -> CarryPlan | str:
        reasons = [f"{place}: {why}" for place in places if (why := self._why_not(place))]
        for place in self._open(places):
            plan = self._into(load, place)
            if not isinstance(plan, str):
                return plan
            reasons.append(f"{place}: {plan}")
        return "; ".join(reasons[:3]) or "the list of places is empty"

    def _is_fixed(self, place: PlaceId) -> bool:
        return self._work.layout.storage(place).kind is StorageKind.SHELF

    def _into(self, load: Load, place: PlaceId) -> CarryPlan | str:
        """Into one place, at the first of its spots that the arm reaches."""
        planner, reason = self._planner, "no room"
        for spot in self._spots(load, place, SPOTS):
            berth = self._berth(load, place, spot)
            put, scene = self._put(load, berth)
            if isinstance(put, NoMotion):
                reason = str(put)
                continue
            holding, clear = planner.holding(load), planner.checker(load, scene)
            motion = planner.timing.along(put.carry, holding, clear, load.pace)
            descent = planner.timing.slowly(put.descent, holding)
            if motion is None or descent is None:
                reason = "the suction would not hold it"
                continue
            return CarryPlan(load, place, spot, berth.target, motion, descent, put.retreat.path)
        return load.rules.after(reason)

    def _put(self, load: Load, berth: Berth) -> tuple[Put | NoMotion, Scene]:
        """The way there and what it is clear of: all that others may be, where there is such."""
        *wary, near = scenes_around(load, self._work, self._promises)
        for scene in wary:
            put = self._planner.put(load, berth, scene)
            if not isinstance(put, NoMotion):
                return put, scene
        return self._planner.put(load, berth, near), near

    def _spots(self, load: Load, place: PlaceId, limit: int) -> tuple[Spot, ...]:
        """Spots in a place that the arm reaches with the box as it is held, best first."""
        scene = self._scene(load)
        mover = self._planner.mover
        return find_spots(
            self._promises.books.at(place),
            as_pushed_in(load, turn_into(load), self._work.layout.tool),
            limit=limit,
            reachable=lambda spot: (
                not mover.why_no_put(load.start, self._berth(load, place, spot), scene)
            ),
        )

    def _scene(self, load: Load) -> Scene:
        """All around a box in the hand, and what it is kept out of."""
        return self._promises.scene(self._work.pile, load.box, load.rules.zones)

    def _berth(self, load: Load, place: PlaceId, spot: Spot) -> Berth:
        cell_from_place = self._work.layout.places[place].cell_from_place
        target = target_of(cell_from_place, spot, turn_into(load))
        return Berth(load.grasp, load.size, cell_from_place, target, MARGINS.lift, load.short)

    def _promise(self, plan: CarryPlan) -> None:
        """Nobody else gets the place, and the motion after the next begins there."""
        self._promises.keep_carry(plan)
        held = self._work.held
        if held is None or held.box == plan.load.box:
            self._promises.next_start = plan.end

    async def carry(self, box: BoxId, place: PlaceId) -> CarryPlan | str:
        """The motion of the held box into a place, from where it is.

        Somebody has looked into the place: where something stands in it that is not booked, the
        box goes to another one of those that it may go to.
        """
        plan = await self._carry(box, place)
        for _ in self._work.layout.places:
            if isinstance(plan, str) or await self.compartments.as_booked(plan.place):
                break
            self._promises.release(box)
            plan = await self._carry(box, place)
        return plan

    async def _carry(self, box: BoxId, place: PlaceId) -> CarryPlan | str:
        self._look_at_bays()
        promises = self._promises
        kept, here = promises.carry_of(box), self._planner.here
        there = self._open((place,)) if place != ASIDE else [place]
        good = kept is not None and kept.place == place and bool(there) and self._keeps(kept)
        if kept is not None and good and stands_at(here, kept.motion.start):
            promises.next_start = kept.end
            return kept
        promises.release(box)
        named = self._places_named(place)
        elsewhere = () if place == ASIDE else self._lists.get(box, ())
        return await self.find_place(box, (*named, *(p for p in elsewhere if p not in named)))

    def _keeps(self, plan: CarryPlan) -> bool:
        """Whether a plan keeps to what its tasks ask now."""
        rules = rules_on(self._work.engine, plan.load.box, LEAVING)
        return plan.load.rules.cover(rules)

    def _places_named(self, place: PlaceId) -> tuple[PlaceId, ...]:
        """The place itself, or all of the storage that boxes are set aside into."""
        if place != ASIDE:
            return (place,)
        storage = self._work.layout.storage(self._work.layout.aside)
        return tuple(each.id for each in storage.places)

    def way_out(self, plan: CarryPlan) -> Trajectory | None:
        """Back along the straight way into a place, where the arm has stopped on it."""
        motion, here = plan.motion, self._planner.here
        if not motion.allowances:
            return None
        row = int(np.argmin(np.abs(motion.positions - here).max(axis=1)))
        inside = int(np.searchsorted(motion.times, motion.allowances[-1][0]))
        if row <= inside:
            return None
        back = motion.positions[inside : row + 1][::-1].copy()
        return self._planner.timing.along([Part(Kind.STRAIGHT, rebased(back, here))])

    def descent(self, plan: CarryPlan) -> Trajectory | None:
        """The plan's way down, or what is left of it where the arm has stopped on it."""
        here, motion = self._planner.here, plan.descent
        row = int(np.argmin(np.abs(motion.positions - here).max(axis=1)))
        if not row:
            return motion
        rest = motion.positions[row:].copy()
        if len(rest) < 2:  # noqa: PLR2004 - a path has two ends
            return None
        part = Part(Kind.STRAIGHT, rebased(rest, here), touching=True)
        return self._planner.timing.slowly(part, self._planner.holding(plan.load))

    def retreat(self, plan: CarryPlan) -> Trajectory | None:
        """Straight out of the place from where the arm has come to rest."""
        kinematics, here = self._planner.mover.body.kinematics, self._planner.here
        part = Part(Kind.STRAIGHT, straight_to_end(kinematics, plan.retreat, here))
        return self._planner.timing.along([part])
