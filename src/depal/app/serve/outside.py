"""What a served cell has outside itself, as its host sees it."""

from collections.abc import Sequence
from typing import Protocol

from depal.domain import BoxId, CellLayout, Delivery
from depal.executive.clock import Clock
from depal.ports import Arm, BarcodeReader, Bays, Camera, Gripper, Override, Question, Safety, Sight
from depal.ports.wire.messages import Built
from depal.server.cellstate import QuestionState


class Deeds(Protocol):
    """What a person does with their hands, where the world is simulated."""

    async def do(self, question: Question, answer: str) -> None:
        """Does in the world what an answer promises; where the world is real, people do."""
        ...


class World(Protocol):
    """A cell's devices, from a world that outlives the controller."""

    arm: Arm
    gripper: Gripper
    bays: Bays
    safety: Safety
    override: Override
    reader: BarcodeReader
    cameras: Sequence[Camera]
    truth_sight: Sight

    @property
    def deeds(self) -> Deeds:
        """What people do there."""
        ...

    @property
    def built(self) -> Built | None:
        """What stands there; None where nothing does."""
        ...

    async def build(
        self, layout: CellLayout, delivery: Delivery, *, seed: int, severity: str, number: int
    ) -> None:
        """A full pallet and empty trolleys come into the cell."""
        ...

    def witness_lifted(self, box: BoxId) -> None:
        """Tells the referee which box the cell means by a name: the one in the hand."""
        ...

    async def shutdown(self) -> None:
        """Ends the world."""
        ...

    async def close(self) -> None:
        """Lets go of the world, which lives on."""
        ...


class Records(Protocol):
    """Where the host writes what is to be known after it: called on the cell's thread."""

    def asked(self, run: int, question: QuestionState) -> None:
        """A question was asked."""
        ...

    def answered(self, question: str, choice: str, by: str, at: float) -> None:
        """It was answered, or is not asked any more."""
        ...

    def request_ended(self, key: str, *, served: bool, at: float, reason: str) -> None:
        """A request has ended."""
        ...

    def run_ended(self, run: int, state: str, at: float, result: dict[str, object]) -> None:
        """A run is over."""
        ...


class Connect(Protocol):
    """Finds the world that runs, or starts one."""

    async def __call__(self, clock: Clock) -> World:
        """The world.

        Raises:
            DeviceError: there is none and none can be started.
        """
        ...
