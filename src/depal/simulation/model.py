"""The cell's physical model: from a layout and a stack of cases to MuJoCo."""

from dataclasses import dataclass

import mujoco
import numpy as np
import numpy.typing as npt

from depal.domain import CellLayout, PalletStand
from depal.geometry import OrientedBox, Pose
from depal.simulation.cases import Case
from depal.simulation.parts import (
    add_arm,
    add_box,
    add_solid,
    arm_exclusions,
)

STEP = 0.002
"""One step of the physics [s]."""

WELDS = 6
"""How many welds between tool and boxes there are at most: one for each module and box."""

GAP = 0.0005
"""Boxes are narrower than they say by this, in both horizontal directions: cases that stand face
to face touch without jamming. Heights are true, so layers do not sink [m]."""

STRAY = (0.20, 0.40, 0.20)
"""A carton that somebody leaves where it does not belong [m]."""

PARKING = (40.0, 0.0)
"""Where things are put that people took away: far outside the cell [m]."""

Ints = npt.NDArray[np.int64]


@dataclass(frozen=True, slots=True, eq=False)
class CellModel:
    """A compiled model and where things are in it.

    Attributes:
        mj: the MuJoCo model; friction pairs and welds may be switched, sizes never change.
        layout: the cell.
        cases: the boxes, in the order of the stack.
        arm_dofs: the addresses of the six axes in velocities (and positions).
        arm_bodies: bodies of links 1 to 6.
        tool_body: the body of the tool, rigid on the flange.
        unfolded_geoms: the tool's solid parts with the lower module down.
        folded_geoms: the tool's solid parts with the lower module up.
        box_bodies: (n) bodies of the boxes.
        box_geoms: (n) their shapes.
        box_positions: (n) addresses of their poses in the positions.
        box_dofs: (n) addresses of their velocities.
        storage_geoms: the panels of each storage.
        floor_geom: the floor.
        stray_geom: a carton that somebody may leave in a compartment.
    """

    mj: mujoco.MjModel
    layout: CellLayout
    cases: tuple[Case, ...]
    arm_dofs: Ints
    arm_bodies: Ints
    tool_body: int
    unfolded_geoms: Ints
    folded_geoms: Ints
    box_bodies: Ints
    box_geoms: Ints
    box_positions: Ints
    box_dofs: Ints
    storage_geoms: dict[str, Ints]
    floor_geom: int
    stray_geom: int


def build_model(layout: CellLayout, cases: tuple[Case, ...], friction: float = 0.5) -> CellModel:
    """Builds and compiles the model.

    Args:
        layout: the cell.
        cases: the boxes with their poses in the cell frame.
        friction: between boxes and everything.

    Returns:
        The model with every joint at zero and every box where its case says.
    """
    spec = mujoco.MjSpec()
    _set_options(spec)
    world = spec.worldbody
    floor = world.add_geom(
        name="floor", type=mujoco.mjtGeom.mjGEOM_PLANE, size=[0, 0, 1], friction=_mu(friction)
    )
    _stiffen(floor)
    for part in pallet_parts(layout.pallet):
        _stiffen(add_solid(world, part, _mu(friction)))
    for fixture in layout.fixtures:
        _stiffen(add_solid(world, fixture, _mu(friction)))
    for storage in layout.storages:
        body = world.add_body(name=f"storage {storage.id}")
        for number, panel in enumerate(storage.panels):
            placed = panel.seen_from(storage.cell_from_storage)
            geom = add_solid(body, placed, _mu(friction))
            geom.name = f"{storage.id} {number}"
            _stiffen(geom)
    add_arm(spec, layout.robot, layout.tool)
    for number, case in enumerate(cases):
        _stiffen(add_box(world, f"box {number}", case, GAP, _mu(friction)))
    _add_stray(world, _mu(friction))
    for first, second in arm_exclusions():
        spec.add_exclude(bodyname1=first, bodyname2=second)
    for number in range(WELDS if cases else 0):
        _add_weld(spec, number)
    return _indexed(spec.compile(), layout, cases)


def pallet_parts(stand: PalletStand) -> tuple[OrientedBox, ...]:
    """The pallet as one solid block below its deck, in the cell frame."""
    length, width, height = stand.size
    block = OrientedBox(Pose((length / 2, width / 2, -height / 2)), stand.size)
    return (block.seen_from(stand.cell_from_pallet),)


def _mu(friction: float) -> list[float]:
    return [friction, 0.005, 0.0001]


def _set_options(spec: mujoco.MjSpec) -> None:
    option = spec.option
    option.timestep = STEP
    option.cone = mujoco.mjtCone.mjCONE_ELLIPTIC
    option.integrator = mujoco.mjtIntegrator.mjINT_IMPLICITFAST
    option.tolerance = 1e-6
    option.iterations = 30
    option.disableflags |= mujoco.mjtDisableBit.mjDSBL_AUTORESET
    option.enableflags |= mujoco.mjtEnableBit.mjENBL_SLEEP
    spec.compiler.autolimits = True


def _stiffen(geom: mujoco.MjsGeom) -> None:
    """Contacts that give 0.3 mm below the tallest stacks; softer ones let boxes walk."""
    geom.solref[:2] = (0.01, 1.0)
    geom.solimp[:3] = (0.99, 0.999, 0.001)


def _add_stray(world: mujoco.MjsBody, friction: list[float]) -> None:
    """Outside and untouchable until somebody leaves it in a compartment."""
    body = world.add_body(name="stray", mocap=True, pos=(*PARKING, 0.0))
    geom = add_solid(body, OrientedBox(Pose((0.0, 0.0, 0.0)), STRAY), friction)
    geom.name = "stray"
    _stiffen(geom)


def _add_weld(spec: mujoco.MjSpec, number: int) -> None:
    weld = spec.add_equality(
        name=f"weld {number}",
        type=mujoco.mjtEq.mjEQ_WELD,
        objtype=mujoco.mjtObj.mjOBJ_BODY,
        name1="tool",
        name2="box 0",
        active=False,
    )
    weld.data[10] = 1.0


def _indexed(model: mujoco.MjModel, layout: CellLayout, cases: tuple[Case, ...]) -> CellModel:
    # Compiled as something solid: what is not would never be looked at for contacts again.
    stray = model.geom("stray").id
    model.geom_contype[stray] = model.geom_conaffinity[stray] = 0

    def geoms(prefix: str) -> Ints:
        found = [g for g in range(model.ngeom) if model.geom(g).name.startswith(prefix)]
        return np.array(found, dtype=np.int64)

    boxes = [model.body(f"box {number}").id for number in range(len(cases))]
    joints = [model.body_jntadr[body] for body in boxes]
    arm = [model.joint(f"axis {axis}").id for axis in range(1, 7)]
    return CellModel(
        mj=model,
        layout=layout,
        cases=cases,
        arm_dofs=_ints([model.jnt_dofadr[joint] for joint in arm]),
        arm_bodies=_ints([model.body(f"link_{axis}").id for axis in range(1, 7)]),
        tool_body=model.body("tool").id,
        unfolded_geoms=geoms("unfolded"),
        folded_geoms=geoms("folded"),
        box_bodies=_ints(boxes),
        box_geoms=_ints([model.body_geomadr[body] for body in boxes]),
        box_positions=_ints([model.jnt_qposadr[joint] for joint in joints]),
        box_dofs=_ints([model.jnt_dofadr[joint] for joint in joints]),
        storage_geoms={storage.id: geoms(f"{storage.id} ") for storage in layout.storages},
        floor_geom=model.geom("floor").id,
        stray_geom=stray,
    )


def _ints(values: list[int]) -> Ints:
    return np.array(values, dtype=np.int64)
