"""Whether a configuration of the arm touches anything: the kernels.

The order of the tests is from cheap and likely to dear and rare: tool and held box first, then the
arm's capsules from the wrist down, the floor and the fence, and the arm against itself.
"""

import math
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from depal.geometry import kernel, loop_kernel
from depal.motion.collision.overlap import boxes_meet, segments_within, sphere_meets_box
from depal.motion.collision.values import Arm, Array, Solids
from depal.motion.kinematics import link_frames

FREE = -1
FLOOR = 100_000
FENCE = 100_001
TILT = 100_002
ITSELF = 200_000
"""What was hit is a scene's solid below FLOOR; ITSELF plus the capsule above."""

HAND = 1_000
"""Parts below are capsules of the arm, from here on solids of the hand."""


class Margins(NamedTuple):
    """How far things must stay apart.

    Attributes:
        arm: of the arm's links from everything [m].
        tool: of the tool's parts [m].
        held: of the held box from the cell's own solids [m].
        pile: of the held box from cases [m]; negative where it may rub along them.
        floor: of everything but the base from the floor and the fence [m].
    """

    arm: float = 0.02
    tool: float = 0.01
    held: float = 0.01
    pile: float = 0.01
    floor: float = 0.02


class Case(NamedTuple):
    """Everything a check needs, as arrays.

    Attributes:
        dims: (7,) of the arm's geometry [m].
        arm: its capsules.
        hand: solids in the flange's frame; the last one is held where `holding`.
        holding: whether a box is held.
        scene: what stands around, in the cell frame.
        apart: (n,) how far a held box stays from each of the scene's solids [m].
        fence: (4,) smallest x, y and greatest x, y that anything may reach [m].
        margins: how far things stay apart.
        up: (3,) the direction in the flange's frame that is to stay up.
        upright: the cosine of the greatest tilt that is allowed; below -1 any is.
    """

    dims: Array
    arm: Arm
    hand: Solids
    holding: bool
    scene: Solids
    apart: Array
    fence: Array
    margins: Margins
    up: Array
    upright: float


@loop_kernel
def _placed(frame: Array, point: Array, out: Array) -> None:
    for row in range(3):
        out[row] = (
            frame[row, 0] * point[0]
            + frame[row, 1] * point[1]
            + frame[row, 2] * point[2]
            + frame[row, 3]
        )


@loop_kernel
def _turned(frame: Array, rotation: Array, out: Array) -> None:
    for row in range(3):
        for column in range(3):
            out[row, column] = (
                frame[row, 0] * rotation[0, column]
                + frame[row, 1] * rotation[1, column]
                + frame[row, 2] * rotation[2, column]
            )


@loop_kernel
def place_solid(frame: Array, centre: Array, rotation: Array, out: Array) -> None:
    """A solid of the hand in the cell frame: (4, 3) its centre, then its rotation's rows."""
    _placed(frame, centre, out[0])
    _turned(frame, rotation, out[1:4])


@loop_kernel
def _hand_hits(case: Case, work: Array, hit: npt.NDArray[np.int64]) -> bool:
    """The hand against the scene, the floor and the fence; `work` holds its placed solids."""
    scene, margins, count = case.scene, case.margins, len(case.hand.centre)
    for part in range(count):
        centre, rotation, half = work[part, 0], work[part, 1:4], case.hand.half[part]
        held = case.holding and part == count - 1
        rx = abs(rotation[0, 0]) * half[0] + abs(rotation[0, 1]) * half[1]
        rx += abs(rotation[0, 2]) * half[2]
        ry = abs(rotation[1, 0]) * half[0] + abs(rotation[1, 1]) * half[1]
        ry += abs(rotation[1, 2]) * half[2]
        rz = abs(rotation[2, 0]) * half[0] + abs(rotation[2, 1]) * half[1]
        rz += abs(rotation[2, 2]) * half[2]
        hit[0] = HAND + part
        if centre[2] - rz < margins.floor:
            hit[1] = FLOOR
            return True
        if _outside(case.fence, margins.floor, centre[0], centre[1], rx, ry):
            hit[1] = FENCE
            return True
        for k in range(len(scene.centre)):
            m = case.apart[k] if held else margins.tool
            if (
                scene.low[k, 0] > centre[0] + rx + m
                or scene.high[k, 0] < centre[0] - rx - m
                or scene.low[k, 1] > centre[1] + ry + m
                or scene.high[k, 1] < centre[1] - ry - m
                or scene.low[k, 2] > centre[2] + rz + m
                or scene.high[k, 2] < centre[2] - rz - m
            ):
                continue
            if boxes_meet(
                centre, rotation, half, scene.centre[k], scene.rotation[k], scene.half[k], m
            ):
                hit[1] = k
                return True
    return False


@loop_kernel
def _outside(fence: Array, margin: float, x: float, y: float, rx: float, ry: float) -> bool:
    return bool(
        x - rx < fence[0] + margin
        or y - ry < fence[1] + margin
        or x + rx > fence[2] - margin
        or y + ry > fence[3] - margin
    )


@loop_kernel
def _arm_hits(case: Case, ends: Array, hit: npt.NDArray[np.int64]) -> bool:
    """The arm's capsules, the base excepted, against the scene, the floor and the fence."""
    scene, arm, margins = case.scene, case.arm, case.margins
    for back in range(len(arm.link)):
        c = len(arm.link) - 1 - back
        if arm.link[c] == 0:
            continue
        p, q = ends[c, 0], ends[c, 1]
        hit[0] = c
        reach = arm.radius[c] + margins.floor
        if min(p[2], q[2]) < reach:
            hit[1] = FLOOR
            return True
        mx, my = (p[0] + q[0]) / 2, (p[1] + q[1]) / 2
        wx, wy = abs(p[0] - q[0]) / 2, abs(p[1] - q[1]) / 2
        if _outside(case.fence, reach, mx, my, wx, wy):
            hit[1] = FENCE
            return True
        cover = arm.cover[c] + margins.arm
        lx, hx = min(p[0], q[0]) - cover, max(p[0], q[0]) + cover
        ly, hy = min(p[1], q[1]) - cover, max(p[1], q[1]) + cover
        lz, hz = min(p[2], q[2]) - cover, max(p[2], q[2]) + cover
        steps = arm.spheres[c] - 1
        for k in range(len(scene.centre)):
            if (
                scene.low[k, 0] > hx
                or scene.high[k, 0] < lx
                or scene.low[k, 1] > hy
                or scene.high[k, 1] < ly
                or scene.low[k, 2] > hz
                or scene.high[k, 2] < lz
            ):
                continue
            for step in range(steps + 1):
                u = step / steps if steps > 0 else 0.0
                x, y = p[0] + u * (q[0] - p[0]), p[1] + u * (q[1] - p[1])
                z = p[2] + u * (q[2] - p[2])
                if sphere_meets_box(
                    x, y, z, cover, scene.centre[k], scene.rotation[k], scene.half[k]
                ):
                    hit[1] = k
                    return True
    return False


@loop_kernel
def _itself_hits(case: Case, ends: Array, work: Array, hit: npt.NDArray[np.int64]) -> bool:
    """The hand against links 0 to 4, and the arm's links against each other."""
    arm, count = case.arm, len(case.hand.centre)
    for c in range(len(arm.link)):
        if arm.link[c] > 4:  # noqa: PLR2004 - the wrist is next to the hand
            continue
        p, q = ends[c, 0], ends[c, 1]
        steps = arm.spheres[c] - 1
        mx, my, mz = (p[0] + q[0]) / 2, (p[1] + q[1]) / 2, (p[2] + q[2]) / 2
        long = math.sqrt((p[0] - mx) ** 2 + (p[1] - my) ** 2 + (p[2] - mz) ** 2)
        for part in range(count):
            held = case.holding and part == count - 1
            margin = case.margins.held if held else case.margins.tool
            centre, rotation, half = work[part, 0], work[part, 1:4], case.hand.half[part]
            room = long + arm.cover[c] + margin + half[0] + half[1] + half[2]
            away = (centre[0] - mx) ** 2 + (centre[1] - my) ** 2 + (centre[2] - mz) ** 2
            if away > room * room:
                continue
            for step in range(steps + 1):
                u = step / steps if steps > 0 else 0.0
                x, y = p[0] + u * (q[0] - p[0]), p[1] + u * (q[1] - p[1])
                z = p[2] + u * (q[2] - p[2])
                if sphere_meets_box(x, y, z, arm.cover[c] + margin, centre, rotation, half):
                    hit[0], hit[1] = HAND + part, ITSELF + c
                    return True
    for k in range(len(arm.pairs)):
        upper, lower = arm.pairs[k, 0], arm.pairs[k, 1]
        room = arm.radius[upper] + arm.radius[lower] + case.margins.arm
        if segments_within(ends[lower, 0], ends[lower, 1], ends[upper, 0], ends[upper, 1], room):
            hit[0], hit[1] = upper, ITSELF + lower
            return True
    return False


@loop_kernel
def hits(
    case: Case, q: Array, frames: Array, ends: Array, work: Array, hit: npt.NDArray[np.int64]
) -> bool:
    """Whether a configuration touches anything.

    Args:
        case: the arm, the hand and the scene.
        q: (6,) [rad].
        frames: (7, 3, 4) scratch.
        ends: (m, 2, 3) scratch.
        work: (t, 4, 3) scratch.
        hit: (2,) receives the part and what it hit.
    """
    link_frames(q, case.dims, frames)
    if case.upright >= -1.0:
        f = frames[6]
        if f[2, 0] * case.up[0] + f[2, 1] * case.up[1] + f[2, 2] * case.up[2] < case.upright:
            hit[0], hit[1] = HAND, TILT
            return True
    for part in range(len(case.hand.centre)):
        place_solid(frames[6], case.hand.centre[part], case.hand.rotation[part], work[part])
    if _hand_hits(case, work, hit):
        return True
    for c in range(len(case.arm.link)):
        link = case.arm.link[c]
        if link == 0:
            for row in range(3):
                ends[c, 0, row] = case.arm.start[c, row]
                ends[c, 1, row] = case.arm.end[c, row]
        else:
            _placed(frames[link - 1], case.arm.start[c], ends[c, 0])
            _placed(frames[link - 1], case.arm.end[c], ends[c, 1])
    return _arm_hits(case, ends, hit) or _itself_hits(case, ends, work, hit)


@kernel
def first_hit(case: Case, q: Array) -> tuple[int, int]:
    """The part that touches something and what it touches; (FREE, FREE) where nothing does."""
    frames, ends = np.empty((7, 3, 4)), np.empty((len(case.arm.link), 2, 3))
    work, hit = np.empty((len(case.hand.centre), 4, 3)), np.zeros(2, np.int64)
    if hits(case, q, frames, ends, work, hit):
        return hit[0], hit[1]
    return FREE, FREE


@kernel
def first_hit_along(case: Case, path: Array) -> tuple[int, int, int]:
    """The first row of a path (n, 6) that touches something, the part, and what; or FREE."""
    frames, ends = np.empty((7, 3, 4)), np.empty((len(case.arm.link), 2, 3))
    work, hit = np.empty((len(case.hand.centre), 4, 3)), np.zeros(2, np.int64)
    for row in range(len(path)):
        if hits(case, path[row], frames, ends, work, hit):
            return row, hit[0], hit[1]
    return FREE, FREE, FREE


@kernel
def first_free_along(case: Case, path: Array) -> int:
    """The first row of a path (n, 6) that touches nothing; FREE where every row does."""
    frames, ends = np.empty((7, 3, 4)), np.empty((len(case.arm.link), 2, 3))
    work, hit = np.empty((len(case.hand.centre), 4, 3)), np.zeros(2, np.int64)
    for row in range(len(path)):
        if not hits(case, path[row], frames, ends, work, hit):
            return row
    return FREE
