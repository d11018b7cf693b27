"""Faults as data, injected behind the ports of a simulated cell."""

from depal.simulation.faults.catalogue import CATALOGUE, End, Entry, Phase
from depal.simulation.faults.injection import Injection
from depal.simulation.faults.plan import Fault, FaultPlan, Struck, When
from depal.simulation.faults.reading import faults_schema, read_faults

__all__ = [
    "CATALOGUE",
    "End",
    "Entry",
    "Fault",
    "FaultPlan",
    "Injection",
    "Phase",
    "Struck",
    "When",
    "faults_schema",
    "read_faults",
]
