"""A light world with everything around it that outlives a controller."""

from collections import Counter
from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np

from depal.domain import BoxId, CellLayout, Delivery, Gtin, PlaceId
from depal.executive.clock import Clock
from depal.ports import BarcodeReader, Bays, Gripper, Person, Safety, Sight, StoreSystem
from depal.simulation.cases import cases_of
from depal.simulation.devices import SimulatedSafety
from depal.simulation.light.devices import (
    LightArm,
    LightBays,
    LightGripper,
    LightReader,
    LightSight,
    Seat,
)
from depal.simulation.light.life import Life
from depal.simulation.light.person import Deeds, LightPerson
from depal.simulation.light.rates import NO_FAULTS, Rates
from depal.simulation.light.store import LightStore, StoreLine
from depal.simulation.light.world import LightWorld
from depal.simulation.stacking import stacked


@dataclass(frozen=True, slots=True)
class Devices:
    """What one controller is given.

    Attributes:
        arm: behind `Arm`.
        gripper: behind `Gripper`.
        reader: behind `BarcodeReader`.
        bays: behind `Bays`.
        safety: behind `Safety`.
        person: behind `Person`.
        store: behind `StoreSystem`.
        sight: behind `Sight`.
    """

    arm: LightArm
    gripper: Gripper
    reader: BarcodeReader
    bays: Bays
    safety: Safety
    person: Person
    store: StoreSystem
    sight: Sight


@dataclass(frozen=True, slots=True)
class LightCell:
    """A world, its worker and the store's system; controllers come and go.

    Attributes:
        world: the truth.
        deeds: of the worker.
        store: the store's system.
        clock: of the cell.
        rates: of the faults.
        seed: of every random number.
        random: for chances.
        unrecognised: the share of boxes that the sight does not name.
        struck: how often each fault has, by its rate's name.
    """

    world: LightWorld
    deeds: Deeds
    store: LightStore
    clock: Clock
    rates: Rates
    seed: int
    random: np.random.Generator
    unrecognised: float
    struck: Counter[str] = field(default_factory=Counter)

    def devices(self, life: Life) -> Devices:
        """For a controller that begins its life."""
        seat = Seat(self.world, self.clock, life, self.rates, self.random, self.struck)
        return Devices(
            LightArm(seat),
            LightGripper(seat),
            LightReader(seat),
            LightBays(seat),
            SimulatedSafety(self.clock.now),
            LightPerson(seat, self.deeds),
            StoreLine(self.store, life),
            LightSight(seat, self.known()),
        )

    def known(self) -> Callable[[int], bool]:
        """Whether the sight names a box, by its index in the stack."""
        random = np.random.default_rng([self.seed, 22])
        named = (random.random(len(self.world.boxes)) >= self.unrecognised).tolist()
        return lambda index: bool(named[index])

    def refuses(self, box: BoxId, standing: int) -> bool:
        """Whether nothing reaches a box while so many stand on the pallet (M3)."""
        if self.rates.infeasible <= 0.0:
            return False
        number = int(str(box).lstrip("b")) if str(box).lstrip("b").isdigit() else 0
        random = np.random.default_rng([self.seed, 23, number, standing])
        refused = bool(random.random() < self.rates.infeasible)
        self.struck["infeasible"] += refused
        return refused


def build_light(
    layout: CellLayout,
    delivery: Delivery,
    places: dict[Gtin, tuple[PlaceId, ...]],
    seed: int = 0,
    *,
    clock: Clock,
    rates: Rates = NO_FAULTS,
    unrecognised: float = 0.1,
) -> LightCell:
    """A light cell with a delivery on its pallet.

    Args:
        layout: the cell.
        delivery: its stack is used; where it has none, the note is stacked.
        places: the store's lists.
        seed: of every random number.
        clock: of the cell.
        rates: of the faults.
        unrecognised: the share of boxes that the sight does not name.
    """
    stack = delivery.stack if delivery.stack is not None else stacked(delivery)
    world = LightWorld(layout, cases_of(delivery, stack, layout))
    return LightCell(
        world,
        Deeds(),
        LightStore(places),
        clock,
        rates,
        seed,
        np.random.default_rng([seed, 24]),
        unrecognised,
    )
