"""What becomes of a pile that is let go: MuJoCo's word, with the simulated cell's contacts."""

from dataclasses import dataclass

import mujoco
import numpy as np
import numpy.typing as npt

from depal.geometry import Pose
from depal.selection.stability import TouchRule
from depal.simulation.model import GAP, STEP
from depal.simulation.parts import quaternion

Array = npt.NDArray[np.float64]

FALLEN = 0.01
"""A pile has fallen when a centre has moved so far; what stands settles by about 1 mm [m]."""

SECONDS = 3.0
"""A pile is watched for so long, or until it rests [s]."""

IMPRATIO = 10.0
"""MuJoCo's friction creeps; at its default of 1 leaning boxes walk some 10 mm/s."""

TOUCHING = TouchRule(rise=1e-6, gap=1e-6, narrow=1e-6, inset=0.002)
"""What touches in the study: known poses, but no case has edges as sharp as its numbers.

MuJoCo's boxes are narrower than they say, and their contacts give by some tenths of a millimetre.
"""

RESTS = 1e-4
"""A pile rests when no centre has moved by more than this from one look to the next [m]."""

LOOK = 0.25
"""From one look to the next [s]; a pile is not said to rest before the third."""


@dataclass(frozen=True, slots=True)
class Let:
    """What was seen.

    Attributes:
        fell: whether a box moved by more than FALLEN.
        moved: how far the box that moved farthest did [m].
    """

    fell: bool
    moved: float


def let_go(prisms: Array, masses: Array, friction: float = 0.5, deck: float = 0.0) -> Let:
    """Lets the boxes of a pile go, at rest, where they are.

    Args:
        prisms: (n, 8) the boxes.
        masses: (n,) [kg].
        friction: of every contact.
        deck: the height on which the pile stands [m].

    Returns:
        Whether it fell.
    """
    model = _model(prisms, masses, friction, deck)
    data = mujoco.MjData(model)
    moved, before = 0.0, prisms[:, :3]
    for look in range(round(SECONDS / LOOK)):
        mujoco.mj_step(model, data, nstep=round(LOOK / STEP))
        now = data.xpos[1:].copy()
        moved = float(np.abs(now - prisms[:, :3]).max(initial=0.0))
        rests = look > 1 and float(np.abs(now - before).max(initial=0.0)) < RESTS
        if moved > FALLEN or rests:
            break
        before = now
    return Let(moved > FALLEN, moved)


def _model(prisms: Array, masses: Array, friction: float, deck: float) -> mujoco.MjModel:
    spec = mujoco.MjSpec()
    spec.option.timestep = STEP
    spec.option.cone = mujoco.mjtCone.mjCONE_ELLIPTIC
    spec.option.integrator = mujoco.mjtIntegrator.mjINT_IMPLICITFAST
    spec.option.tolerance = 1e-6
    spec.option.iterations = 30
    spec.option.impratio = IMPRATIO
    mu = [friction, 0.005, 0.0001]
    plane = mujoco.mjtGeom.mjGEOM_PLANE
    geoms = [spec.worldbody.add_geom(type=plane, size=[0, 0, 1], pos=[0, 0, deck], friction=mu)]
    for prism, mass in zip(prisms.tolist(), masses.tolist(), strict=True):
        x, y, z, length, width, height, c, s = prism
        turned = Pose((x, y, z), ((c, -s, 0.0), (s, c, 0.0), (0.0, 0.0, 1.0)))
        body = spec.worldbody.add_body(pos=[x, y, z], quat=quaternion(turned.rotation))
        body.add_freejoint()
        size = [length - GAP / 2, width - GAP / 2, height]
        box = mujoco.mjtGeom.mjGEOM_BOX
        geoms.append(body.add_geom(type=box, size=size, mass=mass, friction=mu))
    for geom in geoms:  # as stiff as in the cell
        geom.solref[:2] = (0.01, 1.0)
        geom.solimp[:3] = (0.99, 0.999, 0.001)
    return spec.compile()
