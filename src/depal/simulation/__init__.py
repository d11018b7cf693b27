"""The simulated cell behind the ports: physics, devices, people, and a referee who knows."""

from depal.simulation.cases import Case, cases_of
from depal.simulation.cell import SimulatedCell, build
from depal.simulation.contacts import Collision
from depal.simulation.imaging.severity import Severity
from depal.simulation.losses import Cause, Loss
from depal.simulation.people import SimulatedPerson
from depal.simulation.referee import Referee, Summary, Truth
from depal.simulation.snapshot import Snapshot
from depal.simulation.stacking import stacked
from depal.simulation.truth_sight import SightSettings, TruthSight
from depal.simulation.witness import Witness, name_of
from depal.simulation.world import World

__all__ = [
    "Case",
    "Cause",
    "Collision",
    "Loss",
    "Referee",
    "Severity",
    "SightSettings",
    "SimulatedCell",
    "SimulatedPerson",
    "Snapshot",
    "Summary",
    "Truth",
    "TruthSight",
    "Witness",
    "World",
    "build",
    "cases_of",
    "name_of",
    "stacked",
]
