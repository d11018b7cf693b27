"""The devices of a cell as the controller sees them. Every wait is on the running loop's time."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Protocol

import numpy as np
import numpy.typing as npt

from depal.domain.grasp import Cup
from depal.domain.names import PlaceId
from depal.domain.robot import Joints
from depal.geometry import Matrix3, Pose
from depal.ports.trajectory import Trajectory

Guard = Callable[[], str | None]
"""Asked in every control period of a motion: a reason to stop, or None."""


LOST = "the vacuum broke: the box is lost"

STANDS = "stands"


@dataclass(frozen=True, slots=True)
class Watch:
    """What a robot's own controller watches in every control period of a motion.

    Attributes:
        least: a module whose vacuum falls below this has lost its hold [Pa].
        load: below this mass on the flange a box that is set down stands [kg]; None for never.
    """

    least: tuple[tuple[str, float], ...] = ()
    load: float | None = None

    @property
    def idle(self) -> bool:
        """Whether it looks at nothing."""
        return not self.least and self.load is None

    def reason(self, vacuum: Mapping[str, float], load: Callable[[], float]) -> str | None:
        """A reason to stop, or None.

        Args:
            vacuum: what each module's sensor reads [Pa].
            load: reads what hangs on the flange [kg].
        """
        if any(vacuum[name] < least for name, least in self.least):
            return LOST
        return STANDS if self.load is not None and load() < self.load else None


class Arm(Protocol):
    """The arm with its load cell."""

    def joints(self) -> Joints:
        """Where the axes are [rad]."""
        ...

    def load(self) -> float:
        """The weight that hangs on the flange beyond the tool's own, as a mass [kg]."""
        ...

    async def follow(self, trajectory: Trajectory, guard: Guard | None = None) -> str | None:
        """Moves along a trajectory that begins where the arm stands.

        Args:
            trajectory: the motion.
            guard: asked in every control period; a reason brings the arm to rest on its path.

        Returns:
            None once the arm rests at the end, else the reason why it stopped before.

        Raises:
            DeviceError: the arm cannot move: a safety stop, a fault, a start that is not here.
        """
        ...


class Override(Protocol):
    """The override of the arm's own controller: how fast a motion is gone through."""

    def limit(self, speed: float) -> None:
        """From now on flange and tool are no faster than this, in this motion and in all others.

        A motion keeps its path, and goes on by itself when the limit is taken back.

        Args:
            speed: [m/s]; infinite for as fast as planned, 0 to stand still on the path.
        """
        ...


class Gripper(Protocol):
    """The suction gripper."""

    def vacuum(self) -> dict[str, float]:
        """What each module's sensor reads: below the pressure around [Pa], 0 when vented."""
        ...

    def folded(self) -> bool:
        """Whether the lower module is hinged up."""
        ...

    async def fold(self, *, up: bool) -> None:
        """Moves the hinge and waits for its end."""
        ...

    async def suck(self, cups: tuple[Cup, ...]) -> bool:
        """Opens the valves of these cups and waits until the vacuum stands, or will not.

        Returns:
            Whether every module with an open valve holds its vacuum.
        """
        ...

    async def release(self) -> None:
        """Vents all cups and waits until the box is let go."""
        ...


@dataclass(frozen=True, slots=True, eq=False)
class Frame:
    """One picture of an RGB-D camera.

    Attributes:
        taken: when [s].
        colour: (h, w, 3) uint8, RGB.
        depth: (h', w') float32 along the optical axis [m]; 0 where nothing was measured.
        colour_k: intrinsics of the colour picture, row-major.
        depth_k: intrinsics of the depth picture, row-major.
        cell_from_camera: where it was taken from: z forward, x right, y down.
    """

    taken: float
    colour: npt.NDArray[np.uint8]
    depth: npt.NDArray[np.float32]
    colour_k: Matrix3
    depth_k: Matrix3
    cell_from_camera: Pose


class Camera(Protocol):
    """An RGB-D camera that faces the pallet."""

    async def take(self) -> Frame:
        """Takes one picture; its exposure takes time.

        Raises:
            DeviceError: no picture came.
        """
        ...


class BarcodeReader(Protocol):
    """A reader that a held box is shown to."""

    async def read(self) -> tuple[str, ...]:
        """What it decodes now; empty where it sees no code."""
        ...


class Bays(Protocol):
    """Sensors of the places: whether a trolley is locked in its bay, and which one."""

    def trolley(self, bay: str) -> str | None:
        """The name of the trolley that stands locked in the bay, None where none does."""
        ...

    async def profile(self, place: PlaceId) -> tuple[float, ...]:
        """How far in from its opening a compartment is free, strip by strip [m].

        What the range sensor above the opening reads: the opening is parted into strips of equal
        width, from the smallest y of the place's frame to the greatest; where nothing stands, the
        way to the back.
        """
        ...


@dataclass(frozen=True, slots=True)
class SafetyState:
    """What the safety controller says; read only.

    Attributes:
        stopped: an emergency stop or a protective stop is active.
        gate_open: somebody may be inside.
        near: somebody is in the scanner's warning field: the arm has to be slow.
        inside: somebody is in its protective field: nothing may move.
        read: when the controller was last heard [s]; None for just now.
    """

    stopped: bool
    gate_open: bool
    near: bool = False
    inside: bool = False
    read: float | None = None

    @property
    def tripped(self) -> bool:
        """Whether only a person's start lets anything move again."""
        return self.stopped or self.gate_open


class Safety(Protocol):
    """The safety controller, which this software only reads."""

    def state(self) -> SafetyState:
        """What it says now."""
        ...
