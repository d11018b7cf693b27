"""From legs with corners to one smooth path: corners are rounded off as far as it is allowed.

A corner is cut by the cubic that leaves the one side and joins the other at the same distance, with
their rates; between straight joint lines it is a parabola. It is as long as a check of the rounded
corner allows, or else so short that nothing moves further than a bound; where neither can be had
the arm stops.
"""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from depal.geometry import kernel
from depal.motion.kinematics import link_frames
from depal.motion.timing.legs import Floats, Leg, Path, hermite, piece_end, piece_rate
from depal.motion.timing.splines import distinct, spline_rates

Clear = Callable[[Floats], bool]
"""Whether no row of (n, 6) configurations touches anything."""

REVERSAL = -0.9
"""Below this cosine between the sides of a corner the arm turns back, and stops [-]."""

SMOOTH = 1.0 - 1e-6
"""Above this cosine there is no corner [-]."""

PITCH = 0.012
"""A curve's points are thinned to about this distance, in time at full speed [s]."""

CHECKS = 0.01
"""A rounded corner is checked at points this far apart, in time at full speed [s]."""

ROOM = 0.49
"""A corner takes at most this share of what lies between it and the next one."""

TRIES = 7
"""So often a rounded corner is halved before the arm stops in it."""

AHEAD = 0.4
"""Deviations are those of the flange and of a point so far ahead of it [m]."""


@dataclass(slots=True)
class _Piece:
    """One cubic on its way to a path."""

    coefficients: Floats
    length: float
    leg: int
    room: float  # how much of it a corner may take at either end
    corner: bool  # whether there may be one at its end
    blend: bool = False

    def cut(self, start: float, end: float) -> None:
        """Keeps what lies between two parameters."""
        p0, t0 = piece_end(self.coefficients, start), piece_rate(self.coefficients, start)
        p1, t1 = piece_end(self.coefficients, end), piece_rate(self.coefficients, end)
        self.length = end - start
        self.coefficients = hermite(p0, t0, p1, t1, self.length)


@dataclass(frozen=True, slots=True, eq=False)
class Smoother:
    """How corners are rounded off.

    Attributes:
        speed: (6,) of the axes [rad/s]; distances are times at full speed.
        dims: (7,) of the arm's geometry [m].
        clear: checks a rounded corner between free joint lines; without it none is rounded further
            than its leg allows.
    """

    speed: Floats
    dims: Floats
    clear: Clear | None = None

    def path(self, legs: Sequence[Leg]) -> Path | None:
        """The path through all legs; None where nothing moves."""
        pieces: list[_Piece] = []
        for k, leg in enumerate(legs):
            last = pieces[-1] if pieces else None
            pieces += self._pieces(
                leg, k, piece_end(last.coefficients, last.length) if last else None
            )
        out: list[_Piece] = []
        stops, worst = [True], 0.0
        for k, piece in enumerate(pieces[:-1]):
            blend, off, stop = self._rounded(piece, pieces[k + 1], legs)
            worst = max(worst, off)
            out.append(piece)
            if blend is not None:
                out.append(blend)
                stops.append(False)
            stops.append(stop)
        if not pieces:
            return None
        out.append(pieces[-1])
        stops.append(True)
        return Path(
            np.stack([piece.coefficients for piece in out]),
            np.array([piece.length for piece in out]),
            _marks(out, len(legs)),
            np.array(stops),
            _speeds(out, legs),
            worst,
        )

    def _pieces(self, leg: Leg, number: int, start: Floats | None) -> list[_Piece]:
        """The pieces of a leg, from exactly where the one before ended."""
        rows, spans = np.empty(len(leg.points), np.int64), np.empty(len(leg.points))
        pitch = PITCH if leg.curve else 0.0
        count = distinct(leg.points, self.speed, pitch, rows, spans) - 1
        if not count:
            return []
        points, spans = leg.points[rows[: count + 1]], spans[:count]
        if start is not None:
            points[0] = start
        if leg.curve and count > 1:
            at = np.concatenate(((0.0,), np.cumsum(spans)))
            rates = spline_rates(at, points)
            left, right = rates[:-1], rates[1:]
        else:
            left = right = np.diff(points, axis=0) / spans[:, None]
        return [
            _Piece(
                hermite(points[k], left[k], points[k + 1], right[k], float(spans[k])),
                float(spans[k]),
                number,
                room=ROOM * float(spans[k]),
                corner=not leg.curve or k + 1 == count,
            )
            for k in range(count)
        ]

    def _rounded(
        self, before: _Piece, after: _Piece, legs: Sequence[Leg]
    ) -> tuple[_Piece | None, float, bool]:
        """The blend at the corner between two pieces, how far it goes, whether the arm stops."""
        if not before.corner:
            return None, 0.0, False
        corner = piece_end(before.coefficients, before.length)
        t0, t1 = piece_rate(before.coefficients, before.length), after.coefficients[1]
        cosine = float(t0 @ t1) / math.sqrt(float(t0 @ t0) * float(t1 @ t1))
        if cosine > SMOOTH and np.allclose(t0, t1, rtol=1e-3, atol=1e-6):
            return None, 0.0, False
        if cosine < REVERSAL:
            return None, 0.0, True
        checked = self.clear if before.leg == after.leg else None
        allowed = legs[before.leg].rounding
        size = min(before.room, after.room)
        for _ in range(TRIES if allowed > 0.0 else 0):
            blend = self._blend(before, after, size)
            if checked is not None:
                if checked(_sampled(blend, 2 * size)):
                    return self._joined(before, after, blend, size), 0.0, False
                size /= 2
                continue
            off = deviation(blend, size, corner, self.dims)
            if off <= allowed:
                return self._joined(before, after, blend, size), off, False
            size *= min(0.7, 0.98 * allowed / off)
        return None, 0.0, True

    def _blend(self, before: _Piece, after: _Piece, size: float) -> Floats:
        start = before.length - size
        return hermite(
            piece_end(before.coefficients, start),
            piece_rate(before.coefficients, start),
            piece_end(after.coefficients, size),
            piece_rate(after.coefficients, size),
            2 * size,
        )

    @staticmethod
    def _joined(before: _Piece, after: _Piece, blend: Floats, size: float) -> _Piece:
        before.cut(0.0, before.length - size)
        after.cut(size, after.length)
        return _Piece(blend, 2 * size, before.leg, 0.0, corner=False, blend=True)


def _marks(pieces: list[_Piece], legs: int) -> Floats:
    """The parameter where each leg starts, in the middle of its blend, and the end (legs + 1,)."""
    ends = np.cumsum([piece.length for piece in pieces])
    marks = np.full(legs + 1, ends[-1])
    marks[0] = 0.0
    for k in range(len(pieces) - 1, 0, -1):
        before = pieces[k - 1]
        middle = ends[k - 1] - (before.length / 2 if before.blend else 0.0)
        marks[before.leg + 1 : pieces[k].leg + 1] = middle
    return marks


def _speeds(pieces: list[_Piece], legs: Sequence[Leg]) -> Floats:
    """The greatest speed of the flange in each piece; a blend keeps that of both its sides."""
    own = np.array([legs[piece.leg].speed for piece in pieces])
    for k, piece in enumerate(pieces):
        if piece.blend:
            own[k] = min(own[k], own[k + 1])
    return own


@kernel
def deviation(blend: Floats, size: float, corner: Floats, dims: Floats) -> float:
    """How far the middle of a blend is from its corner: of the flange and of a point ahead [m]."""
    frames = np.empty((7, 3, 4))
    link_frames(corner, dims, frames)
    there = frames[6].copy()
    link_frames(piece_end(blend, size), dims, frames)
    near, far = 0.0, 0.0
    for row in range(3):
        shift = frames[6, row, 3] - there[row, 3]
        near += shift * shift
        shift += AHEAD * (frames[6, row, 0] - there[row, 0])
        far += shift * shift
    return math.sqrt(max(near, far))


def _sampled(blend: Floats, length: float) -> Floats:
    """Configurations along a blend, close enough for a check, (n, 6)."""
    u = np.linspace(0.0, length, max(3, math.ceil(length / CHECKS) + 1))[:, None]
    points: Floats = blend[0] + u * (blend[1] + u * (blend[2] + u * blend[3]))
    return points


__all__ = ["Clear", "Smoother"]
