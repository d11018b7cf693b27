"""Bodies of the model: the arm with its tool, boxes, and solid things that stand still."""

import itertools

import mujoco
import numpy as np

from depal.domain import JOINT_AXES, LINKS, Capsule, Robot, Tool
from depal.geometry import Matrix3, OrientedBox
from depal.simulation.cases import Case

ARM_STIFFNESS = (2e6, 2e6, 1.2e6, 9e4, 9e4, 7e4)
"""Of the position servos [N m/rad]."""

ARM_DAMPING = (4e4, 4e4, 2.4e4, 2e3, 2e3, 1.5e3)
"""Of the servos, against the difference to the wanted rate [N m s/rad].

Damping times the step stays below the inertia, for a servo at its limit is not implicit any more:
stronger ones went on striking from limit to limit.
"""

ARM_TORQUE = (2e4, 2e4, 1e4, 3e3, 3e3, 1.5e3)
"""What the servos can do at the most: an arm that runs into something stalls [N m]."""

ARMATURE = (20.0, 20.0, 40.0, 10.0, 10.0, 8.0)
"""Inertia of the motors behind their gears [kg m^2]."""

ARM_INERTIA = (300.0, 300.0, 100.0, 12.0, 12.0, 9.0)
"""About what each axis moves, motor included: feed-forward of the acceleration [kg m^2]."""

_POINT = 1e-6
"""A capsule shorter than twice this is a sphere [m]."""

SOLID = {"contype": 1, "conaffinity": 2}
BODY = {"contype": 2, "conaffinity": 3}


def quaternion(rotation: Matrix3) -> list[float]:
    """The unit quaternion (w, x, y, z) of a rotation."""
    turned = np.zeros(4)
    mujoco.mju_mat2Quat(turned, np.array(rotation).ravel())
    return [float(value) for value in turned]


def add_solid(body: mujoco.MjsBody, shape: OrientedBox, friction: list[float]) -> mujoco.MjsGeom:
    """A box that stands still, in the frame of its body."""
    return body.add_geom(
        type=mujoco.mjtGeom.mjGEOM_BOX,
        size=[edge / 2 for edge in shape.size],
        pos=shape.pose.translation,
        quat=quaternion(shape.pose.rotation),
        friction=friction,
        **SOLID,
    )


def add_box(
    world: mujoco.MjsBody, name: str, case: Case, gap: float, friction: list[float]
) -> mujoco.MjsGeom:
    """A free box; its horizontal edges are shorter by `gap` [m]."""
    pose = case.shape.pose
    body = world.add_body(name=name, pos=pose.translation, quat=quaternion(pose.rotation))
    body.add_freejoint()
    length, width, height = case.shape.size
    return body.add_geom(
        name=name,
        type=mujoco.mjtGeom.mjGEOM_BOX,
        size=[(length - gap) / 2, (width - gap) / 2, height / 2],
        mass=case.mass,
        friction=friction,
        **BODY,
    )


def add_arm(spec: mujoco.MjSpec, robot: Robot, tool: Tool) -> None:
    """The arm, its servos, and the tool rigid on its flange; gravity on both is compensated."""
    parent = spec.worldbody
    base = parent.add_body(name=LINKS[0])
    _add_shapes(base, robot, 0)
    origins = robot.geometry.joint_origins
    parent = spec.worldbody
    for axis, name in enumerate(LINKS[1:], start=1):
        body = parent.add_body(name=name, pos=origins[axis - 1], gravcomp=1.0)
        body.add_joint(
            name=f"axis {axis}",
            type=mujoco.mjtJoint.mjJNT_HINGE,
            axis=JOINT_AXES[axis - 1],
            armature=ARMATURE[axis - 1],
        )
        _add_shapes(body, robot, axis)
        _add_servo(spec, axis)
        parent = body
    hand = parent.add_body(name="tool", pos=origins[6], gravcomp=1.0)
    hand.explicitinertial = True
    hand.mass = tool.mass
    hand.ipos = tool.centre_of_mass
    hand.inertia = [tool.mass * 0.02] * 3
    for prefix, shapes in (("unfolded", tool.shapes), ("folded", tool.folded_shapes)):
        for number, shape in enumerate(shapes):
            geom = add_solid(hand, shape, [0.5, 0.005, 0.0001])
            geom.name = f"{prefix} {number}"
            geom.mass = 0.0
            geom.contype, geom.conaffinity = BODY["contype"], BODY["conaffinity"]


def arm_exclusions() -> list[tuple[str, str]]:
    """Bodies of the arm that overlap by construction: neighbours, and the wrist with the tool."""
    near = [(a, b) for a, b in itertools.pairwise(LINKS)]
    near += list(itertools.pairwise(LINKS[::2])) + list(itertools.pairwise(LINKS[1::2]))
    return [*near, ("tool", "link_6"), ("tool", "link_5")]


def _add_servo(spec: mujoco.MjSpec, axis: int) -> None:
    servo = spec.add_actuator(
        name=f"servo {axis}", target=f"axis {axis}", trntype=mujoco.mjtTrn.mjTRN_JOINT
    )
    servo.gainprm[0] = 1.0
    servo.biastype = mujoco.mjtBias.mjBIAS_AFFINE
    servo.biasprm[1] = -ARM_STIFFNESS[axis - 1]
    servo.biasprm[2] = -ARM_DAMPING[axis - 1]
    servo.forcerange = (-ARM_TORQUE[axis - 1], ARM_TORQUE[axis - 1])


def _add_shapes(body: mujoco.MjsBody, robot: Robot, link: int) -> None:
    shapes = [shape for shape in robot.shapes if shape.link == link]
    volumes = [_volume(shape) for shape in shapes]
    mass = robot.link_masses[link]
    if not shapes:
        body.explicitinertial = True
        body.mass = mass
        body.inertia = [mass * 0.01] * 3
        return
    for number, (shape, volume) in enumerate(zip(shapes, volumes, strict=True)):
        start, end = np.array(shape.start), np.array(shape.end)
        half = float(np.linalg.norm(end - start)) / 2
        long = half > _POINT
        axis = np.zeros(4)
        mujoco.mju_quatZ2Vec(axis, (end - start) / (2 * half) if long else np.array([0.0, 0, 1]))
        body.add_geom(
            name=f"{LINKS[link]} {number}",
            type=mujoco.mjtGeom.mjGEOM_CAPSULE if long else mujoco.mjtGeom.mjGEOM_SPHERE,
            size=[shape.radius, half, 0],
            pos=(start + end) / 2,
            quat=axis,
            mass=mass * volume / sum(volumes),
            **BODY,
        )


def _volume(shape: Capsule) -> float:
    length = float(np.linalg.norm(np.array(shape.end) - np.array(shape.start)))
    return float(np.pi * shape.radius**2 * (length + 4 / 3 * shape.radius))
