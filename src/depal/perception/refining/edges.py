"""Lays the four sides of a face onto the edges that a patch shows."""

import math
from dataclasses import dataclass

import cv2
import numpy as np
import numpy.typing as npt

from depal.perception.recognition.patches import Patch
from depal.perception.refining import kernels

Floats = npt.NDArray[np.float64]
Narrow = npt.NDArray[np.float32]

REACH = 0.010
"""A side is looked for so far on either side of where it is thought to be [m]."""

LIKELY = 0.006
"""How far off it usually is, as a standard deviation [m]."""

SLANT = math.radians(2.5)
SLANTS = 21
"""So many turns within plus and minus that are tried [rad]."""

USUAL = math.radians(1.5)
"""How far a turn is usually off, as a standard deviation [rad]."""

NOISE = 0.012
"""Steps of log brightness or colour along a whole side that mean nothing."""

EXACT = 0.0012
"""A side that stands out is found so exactly, as a standard deviation [m]."""

VAGUE = 0.008
"""The same where nothing stands out [m]."""


@dataclass(frozen=True, slots=True)
class Refined:
    """Where the edges say that a face is, in the face's own axes.

    Attributes:
        du: of its middle, along its width [m].
        dv: of its middle, downward [m].
        turn: clockwise, from what it was thought to be [rad].
        width: of it, by its edges [m].
        height: of it, by its edges [m].
        sigma: standard deviations of du, dv [m] and turn [rad].
    """

    du: float
    dv: float
    turn: float
    width: float
    height: float
    sigma: tuple[float, float, float]


def refined(patch: Patch, *, fixed: bool) -> Refined:
    """Finds the sides of a face near where they are thought to be.

    Args:
        patch: the face, laid flat, with a margin.
        fixed: whether its size is known; then only its place and turn are looked for.
    """
    tones = _tones(patch)
    strips = [_strip(tones, patch, side) for side in range(4)]
    slants = np.linspace(-SLANT, SLANT, SLANTS)
    strengths = [_strengths(strip, known, slants) for strip, known in strips]
    around = strengths[0].shape[1] // 2
    away = (np.arange(2 * around + 1) - around) * patch.step
    likely = np.exp(-0.5 * (away / LIKELY) ** 2)
    each = np.array([(strength * likely).max(axis=1) for strength in strengths])
    # A turn moves opposite sides alike; the sides' own turns agree about the right one.
    total = each.sum(axis=0) * np.exp(-0.5 * (slants / USUAL) ** 2)
    best = int(total.argmax())
    turn = slants[best] + _vertex(total, best) * (slants[1] - slants[0])
    offsets, clear = [], []
    for strength in strengths:
        line = strength[best] * likely
        at = int(line.argmax())
        offsets.append(float(away[at] + _vertex(line, at) * patch.step))
        clear.append(float(strength[best, at] / (strength[best, at] + NOISE)))
    return _together(patch.size, offsets, clear, float(turn), float(total.max()), fixed=fixed)


def _together(
    size: tuple[float, float],
    offsets: list[float],
    clear: list[float],
    turn: float,
    strength: float,
    *,
    fixed: bool,
) -> Refined:
    """From the sides left, top, right, lower to the face."""
    sigmas = [VAGUE + (EXACT - VAGUE) * share for share in clear]
    left, top, right, low = offsets
    sides = ((left, right, sigmas[0], sigmas[2]), (top, low, sigmas[1], sigmas[3]))
    moves, spreads, grown = [], [], []
    for first, last, a, b in sides:
        weight = b * b / (a * a + b * b) if fixed else 0.5
        moves.append(weight * first + (1.0 - weight) * last)
        spreads.append(a * b / math.hypot(a, b) if fixed else math.hypot(a, b) / 2)
        grown.append(0.0 if fixed else last - first)
    trust = strength / (strength + 4 * NOISE)
    turned = math.radians(0.25) + (1.0 - trust) * USUAL
    (du, dv), (wider, higher) = moves, grown
    return Refined(
        du, dv, turn * trust, size[0] + wider, size[1] + higher, (spreads[0], spreads[1], turned)
    )


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
