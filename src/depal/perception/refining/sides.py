"""Lays the four sides of a face onto the edges that a patch shows, each by itself."""

import math
from dataclasses import dataclass, replace
from typing import Self

import cv2
import numpy as np
import numpy.typing as npt

from depal.perception.recognition.patches import Patch
from depal.perception.refining import kernels
from depal.perception.refining.belief import HEIGHT, STATES, TURN, WIDTH, Belief, flow, told

Floats = npt.NDArray[np.float64]
Narrow = npt.NDArray[np.float32]

REACH = 0.010
"""A side is looked for so far on either side of where it is thought to be [m]."""

SHIFTS = 41
"""So many shifts within plus and minus that are tried."""

LIKELY = 0.002
"""Beside what is believed of them, two sides are off by so much, as a standard deviation [m]."""

NEAR = 0.002
"""A side is so near to where it and its opposite agree best, as a standard deviation [m]."""

SLANT = math.radians(3.5)
SLANTS = 29
"""So many turns within plus and minus that are tried [rad]."""

USUAL = math.radians(0.3)
"""Beside what is believed of it, a side is turned by so much, as a standard deviation [rad]."""

THIN = 2
"""Along a side every so manieth pixel is looked at."""

SEEMED = 0.005
"""A face's width and height, as found on a raster, are off by so much [m]."""

NOISE = 0.012
"""Steps of log brightness or colour along a whole side that mean nothing."""

SHARP = 3.0
"""An edge that stands out twice as much is so many powers of two as likely."""

EXACT, VAGUE = 0.0016, 0.008
"""A side that stands out is found so exactly, and one that does not, as deviations [m]."""

STRAIGHT, BENT = math.radians(0.35), math.radians(2.0)
"""The same for its turn [rad]."""


@dataclass(frozen=True, slots=True)
class Side:
    """A side that was found.

    Attributes:
        away: from where it was thought to be, towards + u or + v [m].
        slant: by how much it is off for each metre along + v or + u [rad].
        clear: how much it stands out, in [0, 1].
    """

    away: float
    slant: float
    clear: float


@dataclass(frozen=True, slots=True, eq=False)
class Sides:
    """What lies along the four sides of a face.

    Attributes:
        strengths: of the left, upper, right and lower side: (slants, across) how much an edge
            stands out there.
        rows: (8, 7) how the sides' places, then their slants, change with the face's errors.
        step: between places across [m].
        middles: how far the middle place is from where each side was thought to be [m].
    """

    strengths: tuple[Floats, ...]
    rows: Floats
    step: float
    middles: tuple[float, ...]

    @classmethod
    def of(cls, patch: Patch) -> Self:
        """Of a face that is laid flat, with a margin, seen by a camera."""
        tones, slants = _tones(patch), np.linspace(-SLANT, SLANT, SLANTS)
        strengths = tuple(_strengths(*_strip(tones, patch, k), slants) for k in range(4))
        middles = tuple(_middle(patch, k) for k in range(4))
        return cls(strengths, rows_of(patch), patch.step, middles)

    def told(self, before: Belief) -> Belief:
        """What the edges say about where a face is, of which something is believed."""
        lying, spread = self._turned(before), before.covariance
        values, sigmas = np.zeros(8), np.zeros(8)
        for first, last in ((0, 2), (1, 3)):
            between = self.rows[first] - self.rows[last]
            apart = math.sqrt(max(float(between @ spread @ between), 0.0))
            shift, _ = _agreed(lying[first], lying[last], apart)
            for k in (first, last):
                side = lying[k].found(shift, apart)
                values[k], values[k + 4] = side.away, side.slant
                sigmas[k] = VAGUE + (EXACT - VAGUE) * side.clear
                sigmas[k + 4] = BENT + (STRAIGHT - BENT) * side.clear
        return told(self.rows, values, sigmas)

    def grown(self, before: Belief, sizes: Floats) -> int:
        """Which of several sizes the edges suit best.

        Args:
            before: what is believed of the face.
            sizes: (n, 2) by how much wider and higher than thought [m].

        Returns:
            The index.
        """
        lying = self._turned(before)
        totals = -0.5 * ((sizes / SEEMED) ** 2).sum(axis=1)
        for axis, (first, last) in enumerate(((0, 2), (1, 3))):
            for n, more in enumerate((sizes[:, axis] / 2).tolist()):
                one, two = lying[first].shifted(-more), lying[last].shifted(more)
                totals[n] += _agreed(one, two, 0.0)[1]
        return int(totals.argmax())

    def _turned(self, before: Belief) -> list["Lying"]:
        """The sides, turned so that all four stand out most."""
        expected, spread = self.rows @ before.mean, before.covariance
        sigma = np.sqrt(np.maximum(np.einsum("ij,jk,ik->i", self.rows, spread, self.rows), 0.0))
        turned = math.sqrt(float(spread[TURN, TURN]))
        still = np.sqrt(np.maximum(sigma[4:] ** 2 - (self.rows[4:, TURN] * turned) ** 2, 0.0))
        lying = [
            Lying(
                strength,
                self.step,
                self.middles[k],
                (float(expected[k]), float(sigma[k])),
                (float(expected[k + 4]), math.hypot(float(still[k]), USUAL)),
            )
            for k, strength in enumerate(self.strengths)
        ]
        turns = np.linspace(-SLANT, SLANT, SLANTS)
        total = -0.5 * (turns / turned) ** 2
        for side, way in zip(lying, self.rows[4:, TURN], strict=True):
            total = total + np.interp(side.slant[0] + way * turns, turns, side.standing)
        turn = float(turns[int(total.argmax())])
        return [
            replace(side, slant=(side.slant[0] + float(way) * turn, side.slant[1]))
            for side, way in zip(lying, self.rows[4:, TURN], strict=True)
        ]


def rows_of(patch: Patch) -> Floats:
    """(8, 7) how the sides' places and slants change with the face's errors.

    First the places of the left, upper, right and lower side, then their slants.
    """
    if patch.eye is None:
        raise ValueError("a patch that no camera has seen")
    w, h = patch.size
    middles = np.array([(-w / 2, 0.0), (0.0, -h / 2), (w / 2, 0.0), (0.0, h / 2)])
    along = np.array([(0.0, 0.1 * h), (0.1 * w, 0.0), (0.0, 0.1 * h), (0.1 * w, 0.0)])
    across = np.array([0, 1, 0, 1])
    each = np.arange(4)
    at, one, two = (
        flow(points[:, 0], points[:, 1], patch.eye)[each, across]
        for points in (middles, middles - along, middles + along)
    )
    slants = (two - one) / (2 * np.linalg.norm(along, axis=1))[:, None]
    at[:, WIDTH] = (-0.5, 0.0, 0.5, 0.0)
    at[:, HEIGHT] = (0.0, -0.5, 0.0, 0.5)
    out = np.zeros((8, STATES))
    out[:4], out[4:] = at, slants
    return out


@dataclass(frozen=True, slots=True, eq=False)
class Lying:
    """A side that is looked for.

    Attributes:
        strength: (slants, across) how much an edge stands out there.
        step: between places across [m].
        middle: how far the middle one is from where the side was thought to be [m].
        place: where it is likely to be, from where it was thought to be: mean, deviation [m].
        slant: the same for its slant [rad].
    """

    strength: Floats
    step: float
    middle: float
    place: tuple[float, float]
    slant: tuple[float, float]

    @property
    def away(self) -> Floats:
        """(across,) the places [m]."""
        around = self.strength.shape[1] // 2
        return np.asarray((np.arange(2 * around + 1) - around) * self.step + self.middle)

    @property
    def _weighted(self) -> Floats:
        """(slants, across) the strength, less where the slant is not likely."""
        slants = np.linspace(-SLANT, SLANT, SLANTS)
        mean, sigma = self.slant
        likely = np.exp(-0.5 / SHARP * ((slants - mean) / sigma) ** 2)
        return np.asarray(self.strength * likely[:, None])

    @property
    def standing(self) -> Floats:
        """(slants,) how much speaks for each slant."""
        mean, sigma = self.place
        likely = np.exp(-0.5 * ((self.away - mean) / math.hypot(sigma, LIKELY)) ** 2)
        return np.asarray(SHARP * np.log1p((self.strength * likely).max(axis=1) / NOISE))

    @property
    def profile(self) -> Floats:
        """(across,) how much speaks for each place."""
        return np.asarray(np.log1p(self._weighted.max(axis=0) / NOISE))

    def shifted(self, more: float) -> "Lying":
        """The same side where it is likely to be farther towards + u or + v [m]."""
        return replace(self, place=(self.place[0] + more, self.place[1]))

    def found(self, shift: float, apart: float) -> Side:
        """Where it stands out most.

        Args:
            shift: both sides are off by so much from where they are likely to be [m].
            apart: how far from that one of them may be, as a standard deviation [m].
        """
        value = self._weighted
        sigma = math.hypot(NEAR, apart)
        away = (self.away - self.place[0] - shift) / sigma
        value = value * np.exp(-0.5 / SHARP * away**2)
        row, column = (int(each) for each in np.unravel_index(int(value.argmax()), value.shape))
        stands_out = float(self.strength[row, column])
        slants = np.linspace(-SLANT, SLANT, SLANTS)
        return Side(
            float(self.away[column] + _vertex(self.strength[row], column) * self.step),
            float(slants[row] + _vertex(self.strength[:, column], row) * (slants[1] - slants[0])),
            stands_out / (stands_out + NOISE),
        )


def _agreed(first: Lying, last: Lying, apart: float) -> tuple[float, float]:
    """By how much two opposite sides are off, both alike, from where they are likely to be.

    Beside a box there is often a gap, or a neighbour's print: only one place suits both sides.

    Returns:
        How much [m], and the logarithm of how much speaks for it.
    """
    sigma = math.hypot(min(first.place[1], last.place[1]), LIKELY)
    shifts = np.linspace(-REACH, REACH, SHIFTS)
    total = -0.5 * (shifts / sigma) ** 2
    wide = math.hypot(apart, NEAR / 2) / first.step
    for side in (first, last):
        profile = np.asarray(cv2.GaussianBlur(side.profile[None, :], (0, 0), wide))[0]
        total = total + np.interp(shifts + side.place[0], side.away, profile)
    best = int(total.argmax())
    return float(shifts[best]), float(total[best])


def _tones(patch: Patch) -> Narrow:
    """(h, w, 3) log brightness and two log ratios of colours."""
    logs = np.log(cv2.GaussianBlur(patch.colour.astype(np.float32), (0, 0), 0.8) + 6.0)
    r, g, b = np.moveaxis(logs, 2, 0)
    return np.dstack(((r + g + b) / 3, (r - g) * 0.7, (b - g) * 0.7)).astype(np.float32)


def _strip(tones: Narrow, patch: Patch, side: int) -> tuple[Narrow, npt.NDArray[np.bool_]]:
    """What lies along a side (0 left, 1 top, 2 right, 3 lower): along, across towards + u or v."""
    known = patch.known
    if side % 2 == 1:
        tones, known = tones.swapaxes(0, 1), known.T
    reach = round(REACH / patch.step)
    width = tones.shape[1]
    edge = patch.margin / patch.step
    at = _pixel(patch, side)
    first, last = max(at - reach, 0), min(at + reach + 1, width)
    inner = slice(round(edge), tones.shape[0] - round(edge))
    pad = (reach - (at - first), reach - (last - 1 - at))
    strip = np.pad(tones[inner, first:last], ((0, 0), pad, (0, 0)), mode="edge")
    seen = np.pad(known[inner, first:last], ((0, 0), pad), constant_values=False)
    return np.ascontiguousarray(strip), np.ascontiguousarray(seen)


def _pixel(patch: Patch, side: int) -> int:
    """The column, or row, that is the middle of a side's strip."""
    edge = round(patch.margin / patch.step)
    return edge if side < 2 else int(patch.known.shape[1 - side % 2]) - 1 - edge  # noqa: PLR2004


def _middle(patch: Patch, side: int) -> float:
    """How far that pixel is from where the side was thought to be, towards + u or + v [m]."""
    half = (int(patch.known.shape[1 - side % 2]) - 1) / 2
    out = -1.0 if side < 2 else 1.0  # noqa: PLR2004
    return (_pixel(patch, side) - half) * patch.step - out * patch.size[side % 2] / 2


def _strengths(strip: Narrow, known: npt.NDArray[np.bool_], slants: Floats) -> Floats:
    """(slants, across) how much an edge, or a line, stands out there."""
    means = np.zeros((len(slants), strip.shape[1], strip.shape[2]))
    thin = np.ascontiguousarray(strip[::THIN])
    kernels.profiles(thin, np.ascontiguousarray(known[::THIN]), np.tan(slants) * THIN, means)
    step = np.zeros(means.shape)
    line = np.zeros(means.shape)
    step[:, 1:-1] = (means[:, 2:] - means[:, :-2]) / 2
    line[:, 2:-2] = means[:, 2:-2] - (means[:, 4:] + means[:, :-4]) / 2
    best = np.maximum(np.abs(step), 0.7 * np.abs(line))
    return np.asarray(np.nan_to_num(best).max(axis=2))


def _vertex(values: Floats, at: int) -> float:
    """Where a parabola through a maximum and its neighbours is highest, in steps from it."""
    if at in {0, len(values) - 1}:
        return 0.0
    before, here, after = (float(values[at + k]) for k in (-1, 0, 1))
    bend = before - 2 * here + after
    return 0.0 if bend >= 0.0 else float(np.clip((before - after) / (2 * bend), -0.5, 0.5))
