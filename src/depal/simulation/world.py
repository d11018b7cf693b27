"""The simulated world: one MuJoCo model and its state, advanced as far as somebody asks."""

import math

import mujoco
import numpy as np
import numpy.typing as npt

from depal.domain import CellLayout, Joints, PlaceId
from depal.errors import DeviceError
from depal.geometry import Pose
from depal.motion.kinematics import Kinematics
from depal.ports import Watch
from depal.ports.trajectory import Trajectory
from depal.simulation.cases import Case
from depal.simulation.contacts import ContactWatch
from depal.simulation.holds import Broken
from depal.simulation.losses import LossWatch
from depal.simulation.model import PARKING, STEP, STRAY, build_model
from depal.simulation.pacing import paced
from depal.simulation.parts import (
    ARM_DAMPING,
    ARM_INERTIA,
    ARM_STIFFNESS,
    BODY,
    SOLID,
    quaternion,
)
from depal.simulation.servo import Motion, motion_along, stopped
from depal.simulation.snapshot import Snapshot
from depal.simulation.suction import TOUCH, SuctionState

Floats = npt.NDArray[np.float64]

RESTING = 2e-3
"""Nothing moves when no velocity of what is awake is above this [m/s, rad/s]."""

QUIET = 50
"""So many steps without a command or a movement, and the world stands still."""

SETTLING = 3000
"""The stack gets this many steps to come to rest at the most."""

CONTROL = 4
"""The arm's own controller looks at its sensors every so many steps."""

STRAY_ABOVE = 0.001
"""A stray carton stands so far above the floor of its compartment [m]."""

G = 9.81
LOAD_FILTER = 0.005
"""Time constant of the load cell [s]."""

_STIFFNESS, _DAMPING = np.array(ARM_STIFFNESS), np.array(ARM_DAMPING)
_INERTIA = np.array(ARM_INERTIA)


class World:
    """Everything physical, and the time up to which it has happened.

    Attributes:
        model: the MuJoCo model and its indices.
        data: its state.
        suction: valves, vacuum, welds.
        contacts: the watch for collisions.
        losses: the watch for boxes that suction loses.
        broken: holds that gave way, in order.
        removed: boxes that people took out of the cell.
        bays: the name of the trolley that stands in each bay, None where none does.
        stray: the place in which somebody has left a carton, None where nobody has.
        stray_pose: of that carton.
        steps: how many steps were computed; those in which all stood still were not.
        seen: the reason why the watch of the present motion has stopped it.
    """

    def __init__(
        self,
        layout: CellLayout,
        cases: tuple[Case, ...],
        seed: int = 0,
        start: float = 0.0,
        joints: Joints | None = None,
    ) -> None:
        """Builds the world and lets the stack settle.

        Args:
            layout: the cell.
            cases: the boxes with their poses.
            seed: of all randomness in this world.
            start: the time at the beginning [s].
            joints: where the arm stands; parked where nothing is said [rad].
        """
        self.layout, self.cases, self.seed = layout, cases, seed
        self.model = build_model(layout, cases)
        self.data = mujoco.MjData(self.model.mj)
        self.suction = SuctionState(self.model, self.data)
        self.contacts = ContactWatch(self.model, self.data)
        self.losses = LossWatch()
        self.broken: list[Broken] = []
        self.removed: list[int] = []
        self.bays: dict[str, str | None] = {storage.id: storage.id for storage in layout.storages}
        self.stray: PlaceId | None = None
        self.stray_pose: Pose | None = None
        self.steps = 0
        self.seen: str | None = None
        self.start = start
        self._tick = 0
        self._quiet = 0
        self._load = 0.0
        self._noise = np.random.default_rng([seed, 1])
        self._motion = motion_along(_standing(joints or layout.robot.parked), 0, STEP)
        self._watch, self._stopping = Watch(), False
        self._most = math.inf
        self._kinematics = Kinematics(layout.robot)
        self._show_fold()
        self._settle()

    @property
    def now(self) -> float:
        """The time up to which the world has gone on [s]."""
        return self.start + self._tick * STEP

    def advance(self, to: float) -> None:
        """Lets the world go on until a time [s]; a time that has passed changes nothing.

        Raises:
            DeviceError: the physics broke down: no reading is worth anything any more.
        """
        last = int((to - self.start) / STEP + 1e-6)
        if self.data.warning[mujoco.mjtWarning.mjWARN_BADQACC].number:
            raise DeviceError(f"the simulated physics broke down before {self.now:.3f} s")
        while self._tick < last:
            if self._quiet >= QUIET:
                self._tick = last
                self.losses.look(self.now, self._height)
                return
            self._step()

    def wake(self) -> None:
        """Something was done to the world: it does not stand still any more."""
        self._quiet = 0

    def begin(self, trajectory: Trajectory, watch: Watch | None = None) -> Motion:
        """The servos follow a trajectory from now on.

        Args:
            trajectory: the motion.
            watch: what it sees stops the motion in that control period, however late whoever
                commands it is told.
        """
        self.wake()
        self._motion = motion_along(trajectory, self._tick, STEP)
        self._watch, self.seen, self._stopping = watch or Watch(), None, False
        if math.isfinite(self._most):
            self._motion = self._paced()
        return self._motion

    def pace(self, most: float) -> Motion:
        """No point of the tool is faster than this from now on, in all motions [m/s].

        At 0 the arm comes to rest on its path, and goes on from there when it may.
        """
        if most != self._most:
            self._most = most
            if not self._stopping:
                self.wake()
                self._motion = self._paced()
        return self._motion

    def stop(self) -> Motion:
        """The arm comes to rest along its path; told twice, it does so once."""
        if not self._stopping:
            self._motion = stopped(self._motion, self._tick, STEP, self.layout.robot.limits)
            self._stopping = True
        return self._motion

    def ending(self, motion: Motion) -> float:
        """When a motion is at rest [s]."""
        return self.start + motion.last * STEP

    def _paced(self) -> Motion:
        limits = self.layout.robot.limits
        return paced(self._motion, self._tick, STEP, limits, self._most, self._tool_points)

    def _tool_points(self, joints: Floats) -> Floats:
        """(n, k, 3) where flange and modules are in configurations (n, 6), in the cell frame."""
        tool, folded = self.layout.tool, self.suction.folded
        faces = [tool.module(each.name, folded=folded).flange_from_face for each in tool.modules]
        tips = np.array([(0.0, 0.0, 0.0), *(face.translation for face in faces)])
        frames = np.array([self._kinematics.frames(row)[6] for row in joints])
        turned: Floats = np.einsum("nij,kj->nki", frames[:, :, :3], tips)
        return np.asarray(turned + frames[:, None, :, 3])

    def joints(self) -> Joints:
        """Where the axes are [rad]."""
        a, b, c, d, e, f = self.data.qpos[:6].tolist()
        return (a, b, c, d, e, f)

    def wanted(self) -> tuple[Floats, Floats]:
        """Where the servos want the axes now [rad] and how fast [rad/s]."""
        row = self._motion.row(self._tick)
        return self._motion.positions[row], self._motion.velocities[row]

    def load(self) -> float:
        """What the load cell reads, noise included [kg]; less where empty cups press on a box."""
        pushed = 0.0 if self.suction.holds else self.suction.push()
        return (self._load - pushed) / G + float(self._noise.normal(0.0, 0.01))

    def fold(self, *, up: bool) -> None:
        """Puts the lower module up or down."""
        self.suction.folded = up
        self._show_fold()
        self.wake()

    def flange(self) -> Pose:
        """`cell_from_flange`."""
        body = self.model.tool_body
        return Pose.from_arrays(self.data.xpos[body], self.data.xmat[body].reshape(3, 3))

    def box(self, index: int) -> Pose:
        """`cell_from_box`."""
        body = self.model.box_bodies[index]
        return Pose.from_arrays(self.data.xpos[body], self.data.xmat[body].reshape(3, 3))

    def place_box(self, index: int, pose: Pose) -> None:
        """Puts a box somewhere, at rest: the work of a person, or of a test."""
        self.suction.detach(index, self.now)
        address, dof = self.model.box_positions[index], self.model.box_dofs[index]
        quaternion = np.zeros(4)
        mujoco.mju_mat2Quat(quaternion, np.array(pose.rotation).ravel())
        self.data.qpos[address : address + 3] = pose.translation
        self.data.qpos[address + 3 : address + 7] = quaternion
        self.data.qvel[dof : dof + 6] = 0.0
        self.refresh()

    def show_storage(self, bay: str, *, trolley: str | None) -> None:
        """A trolley of that name comes to stand in a bay, or none does; a stray goes with it."""
        if self.stray is not None and self.stray.startswith(f"{bay}/"):
            self.leave_stray(None)
        self.bays[bay] = trolley
        geoms = self.model.storage_geoms[bay]
        there = trolley is not None
        self.model.mj.geom_contype[geoms] = SOLID["contype"] if there else 0
        self.model.mj.geom_conaffinity[geoms] = SOLID["conaffinity"] if there else 0
        self.refresh()

    def leave_stray(self, place: PlaceId | None, shift: float = 0.0) -> None:
        """Somebody leaves a carton in a compartment, or takes it out again.

        Args:
            place: in which; None for none.
            shift: how far behind the opening its front stands [m].
        """
        self.stray = place
        geom, there = self.model.stray_geom, place is not None
        self.model.mj.geom_contype[geom] = SOLID["contype"] if there else 0
        self.model.mj.geom_conaffinity[geom] = SOLID["conaffinity"] if there else 0
        self.stray_pose = None
        if place is not None:
            depth, _, height = STRAY
            at = Pose((shift + depth / 2, 0.0, height / 2 + STRAY_ABOVE))
            self.stray_pose = self.layout.places[place].cell_from_place @ at
        pose = self.stray_pose or Pose((*PARKING, 0.0))
        self.data.mocap_pos[0] = pose.translation
        self.data.mocap_quat[0] = quaternion(pose.rotation)
        self.refresh()

    def refresh(self) -> None:
        """Wakes every box and finds all poses again, after something was put elsewhere."""
        bodies = self.model.box_bodies
        self.data.xfrc_applied[bodies, 2] = TOUCH
        mujoco.mj_forward(self.model.mj, self.data)
        self.data.xfrc_applied[bodies, 2] = 0.0
        self.wake()

    def snapshot(self) -> Snapshot:
        """Where everything is now, as copies."""
        data, model = self.data, self.model
        base = model.mj.body("base").id
        arm = np.array([base, *model.arm_bodies, model.tool_body])
        return Snapshot(
            self.now,
            np.hstack((data.xpos[arm], data.xquat[arm])),
            np.hstack((data.xpos[model.box_bodies], data.xquat[model.box_bodies])),
            self.suction.folded,
            self.suction.held_boxes,
            tuple(self.removed),
            dict(self.bays),
        )

    def _step(self) -> None:
        row = self._motion.row(self._tick)
        control = _STIFFNESS * self._motion.positions[row] + _DAMPING * self._motion.velocities[row]
        self.data.ctrl[:] = control + _INERTIA * self._motion.accelerations[row]
        mujoco.mj_step(self.model.mj, self.data)
        self._tick += 1
        self.steps += 1
        if self.suction.let_go:
            self.data.xfrc_applied[self.model.box_bodies, 2] = 0.0
            self.suction.let_go = False
        if self.suction.holds:
            for broken in self.suction.after_step(self.now):
                self.broken.append(broken)
                self.losses.gave_way(broken, self._height(broken.box), self.contacts.touched)
        self.losses.look(self.now, self._height)
        self._load += (self.suction.lift - self._load) * STEP / LOAD_FILTER
        moving = self._tick <= self._motion.last
        free = moving and not self._motion.may_touch(self._tick)
        self.contacts.after_step(self._tick, self.now, self.suction.held_boxes, free=free)
        self._quiet = 0 if moving or self._stirs() else self._quiet + 1
        under_way = moving or not (self._motion.whole or self._stopping)
        if under_way and (self._tick - self._motion.first) % CONTROL == 0:
            self._look_out()

    def _look_out(self) -> None:
        """What the arm's own controller does in a control period."""
        if self._watch.idle or self.seen is not None:
            return
        self.seen = self._watch.reason(self.suction.vacuum(self.now), self.load)
        if self.seen is not None:
            self.stop()

    def _height(self, box: int) -> float:
        return float(self.data.xpos[self.model.box_bodies[box], 2])

    def _stirs(self) -> bool:
        """Whether anything but the arm and what it holds is awake, or any of it moves."""
        data, model = self.data, self.model
        awake = int(np.count_nonzero(data.tree_asleep < 0))
        if awake > 1 + len(self.suction.held_boxes):
            return True
        return bool(np.abs(data.qvel).max(initial=0.0) > RESTING) or bool(
            abs(self.suction.lift - self._load) > 0.05 * G and len(model.cases)
        )

    def _show_fold(self) -> None:
        """Lets only those solids of the tool collide that are there."""
        geoms = ((self.model.unfolded_geoms, False), (self.model.folded_geoms, True))
        for group, up in geoms:
            there = up == self.suction.folded
            self.model.mj.geom_contype[group] = BODY["contype"] if there else 0
            self.model.mj.geom_conaffinity[group] = BODY["conaffinity"] if there else 0

    def _settle(self) -> None:
        """Lets the stack come to rest before the time begins."""
        data = self.data
        data.qpos[:6] = self._motion.positions[-1]
        data.ctrl[:] = _STIFFNESS * data.qpos[:6]
        for _ in range(0, SETTLING, 10):
            mujoco.mj_step(self.model.mj, data, 10)
            if np.count_nonzero(data.tree_asleep < 0) <= 1:
                break
        data.qvel[:] = 0.0
        self.contacts.collisions.clear()


def _standing(joints: Joints) -> Trajectory:
    return Trajectory(np.zeros(1), np.array([joints]), np.zeros((1, 6)))
