"""The default cell's arm, random motions for it, and what a trajectory does, by differences."""

import numpy as np
import numpy.typing as npt
from hypothesis import strategies as st

from depal.cell.files import shipped_cell
from depal.domain import Approach, Grasp
from depal.geometry import OrientedBox, Pose, Vector3
from depal.motion.grasping import Holding, grasps
from depal.motion.kinematics import Kinematics
from depal.motion.timing import Leg
from depal.ports import Trajectory

Floats = npt.NDArray[np.float64]

CELL = shipped_cell("default")
ROBOT = CELL.robot
KINEMATICS = Kinematics(ROBOT)
SPEED = np.array(ROBOT.limits.speed)
ACCELERATION = np.array(ROBOT.limits.acceleration)
FRONT: Vector3 = (-1.0, 0.0, 0.0)
DOWN = np.array([0.0, 0.0, -9.81])

seeds = st.integers(0, 2**32 - 1)


def corners(seed: int, most: int = 5) -> Floats:
    """Corners of a random path within the limits, (n, 6) [rad]."""
    random = np.random.default_rng(seed)
    low, high = np.maximum(ROBOT.limits.lower, -1.5), np.minimum(ROBOT.limits.upper, 1.5)
    points: Floats = random.uniform(low, high, (random.integers(2, most + 1), 6))
    return points


def carried(seed: int, masses: tuple[float, float]) -> tuple[Leg, Holding] | None:
    """A straight joint line from a box on the pallet to where it stands upright elsewhere."""
    random = np.random.default_rng(seed)
    size = tuple(random.uniform(0.15, 0.4, 3).tolist())
    mass = float(random.uniform(*masses))
    y, z = random.uniform(-0.4, 0.4), random.uniform(0.5, 1.4)
    box = OrientedBox.upright((1.6, y, z), size)
    ways = grasps(box, mass, CELL.tool, FRONT)
    if not ways:
        return None
    grasp = ways[random.integers(len(ways))]
    starts = KINEMATICS.solve(box.pose @ grasp.box_from_flange)
    elsewhere = Pose.from_yaw(
        (random.uniform(-0.5, 1.0), 1.5, random.uniform(0.5, 1.4)), random.uniform(-1.0, 3.0)
    )
    if not len(starts):
        return None
    ends = KINEMATICS.solve(elsewhere @ grasp.box_from_flange, starts[0])
    if not len(ends):
        return None
    end = ends[np.argmin(np.abs(ends - starts[0]).max(axis=1))]
    line = Leg(np.stack((starts[0], end)), speed=2.5)
    return line, Holding.of(grasp, mass, CELL.tool, size=size)


def heavy(mass: float, approach: Approach) -> tuple[Grasp, Vector3]:
    """A grasp of a large box as if it weighed little, whatever it weighs."""
    size: Vector3 = (0.4, 0.4, 0.3)
    box = OrientedBox.upright((1.6, 0.0, 0.9), size)
    ways = grasps(box, min(mass, 1.0), CELL.tool, FRONT)
    return next(way for way in ways if way.approach is approach and len(way.cups) >= 6), size


def accelerations(trajectory: Trajectory) -> Floats:
    """At both ends of every span between samples, (2 n, 6) [rad/s^2]; cubics have no more."""
    h = np.diff(trajectory.times)[:, None]
    moved = np.diff(trajectory.positions, axis=0)
    first, last = trajectory.velocities[:-1], trajectory.velocities[1:]
    start = 6 * moved / h**2 - (4 * first + 2 * last) / h
    end = -6 * moved / h**2 + (2 * first + 4 * last) / h
    return np.concatenate((start, end))


def flange_speeds(trajectory: Trajectory) -> Floats:
    """Of the flange at every sample [m/s]."""
    rows = zip(trajectory.positions, trajectory.velocities, strict=True)
    return np.array([np.linalg.norm((KINEMATICS.jacobian(q) @ w)[:3]) for q, w in rows])


def flange_points(configurations: Floats) -> Floats:
    """Where the flange is, (n, 3) [m]."""
    return np.array([KINEMATICS.frames(q)[6, :, 3] for q in configurations])


def between(trajectory: Trajectory, count: int) -> Floats:
    """Configurations at even times, (count, 6) [rad]."""
    times = np.linspace(0.0, trajectory.duration, count)
    return np.array([trajectory.at(float(time))[0] for time in times])


def shares(
    trajectory: Trajectory, holding: Holding, safety: float | None = None, count: int = 100
) -> Floats:
    """How much of the suction a motion uses, from poses of the flange alone, by differences."""
    h = 1e-4
    out = []
    for time in np.linspace(2 * h, trajectory.duration - 2 * h, count):
        frames = [KINEMATICS.frames(trajectory.at(float(time + k * h))[0])[6] for k in (-1, 0, 1)]
        before, here, after = frames
        acceleration = (before[:, 3] - 2 * here[:, 3] + after[:, 3]) / h**2
        early, late = _spin(before, here) / h, _spin(here, after) / h
        turn = here[:, :3].T
        out.append(
            holding.share_in_motion(
                turn @ acceleration,
                turn @ ((late - early) / h),
                turn @ ((early + late) / 2),
                turn @ DOWN,
                safety,
            )
        )
    return np.array(out)


def _spin(before: Floats, after: Floats) -> Floats:
    turn = after[:, :3] @ before[:, :3].T
    return (
        np.array([turn[2, 1] - turn[1, 2], turn[0, 2] - turn[2, 0], turn[1, 0] - turn[0, 1]]) / 2.0
    )
