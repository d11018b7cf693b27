"""Faults injected into a simulated cell: its devices wrapped, one by one."""

from dataclasses import dataclass

from depal.executive.clock import Clock
from depal.executive.journal import Journal
from depal.motion.moves import Mover
from depal.ports import Sight, StoreSystem
from depal.simulation.cell import SimulatedCell
from depal.simulation.faults.arm import FaultyArm
from depal.simulation.faults.bays import FaultyBays
from depal.simulation.faults.chances import Chances
from depal.simulation.faults.gripper import FaultyGripper
from depal.simulation.faults.journal import FaultyJournal, refuse
from depal.simulation.faults.person import MendingPerson
from depal.simulation.faults.pile import FaultyPile
from depal.simulation.faults.plan import FaultPlan, Struck
from depal.simulation.faults.planning import FaultyMover
from depal.simulation.faults.reader import FaultyReader
from depal.simulation.faults.sight import FaultyCamera, FaultySight
from depal.simulation.faults.store import FaultyStore


@dataclass(frozen=True, slots=True)
class Injection:
    """The devices of a cell in which faults strike, each behind its port.

    Attributes:
        chances: what has struck.
        arm: behind `Arm`.
        gripper: behind `Gripper`.
        bays: behind `Bays`.
        person: behind `Person`.
        reader: behind `BarcodeReader`.
        cameras: each behind `Camera`.
        clock: of the cell.
    """

    chances: Chances
    arm: FaultyArm
    gripper: FaultyGripper
    bays: FaultyBays
    person: MendingPerson
    reader: FaultyReader
    cameras: tuple[FaultyCamera, ...]
    clock: Clock

    @classmethod
    def into(cls, cell: SimulatedCell, plan: FaultPlan, seed: int, clock: Clock) -> "Injection":
        """Wraps the devices of a cell.

        Args:
            cell: whose devices fail.
            plan: which faults are to strike.
            seed: of every random number.
            clock: of the cell.
        """
        world, chances = cell.world, Chances(plan, seed, clock.now)
        bays = FaultyBays(cell.bays, world, clock, chances, cell.person.take_away)
        pile = FaultyPile(world, chances, plan)
        arm = FaultyArm(cell.arm, world, clock, cell.safety, chances, pile)
        return cls(
            chances,
            arm,
            FaultyGripper(cell.gripper, world, chances, pile, bays.grasped),
            bays,
            MendingPerson(cell.person, cell.safety, chances, arm.acknowledged),
            FaultyReader(cell.reader, world, chances),
            tuple(FaultyCamera(camera, chances) for camera in cell.cameras),
            clock,
        )

    def sight(self, sight: Sight) -> FaultySight:
        """A sight that needs no camera, and fails as one would."""
        return FaultySight(sight, self.chances)

    def store(self, store: StoreSystem) -> FaultyStore:
        """The store's system, whose answers may fail."""
        return FaultyStore(store, self.clock, self.chances, self.bays.asked_for)

    def mover(self, mover: Mover) -> Mover:
        """The mover of the cell, which may find no way."""
        fails = {"M3", "M4"} & self.chances.planned
        return FaultyMover(mover.layout, self.chances) if fails else mover

    def journal(self, journal: Journal) -> FaultyJournal:
        """The executive's journal, on a disk that may be full."""
        return FaultyJournal(journal, self.chances)

    def page(self) -> None:
        """A page of the ledger is written, where the disk takes it.

        Raises:
            JournalError: the disk is full.
        """
        refuse(self.chances)

    @property
    def struck(self) -> tuple[Struck, ...]:
        """What has struck so far, in order."""
        return tuple(self.chances.struck)
