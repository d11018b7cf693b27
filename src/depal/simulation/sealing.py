"""Which cups seal on which boxes."""

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from depal.domain import SuctionModule

Floats = npt.NDArray[np.float64]

DEEPEST = 0.05
"""No tool is pressed farther than this into a box [m]."""


@dataclass(frozen=True, slots=True, eq=False)
class Solids:
    """Poses and sizes of all boxes at one moment, in the cell frame.

    Attributes:
        centres: (n, 3) [m].
        rotations: (n, 3, 3) columns are the boxes' axes.
        halves: (n, 3) half edges [m].
    """

    centres: Floats
    rotations: Floats
    halves: Floats


def cups_in_cell(
    module: SuctionModule, cups: tuple[int, ...], centre: Floats, rotation: Floats
) -> tuple[Floats, Floats]:
    """Where cups of a module are.

    Args:
        module: on the tool.
        cups: indices into its cups.
        centre: of the flange, in the cell [m].
        rotation: `cell_from_flange`.

    Returns:
        Their centres (n, 3) [m], and the rotation `cell_from_face`, whose first column is the
        normal out of the face.
    """
    face = rotation @ np.array(module.flange_from_face.rotation)
    origin = centre + rotation @ np.array(module.flange_from_face.translation)
    chosen = np.array([module.cups[cup] for cup in cups]).reshape(-1, 2)
    return origin + chosen @ face[:, 1:].T, face


@dataclass(frozen=True, slots=True, eq=False)
class _Facing:
    """How cups stand before the one face of each box that looks at them most.

    Attributes:
        away: (n, b) how far it is from each cup, out of the tool [m].
        tilt: (b,) by how much the rim of a cup is nearer or farther than its middle [m].
        room: (n, b) how far inside of the face's outline each cup's middle is [m].
    """

    away: Floats
    tilt: Floats
    room: Floats


def _facing(points: Floats, normal: Floats, solids: Solids, radius: float) -> _Facing:
    along = np.einsum("bij,i->bj", solids.rotations, normal)
    axis = np.abs(along).argmax(axis=1)
    rows = np.arange(len(axis))
    facing = np.abs(along[rows, axis])
    outward = -np.sign(along[rows, axis])[:, None] * solids.rotations[rows, :, axis]
    middles = solids.centres + outward * solids.halves[rows, axis][:, None]
    away = ((middles[None] - points[:, None]) * outward[None]).sum(axis=2) / -facing
    tilt = np.sqrt(np.maximum(1.0 - facing**2, 0.0)) * radius
    hits = points[:, None] + away[:, :, None] * normal
    local = np.einsum("bij,nbi->nbj", solids.rotations, hits - solids.centres[None])
    room = solids.halves[None] - np.abs(local)
    room[:, rows, axis] = np.inf
    return _Facing(away, tilt, room.min(axis=2))


def sealed(
    points: Floats, normal: Floats, solids: Solids, radius: float, stroke: float
) -> npt.NDArray[np.int64]:
    """The box that each cup seals on.

    A cup seals on a box whose face reaches over its whole lip, nowhere farther from its plane
    than the bellows' stroke.

    Args:
        points: (n, 3) centres of the cups [m].
        normal: (3,) out of the tool.
        solids: the boxes.
        radius: of a cup [m].
        stroke: of the bellows [m].

    Returns:
        (n) the index of the box, -1 where a cup finds none.
    """
    facing = _facing(points, normal, solids, radius)
    near = np.abs(facing.away) + facing.tilt <= stroke
    fits = near & (facing.room >= radius)
    distance = np.where(fits, np.abs(facing.away), np.inf)
    return np.where(fits.any(axis=1), distance.argmin(axis=1), -1)


def pressed(points: Floats, normal: Floats, solids: Solids, radius: float, stroke: float) -> Floats:
    """How far the bellows of cups are pressed in, each by the box that does so most (n,) [m].

    Args:
        points: (n, 3) centres of the cups [m].
        normal: (3,) out of the tool.
        solids: the boxes.
        radius: of a cup [m].
        stroke: of the bellows [m].
    """
    facing = _facing(points, normal, solids, radius)
    deep = np.clip(stroke - facing.away, 0.0, 2 * stroke)
    # What lies deeper than a whole bellows is not before the cup: its face looks another way.
    before = (facing.room >= 0.0) & (facing.away > -DEEPEST)
    return np.asarray(np.where(before, deep, 0.0).max(axis=1, initial=0.0))
