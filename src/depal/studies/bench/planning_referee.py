"""The planner's shapes in MuJoCo, which says by itself what touches what."""

import math
from collections.abc import Iterable

import mujoco
import numpy as np
import numpy.typing as npt

from depal.domain import CellLayout
from depal.geometry import OrientedBox
from depal.simulation.parts import BODY, add_arm, add_solid, arm_exclusions

_FRICTION = [0.5, 0.005, 0.0001]


class Referee:
    """MuJoCo's collision detection over an arm, its hand and a scene."""

    def __init__(
        self,
        layout: CellLayout,
        scene: Iterable[OrientedBox],
        held: OrientedBox | None = None,
        *,
        folded: bool = False,
    ) -> None:
        """Compiles the model.

        Args:
            layout: the cell; its arm and tool are taken.
            scene: what stands around, in the cell frame.
            held: a held box in the flange's frame.
            folded: whether the lower module is hinged up.
        """
        spec = mujoco.MjSpec()
        spec.worldbody.add_geom(
            name="floor", type=mujoco.mjtGeom.mjGEOM_PLANE, size=[0, 0, 1], friction=_FRICTION
        )
        for solid in scene:
            add_solid(spec.worldbody, solid, _FRICTION)
        add_arm(spec, layout.robot, layout.tool)
        hand = spec.body("tool")
        apart = arm_exclusions()
        if held is not None:
            geom = add_solid(hand.add_body(name="held"), held, _FRICTION)
            geom.contype, geom.conaffinity = BODY["contype"], BODY["conaffinity"]
            apart += [("tool", "held"), ("link_6", "held"), ("link_5", "held")]
        for geom in hand.geoms:
            if geom.name.startswith("unfolded" if folded else "folded"):
                geom.contype = geom.conaffinity = 0
        for first, second in apart:
            spec.add_exclude(bodyname1=first, bodyname2=second)
        self._model = spec.compile()
        self._data = mujoco.MjData(self._model)
        self._axes = [self._model.joint(f"axis {axis}").qposadr[0] for axis in range(1, 7)]

    def keep_apart(self, distance: float) -> None:
        """Finds what comes within a distance [m] as well."""
        self._model.geom_margin[:] = distance

    def nearest(self, q: npt.NDArray[np.float64]) -> float:
        """The least distance of two things that was found [m], negative where they overlap."""
        self._data.qpos[self._axes] = q
        mujoco.mj_kinematics(self._model, self._data)
        mujoco.mj_collision(self._model, self._data)
        return float(self._data.contact.dist.min()) if self._data.ncon else math.inf
