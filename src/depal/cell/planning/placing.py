"""How a held box would go into a place: turned, with the tool that comes in with it."""

import math

import numpy as np

from depal.cell.planning.plans import Load
from depal.domain import Tool
from depal.geometry import OrientedBox, Pose, Vector3
from depal.logistics.placing import Held, envelopes

WRIST = OrientedBox.upright((-0.25, 0.0, 0.0), (0.55, 0.30, 0.30))
"""What follows behind the flange: wrist and forearm, in the flange's frame [m]."""


def turn_into(load: Load) -> Pose:
    """`place_from_box` as far as it turns: the flange points straight into the place."""
    x, y, _ = np.array(load.grasp.box_from_flange.rotation)[:, 0].tolist()
    return Pose.from_yaw((0.0, 0.0, 0.0), -math.atan2(y, x))


def as_pushed_in(load: Load, turn: Pose, tool: Tool) -> Held:
    """The box along the place's axes, with the envelopes of tool and wrist."""
    size = extent(load.size, turn)
    parts = [*(tool.folded_shapes if load.grasp.folded else tool.shapes), WRIST]
    box_from_flange = load.grasp.box_from_flange
    solids = [part.seen_from(box_from_flange).seen_from(turn) for part in parts]
    return Held(size, load.mass, envelopes(solids, size))


def extent(size: Vector3, turn: Pose) -> Vector3:
    """Edges of a turned box along the axes that it is turned into [m]."""
    along = np.abs(np.array(turn.rotation)) @ np.array(size)
    depth, width, height = along.tolist()
    return (depth, width, height)
