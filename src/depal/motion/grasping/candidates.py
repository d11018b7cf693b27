"""The ways to hold one box, best first, and why there are none."""

import itertools

import numpy as np

from depal.domain import Approach, Grasp, Tool
from depal.domain.cup_group import CupGroup
from depal.geometry import OrientedBox, Vector3
from depal.motion.grasping.fitting import QUARTERS, RIM, Way, faces_of, plates_for, ways_on
from depal.motion.grasping.holding import G

ENOUGH = 0.95
"""A grasp that uses more than this share of what is counted on is not offered."""

AMPLE = 0.4
"""Below this share more cups, or a better place for them, are worth nothing."""

PER_DEMERIT = 0.12
"""A demerit weighs as much as this share of what is counted on."""

MOST = 24
"""So many grasps are offered at the most, half of them of one approach."""

EACH_ROLL = 2
"""So many of every roll come first: where one does not reach, another may."""


def grasps(
    box: OrientedBox,
    mass: float,
    tool: Tool,
    front: Vector3,
    without: frozenset[str] = frozenset(),
) -> tuple[Grasp, ...]:
    """Every useful way to hold a box, best first.

    Args:
        box: in the cell frame, standing upright.
        mass: of the box [kg].
        tool: the gripper.
        front: towards the robot, horizontal, in the cell frame.
        without: modules of the gripper that must not be used.

    Returns:
        Grasps whose suction holds the box still with the planner's safety; horizontal ones touch
        the side that faces `front`, vertical ones the top. Few cups, tight moments and turned
        tools come late.
    """
    found: list[tuple[float, int, Way]] = []
    for face in faces_of(box, front):
        for plate in plates_for(tool, face.approach, without):
            groups: dict[tuple[int, ...], CupGroup] = {}
            for way in ways_on(face, plate, tool):
                share = share_of(way, mass, tool, groups)
                if share <= ENOUGH:
                    found.append((max(share, AMPLE) + PER_DEMERIT * way.demerit, len(found), way))
    found.sort(key=lambda entry: entry[:2])
    return tuple(way.grasp() for way in _spread([way for _, _, way in found]))


def refusal(size: Vector3, mass: float, tool: Tool, payload: float) -> str:
    """Why a box cannot be held at all, in words; empty where it can.

    Args:
        size: of the box standing upright [m].
        mass: [kg].
        tool: the gripper.
        payload: what the flange may carry, tool included [kg].
    """
    if mass > payload - tool.mass:
        left = payload - tool.mass
        return f"{mass:g} kg is more than the arm carries beside its tool ({left:g} kg)"
    cup = 2 * (tool.suction.cup_radius + RIM)
    if sorted(size)[1] < cup:
        return f"no side is wide enough for a cup of {1000 * cup:.0f} mm with its rim"
    turned = (size, (size[1], size[0], size[2]))
    for one in turned:
        if grasps(OrientedBox.upright((0.0, 0.0, 0.0), one), mass, tool, (-1.0, 0.0, 0.0)):
            return ""
    return f"{mass:g} kg is more than the cups hold on its sides with safety {tool.safety:g}"


def _spread(ordered: list[Way]) -> list[Way]:
    """Of each approach the first of every roll, and of all others the first."""
    kept: set[int] = set()
    for approach in Approach:
        rows = [k for k, way in enumerate(ordered) if way.face.approach is approach]
        of_roll = [[k for k in rows if ordered[k].roll == roll][:EACH_ROLL] for roll in range(4)]
        first = set(itertools.chain.from_iterable(of_roll))
        more = [k for k in rows if k not in first]
        kept |= first | set(more[: MOST // 2 - len(first)])
    return [ordered[k] for k in sorted(kept)]


def share_of(way: Way, mass: float, tool: Tool, groups: dict[tuple[int, ...], CupGroup]) -> float:
    """`static_share` of a way, without making a grasp of it.

    Args:
        way: a plate on a face.
        mass: of the box [kg].
        tool: the gripper.
        groups: of this plate's cups that are known; new ones are added.
    """
    suction, plate = tool.suction, way.plate
    group = groups.get(way.rows)
    if group is None:
        cups = plate.centres[list(way.rows)]
        group = CupGroup.of(cups, suction.cup_radius, suction.friction)
        groups[way.rows] = group
    weight = mass * G
    c, s = QUARTERS[way.roll]
    if way.face.approach is Approach.VERTICAL:  # it hangs below the plate, whose x points down
        fx, fy, fz = weight, 0.0, 0.0
    else:  # it hangs beside the plate, whose axes are turned against up
        fx, fy, fz = 0.0, -s * weight, -c * weight
    du, dv = way.shift
    x, y, z = way.face.depth / 2, -c * du - s * dv, s * du - c * dv
    y, z = y - group.middle[0], z - group.middle[1]
    force = np.array([fx, fy, fz])
    moment = np.array([y * fz - z * fy, z * fx - x * fz, x * fy - y * fx])
    counted = suction.cup_force * len(way.rows) / tool.safety
    share, _ = group.load_share(force, moment, counted)
    return share
