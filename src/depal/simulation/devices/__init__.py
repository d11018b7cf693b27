"""The devices of the simulated cell, behind the ports."""

from depal.simulation.devices.arm import SimulatedArm
from depal.simulation.devices.bays import SimulatedBays
from depal.simulation.devices.gripper import SimulatedGripper
from depal.simulation.devices.safety import SimulatedSafety

__all__ = ["SimulatedArm", "SimulatedBays", "SimulatedGripper", "SimulatedSafety"]
