"""The ways to take each box in this cell: what the tool needs clear, and where the arm reaches."""

from collections.abc import Callable, Iterable, Sequence

import numpy as np
import numpy.typing as npt

from depal.domain import Approach, CellLayout, Grasp, Perceived
from depal.geometry import PRISM_WIDTH, OrientedBox, Pose, Vector3, prisms_of
from depal.motion.kinematics import Kinematics
from depal.motion.moves.margins import BEFORE as APPROACH
from depal.motion.moves.margins import CLOSE
from depal.motion.moves.picking import into_face
from depal.selection import BlockingGraph
from depal.selection.access import (
    BEFORE,
    OVER,
    RESTS,
    Mask,
    Way,
    Ways,
    crowding,
    masks,
    standings,
)

Array = npt.NDArray[np.float64]
Codes = npt.NDArray[np.uint8]

FAR = 1.0
"""Along the way of an approach the tool's space is kept clear so far before the touch [m]."""

ALIGNED = 0.999
"""An axis whose cosine to an approach is above this lies along it."""


def ways_in_cell(
    graph: BlockingGraph,
    layout: CellLayout,
    kinematics: Kinematics,
    grasps_of: Callable[[Perceived], Iterable[Grasp]],
) -> tuple[Ways, Codes]:
    """The AND/OR graph of what is perceived, with the tool's clearance and the arm's reach.

    Args:
        graph: the boxes in the cell frame.
        layout: the cell.
        kinematics: of its arm.
        grasps_of: the ways to hold a box, with no regard to what stands around it.

    Returns:
        The ways over the graph's slots, and how boxes stand to each other (`standings`).
    """
    used = graph.used_slots
    tolerances = graph.tolerances
    codes = standings(graph.prisms, used, tolerances.overlap, tolerances.slack)
    over, front = masks(codes & OVER), masks(codes & (BEFORE | RESTS))
    by_boxes = {Approach.VERTICAL: over, Approach.HORIZONTAL: front}
    ways: list[Way] = []
    for slot in used.tolist():
        box = graph.at(slot)
        held = [grasp for grasp in grasps_of(box) if _reached(box, grasp, layout, kinematics)]
        crowds = _crowds(graph, box, held, layout)
        for grasp, crowd in zip(held, crowds, strict=True):
            blockers = (by_boxes[grasp.approach][slot] | crowd) & ~(1 << slot)
            ways.append(Way(slot, grasp.approach, blockers))
    return Ways.among(used.tolist(), ways), codes


def _reached(box: Perceived, grasp: Grasp, layout: CellLayout, kinematics: Kinematics) -> bool:
    """Whether the arm gets to the plane of touch and to where the straight approach begins."""
    touch = box.shape.pose @ grasp.box_from_flange
    inward = np.array(into_face(touch, grasp, layout))
    x, y, z = (np.array(touch.translation) - APPROACH * inward).tolist()
    begin = Pose((x, y, z), touch.rotation)
    return bool(len(kinematics.solve(touch)) and len(kinematics.solve(begin)))


def _crowds(
    graph: BlockingGraph, box: Perceived, held: Sequence[Grasp], layout: CellLayout
) -> list[Mask]:
    """Per grasp the boxes that stand where the tool has to go."""
    if not held:
        return []
    spaces = [tool_space(box.shape, grasp, layout) for grasp in held]
    swept = np.concatenate(spaces)
    inside = masks(crowding(graph.prisms, graph.used_slots, swept, 0.0))
    crowds, first = [], 0
    for space in spaces:
        found = 0
        for crowd in inside[first : first + len(space)]:
            found |= crowd
        crowds.append(found)
        first += len(space)
    return crowds


def tool_space(box: OrientedBox, grasp: Grasp, layout: CellLayout) -> Array:
    """What the tool sweeps on its straight way to a box, with its margin.

    Args:
        box: in the cell frame.
        grasp: how it is held.
        layout: the cell.

    Returns:
        (k, 8) upright prisms in the cell frame, one for each solid part of the tool.
    """
    touch = box.pose @ grasp.box_from_flange
    inward = into_face(touch, grasp, layout)
    tool = layout.tool
    shapes = tool.folded_shapes if grasp.folded else tool.shapes
    prisms = prisms_of(shape.seen_from(touch) for shape in shapes)
    prisms[:, 3:6] += CLOSE.tool
    for prism in prisms:
        _stretch(prism, inward)
    return prisms.reshape(-1, PRISM_WIDTH)


def _stretch(prism: Array, inward: Vector3) -> None:
    """Makes a prism reach FAR back along the way by which it comes."""
    c, s = prism[6], prism[7]
    axes = np.array([[c, s, 0.0], [-s, c, 0.0], [0.0, 0.0, 1.0]])
    back = -np.array(inward)
    for axis, half in zip(axes, range(3, 6), strict=True):
        along = float(axis @ back)
        if abs(along) > ALIGNED:
            prism[half] += FAR / 2
            prism[:3] += FAR / 2 * np.sign(along) * axis
