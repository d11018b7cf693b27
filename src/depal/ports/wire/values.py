"""Values of the ports as they are sent: arrays become tables."""

import msgspec
import numpy as np

from depal.domain import BoxId, Detection, Gtin, Perceived, Recognition
from depal.errors import DeviceError
from depal.geometry import Matrix3, OrientedBox, Pose
from depal.ports.devices import Frame
from depal.ports.sight import View
from depal.ports.trajectory import Trajectory
from depal.ports.wire.codec import Table, packed, unpacked

AXES = 6
"""Of the arm."""


class Path(msgspec.Struct, frozen=True):
    """A trajectory."""

    times: Table
    positions: Table
    velocities: Table
    allowances: tuple[tuple[float, float], ...]

    @classmethod
    def of(cls, trajectory: Trajectory) -> "Path":
        """As it is sent."""
        return cls(
            packed(trajectory.times),
            packed(trajectory.positions),
            packed(trajectory.velocities),
            trajectory.allowances,
        )

    @property
    def trajectory(self) -> Trajectory:
        """As it was sent.

        Raises:
            DeviceError: it is none.
        """
        tables = (self.times, self.positions, self.velocities)
        times, positions, velocities = (unpacked(table).astype(float) for table in tables)
        shapes = times.shape, positions.shape, velocities.shape
        n = times.size
        if not n or shapes != ((n,), (n, AXES), (n, AXES)):
            what = f"a trajectory of shapes {shapes} came"
            raise DeviceError(f"{what}; expected (n,), (n, {AXES}), (n, {AXES})")
        if times[0] != 0.0 or not (np.diff(times) > 0.0).all():
            raise DeviceError("a trajectory came whose times do not rise from 0")
        return Trajectory(times, positions, velocities, self.allowances)


class Photo(msgspec.Struct, frozen=True):
    """A frame."""

    taken: float
    colour: Table
    depth: Table
    colour_k: Matrix3
    depth_k: Matrix3
    cell_from_camera: Pose

    @classmethod
    def of(cls, frame: Frame) -> "Photo":
        """As it is sent."""
        return cls(
            frame.taken,
            packed(frame.colour),
            packed(frame.depth),
            frame.colour_k,
            frame.depth_k,
            frame.cell_from_camera,
        )

    @property
    def frame(self) -> Frame:
        """As it was sent."""
        return Frame(
            self.taken,
            unpacked(self.colour),
            unpacked(self.depth),
            self.colour_k,
            self.depth_k,
            self.cell_from_camera,
        )


class Thing(msgspec.Struct, frozen=True):
    """A perceived box."""

    box: BoxId
    shape: OrientedBox
    gtin: Gtin | None


class Sightings(msgspec.Struct, frozen=True):
    """A view of a sight that knows the truth."""

    taken: float
    things: tuple[Thing, ...]

    @classmethod
    def of(cls, view: View) -> "Sightings":
        """As it is sent."""
        things = (
            Thing(box.id, box.shape, box.gtin if isinstance(box, Recognition) else None)
            for box in view.boxes
        )
        return cls(view.taken, tuple(things))

    @property
    def view(self) -> View:
        """As it was sent."""
        return View(self.taken, tuple(_perceived(thing) for thing in self.things))


def _perceived(thing: Thing) -> Perceived:
    if thing.gtin is None:
        return Detection(thing.box, thing.shape)
    return Recognition(thing.box, thing.shape, thing.gtin)
