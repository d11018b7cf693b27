"""Lays the four sides of a face onto the edges that a patch shows, each by itself."""

import math
from dataclasses import dataclass

import cv2
import numpy as np
import numpy.typing as npt

from depal.perception.recognition.patches import Patch
from depal.perception.refining import kernels
from depal.perception.refining.belief import HEIGHT, STATES, WIDTH, Belief, flow, told

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

SLANT = math.radians(2.5)
SLANTS = 21
"""So many turns within plus and minus that are tried [rad]."""

USUAL = math.radians(0.5)
"""Beside what is believed of it, a side is turned by so much, as a standard deviation [rad]."""

NOISE = 0.012
"""Steps of log brightness or colour along a whole side that mean nothing."""

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


def by_sides(patch: Patch, before: Belief) -> Belief:
    """What the edges say about where a face is.

    Args:
        patch: the face, laid flat, with a margin; seen by a camera.
        before: what is believed of it.
    """
    rows = rows_of(patch)
    spread = before.covariance
    expected, variances = rows @ before.mean, np.einsum("ij,jk,ik->i", rows, spread, rows)
    sigma = np.sqrt(np.maximum(variances, 0.0))
    tones, slants = _tones(patch), np.linspace(-SLANT, SLANT, SLANTS)
    lying = [
        Lying(
            _strengths(*_strip(tones, patch, k), slants),
            patch.step,
            (float(expected[k]), float(sigma[k])),
            (float(expected[k + 4]), math.hypot(float(sigma[k + 4]), USUAL)),
        )
        for k in range(4)
    ]
    values, sigmas = np.zeros(8), np.zeros(8)
    for first, last in ((0, 2), (1, 3)):
        between = rows[first] - rows[last]
        apart = math.sqrt(max(float(between @ spread @ between), 0.0))
        shift = _agreed(lying[first], lying[last], apart)
        for k in (first, last):
            side = lying[k].found(shift, apart)
            values[k], values[k + 4] = side.away, side.slant
            sigmas[k] = VAGUE + (EXACT - VAGUE) * side.clear
            sigmas[k + 4] = BENT + (STRAIGHT - BENT) * side.clear
    return told(rows, values, sigmas)


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
        place: where it is likely to be, from where it was thought to be: mean, deviation [m].
        slant: the same for its slant [rad].
    """

    strength: Floats
    step: float
    place: tuple[float, float]
    slant: tuple[float, float]

    @property
    def away(self) -> Floats:
        """(across,) the places [m]."""
        around = self.strength.shape[1] // 2
        return np.asarray((np.arange(2 * around + 1) - around) * self.step)

    @property
    def _weighted(self) -> Floats:
        """(slants, across) the strength, less where the slant is not likely."""
        slants = np.linspace(-SLANT, SLANT, SLANTS)
        mean, sigma = self.slant
        return np.asarray(self.strength * np.exp(-0.5 * ((slants - mean) / sigma) ** 2)[:, None])

    @property
    def profile(self) -> Floats:
        """(across,) how much speaks for each place."""
        return np.asarray(np.log1p(self._weighted.max(axis=0) / NOISE))

    def found(self, shift: float, apart: float) -> Side:
        """Where it stands out most.

        Args:
            shift: both sides are off by so much from where they are likely to be [m].
            apart: how far from that one of them may be, as a standard deviation [m].
        """
        value = self._weighted
        sigma = math.hypot(NEAR, apart)
        value = value * np.exp(-0.5 * ((self.away - self.place[0] - shift) / sigma) ** 2)
        row, column = (int(each) for each in np.unravel_index(int(value.argmax()), value.shape))
        stands_out = float(self.strength[row, column])
        slants = np.linspace(-SLANT, SLANT, SLANTS)
        return Side(
            float(self.away[column] + _vertex(self.strength[row], column) * self.step),
            float(slants[row] + _vertex(self.strength[:, column], row) * (slants[1] - slants[0])),
            stands_out / (stands_out + NOISE),
        )


def _agreed(first: Lying, last: Lying, apart: float) -> float:
    """By how much two opposite sides are off, both alike, from where they are likely to be [m].

    Beside a box there is often a gap, or a neighbour's print: only one place suits both sides.
    """
    sigma = math.hypot(min(first.place[1], last.place[1]), LIKELY)
    shifts = np.linspace(-REACH, REACH, SHIFTS)
    total = -0.5 * (shifts / sigma) ** 2
    wide = math.hypot(apart, NEAR / 2) / first.step
    for side in (first, last):
        profile = np.asarray(cv2.GaussianBlur(side.profile[None, :], (0, 0), wide))[0]
        total = total + np.interp(shifts + side.place[0], side.away, profile)
    return float(shifts[int(total.argmax())])


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
    at = round(edge) if side < 2 else width - 1 - round(edge)  # noqa: PLR2004
    first, last = max(at - reach, 0), min(at + reach + 1, width)
    inner = slice(round(edge), tones.shape[0] - round(edge))
    pad = (reach - (at - first), reach - (last - 1 - at))
    strip = np.pad(tones[inner, first:last], ((0, 0), pad, (0, 0)), mode="edge")
    seen = np.pad(known[inner, first:last], ((0, 0), pad), constant_values=False)
    return np.ascontiguousarray(strip), np.ascontiguousarray(seen)


def _strengths(strip: Narrow, known: npt.NDArray[np.bool_], slants: Floats) -> Floats:
    """(slants, across) how much an edge, or a line, stands out there."""
    means = np.zeros((len(slants), strip.shape[1], strip.shape[2]))
    kernels.profiles(strip, known, np.tan(slants), means)
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
