"""What a simulated cell sees with when it looks with its cameras."""

from depal.app.run.values import Job
from depal.cell.sight import CameraSight
from depal.errors import MissingPartError
from depal.executive.clock import Clock
from depal.simulation.cell import SimulatedCell


def camera_sight(job: Job, cell: SimulatedCell, clock: Clock) -> CameraSight:
    """The cell's cameras, perception and memory.

    Raises:
        MissingPartError: this version has no perception.
    """
    raise MissingPartError("perception from the camera is not there yet")
