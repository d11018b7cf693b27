"""The arm as a cell file describes it."""

from dataclasses import dataclass

from depal.geometry import Vector3

Joints = tuple[float, float, float, float, float, float]
"""Angles of the six axes [rad], or their rates [rad/s], [rad/s^2]."""

LINKS = ("base", "link_1", "link_2", "link_3", "link_4", "link_5", "link_6")
"""Bodies of the arm; link i moves with axis i, link 6 carries the flange."""


@dataclass(frozen=True, slots=True)
class ArmGeometry:
    """An ortho-parallel arm with a spherical wrist (Brandstoetter, Angerer, Hofbaur 2014).

    With all axes at zero both arms point forward: axis 1 stands at the base's origin, axis 2 at
    (a1, 0, c1) from it, axis 3 at (c2, 0, 0) from that, axis 4 at (0, b, -a2), axes 5 and 6 at
    (c3, 0, 0), the flange at (c4, 0, 0); every link's frame is parallel to the base's, x forward,
    z up. The axes turn about -z, +y, +y, -x, +y, -x.

    Attributes:
        a1: shoulder ahead of axis 1 [m].
        a2: elbow below the forearm's line, negative where it is above [m].
        b: lateral offset of the forearm [m].
        c1: height of the shoulder [m].
        c2: length of the upper arm [m].
        c3: length of the forearm, to the wrist's centre [m].
        c4: from the wrist's centre to the flange [m].
    """

    a1: float
    a2: float
    b: float
    c1: float
    c2: float
    c3: float
    c4: float

    @property
    def joint_origins(self) -> tuple[Vector3, ...]:
        """Each axis from the one before, then the flange from axis 6, at zero: (7) [m]."""
        return (
            (0.0, 0.0, 0.0),
            (self.a1, 0.0, self.c1),
            (self.c2, 0.0, 0.0),
            (0.0, self.b, -self.a2),
            (self.c3, 0.0, 0.0),
            (0.0, 0.0, 0.0),
            (self.c4, 0.0, 0.0),
        )


JOINT_AXES: tuple[Vector3, ...] = (
    (0.0, 0.0, -1.0),
    (0.0, 1.0, 0.0),
    (0.0, 1.0, 0.0),
    (-1.0, 0.0, 0.0),
    (0.0, 1.0, 0.0),
    (-1.0, 0.0, 0.0),
)
"""The direction that each axis turns about at zero, in its link's frame."""


@dataclass(frozen=True, slots=True)
class JointLimits:
    """What the axes can do.

    Attributes:
        lower: [rad].
        upper: [rad].
        speed: [rad/s].
        acceleration: [rad/s^2].
    """

    lower: Joints
    upper: Joints
    speed: Joints
    acceleration: Joints


@dataclass(frozen=True, slots=True)
class Capsule:
    """A collision shape of a link: a segment with a radius, in the link's frame.

    Attributes:
        link: index into `LINKS`.
        start: [m].
        end: [m]; may equal `start`, then it is a sphere.
        radius: [m].
    """

    link: int
    start: Vector3
    end: Vector3
    radius: float


@dataclass(frozen=True, slots=True)
class Robot:
    """An arm.

    Attributes:
        name: its type.
        geometry: its kinematics.
        limits: of its axes.
        payload: what the flange may carry, tool included [kg].
        link_masses: of the links, base first, (7) [kg].
        shapes: what can collide.
        parked: where it stands when idle: out of the camera's view.
    """

    name: str
    geometry: ArmGeometry
    limits: JointLimits
    payload: float
    link_masses: tuple[float, ...]
    shapes: tuple[Capsule, ...]
    parked: Joints
