"""The simulated cell: one world, and every device and person of it behind the ports."""

from dataclasses import dataclass

from depal.domain import CellLayout, Delivery
from depal.executive.clock import Clock, LoopClock
from depal.ports import BarcodeReader, Camera
from depal.simulation.cases import cases_of
from depal.simulation.devices import (
    SimulatedArm,
    SimulatedBays,
    SimulatedGripper,
    SimulatedSafety,
)
from depal.simulation.imaging.camera import Shutter, SimulatedCamera
from depal.simulation.imaging.reader import SimulatedReader
from depal.simulation.imaging.scene import Stage
from depal.simulation.imaging.severity import Severity
from depal.simulation.people import Policy, SimulatedPerson
from depal.simulation.referee import Referee
from depal.simulation.stacking import stacked
from depal.simulation.truth_sight import SightSettings, TruthSight
from depal.simulation.witness import Witness
from depal.simulation.world import World


@dataclass(slots=True)
class SimulatedCell:
    """A cell whose devices share one world.

    Attributes:
        world: the physics.
        arm: behind the port `Arm`.
        gripper: behind `Gripper`.
        bays: behind `Bays`.
        safety: behind `Safety`.
        person: behind `Person`.
        sight: behind `Sight`, from the truth.
        referee: for reports and tests only.
        reader: behind `BarcodeReader`.
        cameras: each behind `Camera`, in the order of the layout.
    """

    world: World
    arm: SimulatedArm
    gripper: SimulatedGripper
    bays: SimulatedBays
    safety: SimulatedSafety
    person: SimulatedPerson
    sight: TruthSight
    referee: Referee
    reader: BarcodeReader
    cameras: tuple[SimulatedCamera, ...]

    @property
    def camera(self) -> Camera:
        """The first camera of the layout."""
        return self.cameras[0]

    @property
    def witness(self) -> Witness:
        """Who has seen which box a name means."""
        return self.person.witness


def build(  # noqa: PLR0913 - each is a choice of its own
    layout: CellLayout,
    delivery: Delivery,
    seed: int = 0,
    *,
    clock: Clock | None = None,
    start: float = 0.0,
    sight: SightSettings | None = None,
    severity: Severity = Severity.NORMAL,
    policy: Policy | None = None,
    kind: type[World] = World,
) -> SimulatedCell:
    """Builds a cell with a delivery on its pallet.

    Args:
        layout: the cell.
        delivery: its stack is used; where it has none, the note is stacked.
        seed: of all randomness in this cell.
        clock: the loop's time where nothing else is said.
        start: the time at the beginning [s].
        sight: how good the perception from the truth is.
        severity: how far cameras and prints are from ideal.
        policy: how the worker answers; None for what is so.
        kind: of the world.

    Returns:
        The cell with its stack settled and the arm parked.

    Raises:
        DeliveryError: a note whose cases do not fit on the pallet.
    """
    stack = delivery.stack if delivery.stack is not None else stacked(delivery)
    time = clock or LoopClock()
    world = kind(layout, cases_of(delivery, stack, layout), seed, start)
    safety, stage = SimulatedSafety(time.now), Stage(world)
    shutter = Shutter(stage)
    return SimulatedCell(
        world,
        SimulatedArm(world, time, safety),
        SimulatedGripper(world, time),
        SimulatedBays(world, time),
        safety,
        SimulatedPerson(world, time, policy),
        TruthSight(world, time, sight),
        Referee(world),
        SimulatedReader(stage, time),
        tuple(SimulatedCamera(stage, time, mount, severity, shutter) for mount in layout.cameras),
    )
