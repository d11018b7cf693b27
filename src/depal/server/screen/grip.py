"""How a held box hangs on the flange: as it stood when it was taken."""

import math
from dataclasses import dataclass

from depal.geometry import Vector3
from depal.server.cellstate import CellState, Solid
from depal.server.screen.posture import LinkPose, Turn


@dataclass(frozen=True, slots=True)
class Held:
    """A box in the gripper, in the flange's frame.

    Attributes:
        box: its name.
        size: along its own axes [m].
        origin: its centre [m].
        turn: its rotation, by rows.
    """

    box: str
    size: Vector3
    origin: Vector3
    turn: Turn


class Grip:
    """Remembers where boxes stood, for a state does not tell where a held one is."""

    def __init__(self) -> None:
        """Nothing was seen yet."""
        self._solids: dict[str, Solid] = {}
        self._held: Held | None = None

    def follow(self, state: CellState, flange: LinkPose) -> Held | None:
        """The box in the gripper; None where there is none, or nobody saw it being taken."""
        if state.held is None:
            self._held = None
        elif self._held is None or self._held.box != state.held:
            solid = self._solids.get(state.held)
            self._held = None if solid is None else held_of(state.held, solid, flange)
        self._solids = {line.box: line.solid for line in state.queue} | {
            name: solid for name, solid in self._solids.items() if name == state.held
        }
        return self._held


def held_of(box: str, solid: Solid, flange: LinkPose) -> Held:
    """A box as seen from the flange.

    Args:
        box: its name.
        solid: where it stands, in the cell frame.
        flange: where the flange is, in the cell frame.
    """
    away = tuple(c - o for c, o in zip(solid.centre, flange.origin, strict=True))
    c, s = math.cos(solid.yaw), math.sin(solid.yaw)
    axes = ((c, s, 0.0), (-s, c, 0.0), (0.0, 0.0, 1.0))
    columns = list(zip(*flange.turn, strict=True))
    origin = tuple(_dot(column, away) for column in columns)
    turn = tuple(tuple(_dot(column, axis) for axis in axes) for column in columns)
    return Held(box, solid.size, (origin[0], origin[1], origin[2]), turn)  # type: ignore[arg-type]


def _dot(a: "tuple[float, ...]", b: "tuple[float, ...]") -> float:
    return sum(x * y for x, y in zip(a, b, strict=True))
