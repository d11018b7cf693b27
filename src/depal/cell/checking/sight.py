"""What the cameras see of the pallet's front while the arm is parked."""

import itertools
import math
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from depal.cell.checking.posture import Array, Posture, posture
from depal.cell.checking.standing import LOAD_HEIGHT
from depal.domain import CameraMount, CellLayout, PalletStand
from depal.geometry import Blockers

Flags = npt.NDArray[np.bool_]

GRID = 0.05
"""Points on the pallet's front are so far apart [m]."""

_NEAR = 0.05
"""Nothing nearer to the lens hides anything: its own housing may stand there [m]."""


@dataclass(frozen=True, slots=True)
class Sight:
    """What one camera, or all of them together, see of the pallet's front.

    Attributes:
        camera: its name; "all" for all together.
        seen: share of the front up to the greatest height of a load.
        bands: share that is seen from one height above the floor to another: lower, upper [m].
        hidden_by: what stands before the rest, with shares of the front; "the picture's edge"
            where the picture ends.
        distance: from the lens to the middle of the front [m].
    """

    camera: str
    seen: float
    bands: tuple[tuple[float, float, float], ...]
    hidden_by: tuple[tuple[str, float], ...]
    distance: float


def check_sight(layout: CellLayout) -> tuple[Sight, ...]:
    """What each camera sees, and all of them together last.

    Args:
        layout: the cell.

    Returns:
        One sight per camera, then "all" where there are several.
    """
    points, heights = front_points(layout.pallet)
    arm = posture(layout.robot, layout.tool, layout.robot.parked)
    sights, union = [], np.zeros(len(points), dtype=bool)
    for camera in layout.cameras:
        hidden = _hidden(layout, camera, arm, points)
        seen = ~np.logical_or.reduce(list(hidden.values()))
        union |= seen
        middle = points.mean(axis=0)
        distance = float(np.linalg.norm(middle - camera.cell_from_camera.translation))
        reasons = {name: float(flags.mean()) for name, flags in hidden.items() if flags.any()}
        sights.append(_sight(camera.name, seen, heights, reasons, distance))
    if len(sights) > 1:
        nearest = min(sight.distance for sight in sights)
        sights.append(_sight("all", union, heights, {}, nearest))
    return tuple(sights)


def front_points(pallet: PalletStand, height: float = LOAD_HEIGHT) -> tuple[Array, Array]:
    """Points on the side of the load that faces the robot.

    Args:
        pallet: where it stands.
        height: of the highest load above the floor [m].

    Returns:
        The points in the cell frame, (n, 3) [m], and their heights above the floor, (n,) [m].
    """
    length, _, deck = pallet.size
    across, up = round(length / GRID), round((height - deck) / GRID)
    xs = (np.arange(across) + 0.5) * length / across
    zs = (np.arange(up) + 0.5) * (height - deck) / up
    grid = np.array([(x, 0.0, z) for z in zs for x in xs])
    turn = np.array(pallet.cell_from_pallet.rotation)
    points: Array = grid @ turn.T + np.array(pallet.cell_from_pallet.translation)
    return points, points[:, 2].copy()


def in_picture(camera: CameraMount, points: Array) -> Flags:
    """Which points lie within both pictures of a camera.

    Args:
        camera: the camera.
        points: (n, 3) [m], in the cell frame.
    """
    turn = np.array(camera.cell_from_camera.rotation)
    x, y, z = ((points - np.array(camera.cell_from_camera.translation)) @ turn).T
    high = math.tan(camera.vertical_view / 2)
    wide = high * min(w / h for w, h in (camera.colour_size, camera.depth_size))
    ahead: Flags = (z > _NEAR) & (np.abs(x) <= wide * z) & (np.abs(y) <= high * z)
    return ahead


def _hidden(
    layout: CellLayout, camera: CameraMount, arm: Posture, points: Array
) -> dict[str, Flags]:
    """For everything that may be in the way, which points it hides."""
    lens = np.array(camera.cell_from_camera.translation)
    way = points - lens
    start = lens + way * (_NEAR / np.linalg.norm(way, axis=1, keepdims=True))
    # A sight line ends just before the front.
    end = lens + way * 0.999
    hidden = {"the picture's edge": ~in_picture(camera, points)}
    capsules = np.column_stack((arm.starts, arm.ends, arm.radii))
    hidden["the parked arm"] = Blockers.of(arm.tool, capsules).between(start, end)
    for storage in layout.storages:
        panels = [panel.seen_from(storage.cell_from_storage) for panel in storage.panels]
        hidden[storage.id] = Blockers.of(panels).between(start, end)
    for number, box in enumerate(layout.fixtures, start=1):
        hidden[f"fixture {number}"] = Blockers.of([box]).between(start, end)
    return hidden


def _sight(
    name: str, seen: Flags, heights: Array, reasons: dict[str, float], distance: float
) -> Sight:
    edges = [0.0, 0.5, 1.0, 1.5, LOAD_HEIGHT]
    bands = []
    for low, high in itertools.pairwise(edges):
        inside = (heights >= low) & (heights < high)
        if inside.any():
            bands.append((low, high, float(seen[inside].mean())))
    ordered = sorted(reasons.items(), key=lambda item: (-item[1], item[0]))
    return Sight(name, float(seen.mean()), tuple(bands), tuple(ordered), distance)
