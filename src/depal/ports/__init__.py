"""The seams between the controller and everything outside: small protocols and their values."""

from depal.executive.clock import Clock
from depal.ports.devices import (
    LOST,
    STANDS,
    Arm,
    BarcodeReader,
    Bays,
    Camera,
    Frame,
    Gripper,
    Guard,
    Override,
    Safety,
    SafetyState,
    Watch,
)
from depal.ports.people import TAKEN, Movement, Person, Question, StoreSystem
from depal.ports.sight import Sight, View
from depal.ports.trajectory import Trajectory

__all__ = [
    "LOST",
    "STANDS",
    "TAKEN",
    "Arm",
    "BarcodeReader",
    "Bays",
    "Camera",
    "Clock",
    "Frame",
    "Gripper",
    "Guard",
    "Movement",
    "Override",
    "Person",
    "Question",
    "Safety",
    "SafetyState",
    "Sight",
    "StoreSystem",
    "Trajectory",
    "View",
    "Watch",
]
