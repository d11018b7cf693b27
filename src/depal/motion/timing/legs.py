"""What is to be timed: the legs of a motion, and the smooth path through them."""

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from depal.geometry import kernel, loop_kernel

Floats = npt.NDArray[np.float64]


@dataclass(frozen=True, slots=True, eq=False)
class Leg:
    """A part of a motion; it begins where the leg before ended.

    Attributes:
        points: (n, 6) [rad]: corners of straight joint lines, or configurations along a curve.
        curve: the points lie close together on one smooth curve, as those of a straight move.
        speed: of the flange at the most [m/s].
        touching: whether the held box may touch what it stands beside or on.
        rounding: how far the flange may leave the corner to the next leg, and unchecked corners
            within this one [m]; with 0 it stops there.
    """

    points: Floats
    curve: bool = False
    speed: float = float("inf")
    touching: bool = False
    rounding: float = 0.005


@dataclass(frozen=True, slots=True, eq=False)
class Path:
    """A path of cubic pieces; its parameter is a time at full joint speed [s].

    Attributes:
        pieces: (m, 4, 6) coefficients of powers of the parameter since the piece's start.
        lengths: (m,) of the pieces, in the parameter [s].
        marks: (legs + 1,) the parameter where each leg starts, and the end [s].
        stops: (m + 1,) where the arm has to come to rest: both ends, and corners left as they are.
        speeds: (m,) of the flange at the most [m/s].
        deviation: the greatest distance of the flange or of a point ahead of it from the corners
            that were rounded off unchecked [m].
    """

    pieces: Floats
    lengths: Floats
    marks: Floats
    stops: npt.NDArray[np.bool_]
    speeds: Floats
    deviation: float

    @property
    def end(self) -> Floats:
        """(6,) where it ends [rad]."""
        return piece_end(self.pieces[-1], float(self.lengths[-1]))

    def at(self, parameters: Floats) -> Floats:
        """Configurations at some parameters, (n, 6) [rad]."""
        starts = np.concatenate(((0.0,), np.cumsum(self.lengths)))
        row = np.clip(np.searchsorted(starts, parameters, side="right") - 1, 0, len(starts) - 2)
        u = (parameters - starts[row])[:, None]
        c = self.pieces[row]
        points: Floats = c[:, 0] + u * (c[:, 1] + u * (c[:, 2] + u * c[:, 3]))
        return points


@loop_kernel
def piece_at(piece: Floats, u: float, q: Floats, q1: Floats, q2: Floats) -> None:
    """A piece at a parameter since its start: (6,) value and both derivatives are written."""
    for axis in range(6):
        c1, c2, c3 = piece[1, axis], piece[2, axis], piece[3, axis]
        q[axis] = piece[0, axis] + u * (c1 + u * (c2 + u * c3))
        q1[axis] = c1 + u * (2 * c2 + 3 * u * c3)
        q2[axis] = 2 * c2 + 6 * u * c3


@kernel
def piece_end(piece: Floats, u: float) -> Floats:
    """The value of a piece at a parameter since its start, (6,) [rad]."""
    out = np.empty(6)
    for axis in range(6):
        c2, c3 = piece[2, axis], piece[3, axis]
        out[axis] = piece[0, axis] + u * (piece[1, axis] + u * (c2 + u * c3))
    return out


@kernel
def piece_rate(piece: Floats, u: float) -> Floats:
    """The derivative of a piece at a parameter since its start, (6,) [rad/s]."""
    out = np.empty(6)
    for axis in range(6):
        out[axis] = piece[1, axis] + u * (2 * piece[2, axis] + 3 * u * piece[3, axis])
    return out


@kernel
def hermite(p0: Floats, t0: Floats, p1: Floats, t1: Floats, length: float) -> Floats:
    """The cubic with these ends and end rates, (4, 6)."""
    out = np.empty((4, 6))
    for axis in range(6):
        mean = (p1[axis] - p0[axis]) / length
        out[0, axis], out[1, axis] = p0[axis], t0[axis]
        out[2, axis] = (3 * mean - 2 * t0[axis] - t1[axis]) / length
        out[3, axis] = (t0[axis] + t1[axis] - 2 * mean) / (length * length)
    return out
