"""Fakes of every port: small, scripted, in the time of the running loop.

They know no physics. A test says what happens; they tell in which order it happened.
"""

from depal.ports.fakes.arm import FakeArm
from depal.ports.fakes.bays import FakeBays
from depal.ports.fakes.gripper import FakeGripper
from depal.ports.fakes.override import FakeOverride
from depal.ports.fakes.person import FakePerson
from depal.ports.fakes.reader import FakeReader
from depal.ports.fakes.safety import FakeSafety
from depal.ports.fakes.sight import FakeSight
from depal.ports.fakes.store import FakeStore

__all__ = [
    "FakeArm",
    "FakeBays",
    "FakeGripper",
    "FakeOverride",
    "FakePerson",
    "FakeReader",
    "FakeSafety",
    "FakeSight",
    "FakeStore",
]
