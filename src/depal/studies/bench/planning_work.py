"""The motions of real deliveries: every box is picked and put away, one after the other."""

import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from typing import TypeVar

import numpy as np
import numpy.typing as npt

from depal.cell.planning.placing import as_pushed_in, turn_into
from depal.cell.planning.plans import Load
from depal.domain import BoxId, CellLayout, Delivery, Grasp, Place, Recognition
from depal.geometry import OrientedBox, Pose
from depal.logistics.placing import MARGINS, Books, Spot, find_spots
from depal.motion.collision import Checker, Scene, fixed_solids
from depal.motion.grasping import grasps
from depal.motion.moves import OPEN, Berth, Mover, NoMotion, Part, Pick, Put
from depal.motion.planning.free import Effort
from depal.studies.real import perceived_stack, unload_delivery

Floats = npt.NDArray[np.float64]
T = TypeVar("T")

FRONT = (-1.0, 0.0, 0.0)
"""Towards the robot from the default cell's pallet."""


@dataclass(frozen=True, slots=True, eq=False)
class Motion:
    """One planned motion with its straight parts.

    Attributes:
        seconds: what planning took.
        part: its way through free space; None where none was found.
        reason: why not; empty where it was found.
        checker: of the free part.
    """

    seconds: float
    part: Part | None
    reason: str
    checker: Checker


@dataclass(frozen=True, slots=True, eq=False)
class _Way:
    """A grasp for which a place has a spot within reach."""

    grasp: Grasp
    place: Place
    spot: Spot
    berth: Berth


class Emptying:
    """Takes a delivery apart by geometry alone, planning every motion."""

    def __init__(self, layout: CellLayout, delivery: Delivery, seed: int = 0) -> None:
        """For one cell and one delivery.

        Args:
            layout: the cell.
            delivery: with its stack.
            seed: which trolley each box belongs to, and of the planner's samples.
        """
        self.unplaced = 0
        self._layout = layout
        self._mover = Mover(layout)
        self._delivery = delivery
        self._fixed = fixed_solids(layout)
        self._books = Books.empty(layout.places.values())
        self._seed = seed
        self._cases: dict[BoxId, OrientedBox] = {}

    def motions(self) -> Iterator[Motion]:
        """Every pick and every put, in the order of Algorithm 1."""
        boxes = perceived_stack(self._delivery)
        order = unload_delivery(self._delivery, (), 0.5).sequence
        self._cases = {box.id: box.shape for box in boxes}
        rng = np.random.default_rng(self._seed)
        start = parked = np.array(self._layout.robot.parked)
        for number, index in enumerate(order):
            box = boxes[index]
            way = self._way(box, self._places(rng))
            if way is None:
                self.unplaced += 1
                del self._cases[box.id]
                continue
            effort = Effort(seed=self._seed + number)
            pick, motion = self._pick(start, box, way, effort)
            del self._cases[box.id]
            yield motion
            if isinstance(pick, NoMotion):
                start = parked
                continue
            put, motion = self._put(pick, box, way, effort)
            yield motion
            start = parked if isinstance(put, NoMotion) else put.retreat.path[-1]

    def _places(self, rng: np.random.Generator) -> list[Place]:
        """The trolleys from a random one on, the storage for what is set aside last."""
        places = list(self._layout.places.values())
        aside = [place for place in places if place.id.startswith(self._layout.aside)]
        trolleys = [place for place in places if place not in aside]
        first = int(rng.integers(len(trolleys)))
        return [*trolleys[first:], *trolleys[:first], *aside]

    def _way(self, box: Recognition, places: list[Place]) -> _Way | None:
        """The first place that has a spot within reach for a grasp that can be had."""
        mass = self._delivery.products[box.gtin].mass
        scene, with_box = self._scene(without=box.id), self._scene()
        near = np.array(self._layout.robot.parked)
        ways = [
            grasp
            for grasp in grasps(box.shape, mass, self._layout.tool, FRONT)
            if not self._mover.why_no_pick(near, box.shape, grasp, with_box, str(box.id))
        ]
        for place in places:
            for grasp in ways:
                load = Load(box.id, grasp, box.shape.size, mass, (), near)
                turn = turn_into(load)

                def berth_at(spot: Spot, load: Load = load, turn: Pose = turn) -> Berth:
                    where = Pose(spot.place_from_box.translation, turn.rotation)
                    into = self._layout.places[spot.place].cell_from_place
                    return Berth(load.grasp, load.size, into, into @ where, MARGINS.lift)

                def reachable(spot: Spot, berth_at: Callable[[Spot], Berth] = berth_at) -> bool:
                    return not self._mover.why_no_put(near, berth_at(spot), scene)

                held = as_pushed_in(load, turn, self._layout.tool)
                there = self._books.at(place.id)
                for spot in find_spots(there, held, limit=1, reachable=reachable):
                    return _Way(grasp, place, spot, berth_at(spot))
        return None

    def _pick(
        self, start: Floats, box: Recognition, way: _Way, effort: Effort
    ) -> tuple[Pick | NoMotion, Motion]:
        scene = self._scene()
        pick, seconds = timed(
            lambda: self._mover.pick(start, box.shape, [way.grasp], scene, str(box.id), effort)
        )
        free = None if isinstance(pick, NoMotion) else pick.approach[0]
        reason = str(pick) if isinstance(pick, NoMotion) else ""
        checker = self._mover.checker(scene, OPEN, folded=way.grasp.folded)
        return pick, Motion(seconds, free, reason, checker)

    def _put(
        self, pick: Pick, box: Recognition, way: _Way, effort: Effort
    ) -> tuple[Put | NoMotion, Motion]:
        scene, start = self._scene(), pick.out.path[-1]
        put, seconds = timed(lambda: self._mover.put((pick.out,), start, way.berth, scene, effort))
        checker = self._mover.checker(scene, OPEN, pick.grasp, box.shape.size)
        if isinstance(put, NoMotion):
            return put, Motion(seconds, None, str(put), checker)
        self._books = self._books.put(way.place.id, way.spot.standing(box.id))
        self._cases[box.id] = replace(box.shape, pose=way.berth.target)
        return put, Motion(seconds, put.carry[1], "", checker)

    def _scene(self, without: BoxId | None = None) -> Scene:
        cases = [(str(name), box) for name, box in self._cases.items() if name != without]
        return Scene.of(self._fixed, cases)


def timed(work: Callable[[], T]) -> tuple[T, float]:
    """What a call returns, and how long it took [s]."""
    begin = time.perf_counter()
    result = work()
    return result, time.perf_counter() - begin
