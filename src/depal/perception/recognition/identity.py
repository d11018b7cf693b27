"""Which product a face belongs to, by its print, and whether that may be believed."""

import math
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from depal.domain import Gtin
from depal.perception.faces import Facing, Name
from depal.perception.recognition.agreement import Agreement, agreement, cosine_of
from depal.perception.recognition.details import reading
from depal.perception.recognition.features import Features
from depal.perception.recognition.patches import Patch
from depal.perception.recognition.prints import COARSE, Gallery, Print
from depal.perception.recognition.registration import (
    Motion,
    brought_back,
    found_at,
    registered,
)
from depal.perception.recognition.tones import tones
from depal.perception.recognition.trust import shipped_trust

Floats = npt.NDArray[np.float64]

SIZES = 0.018
"""Edges of a face are known so well [m]."""

WRONG = 0.04
"""So wrong they may be where no print of that size is seen [m]."""

RESEMBLES, DIFFERS = 0.85, 0.6
"""A print of whose size a face is agrees at least so much, and nowhere differs more."""

LEAST = 0.35
"""Cosine below which a print is not what is seen; coarse."""

RIVALS = 6
"""So many prints are looked at closely at the most."""

BEHIND = 0.25
"""A print whose coarse cosine is so far below the best one's is no rival."""

PRINTED = 0.0025
"""The print sits so exactly on a box, two boxes against each other: standard deviation [m]."""

TURNED = math.radians(0.2)
"""The same for its turn [rad]."""


@dataclass(frozen=True, slots=True)
class Limits:
    """When a name may be believed; measured on simulated boxes of seeds kept for that.

    Attributes:
        cosine: of the whole face, at least.
        odds: that it is no unknown sibling, at least [logarithm]; None for the trained limit.
        contrast: of a print that says enough: squared, over its area [m^2].
        apart: a rival whose cosine is so far below is excluded.
        less: so is one whose odds are so much lower [logarithm].
    """

    cosine: float = 0.5
    odds: float | None = None
    contrast: float = 4e-4
    apart: float = 0.2
    less: float = 2.5


@dataclass(frozen=True, slots=True)
class Refinement:
    """Where the print says that the face is.

    Attributes:
        du: its middle along its width, from where it was thought to be [m].
        dv: along its height, downward [m].
        turn: its turn, clockwise, from what it was thought to be [rad].
        sigma: standard deviations of the three; of the print's place on the box, above all.
    """

    du: float
    dv: float
    turn: float
    sigma: tuple[float, float, float]


@dataclass(frozen=True, slots=True)
class Identity:
    """What the print on a face says.

    Attributes:
        name: the best one.
        refined: where it says that the face is.
    """

    name: Name
    refined: Refinement

    @property
    def odds(self) -> float:
        """That it is no unknown sibling of that product [logarithm]."""
        return self.name.odds

    @property
    def rivals(self) -> tuple[Gtin, ...]:
        """Products that the face does not exclude."""
        return self.name.rivals


@dataclass(frozen=True, slots=True, eq=False)
class Fit:
    """A print laid over a face."""

    printed: Print
    quarter: int
    coarse: float
    motion: Motion
    agreed: Agreement
    seen: Features
    level: int

    def fits(self, size: tuple[float, float]) -> bool:
        """Whether a face of this size may be the print's."""
        wide, high = self.printed.size if self.quarter % 2 == 0 else self.printed.size[::-1]
        return abs(wide - size[0]) <= SIZES and abs(high - size[1]) <= SIZES


def identify(
    patch: Patch, gallery: Gallery, limits: Limits | None = None, *, sized: bool = False
) -> Identity | None:
    """Names a face.

    Args:
        patch: the face, laid flat.
        gallery: what may come.
        limits: when a name may be believed.
        sized: whether the face's size is known: then no print of another size is tried.

    Returns:
        The best name, certain or not; None where no print of this size resembles the face.
    """
    limits = limits or Limits()
    fits = laid_over_face(patch, gallery, sized=sized)
    if not fits:
        return None
    best = max(fits, key=lambda fit: fit.agreed.cosine - fit.agreed.worst)
    gtin = best.printed.product.gtin
    odds = _odds(best)
    others = [fit for fit in fits if fit.printed.product.gtin != gtin]
    close = [fit for fit in others if fit.agreed.cosine >= best.agreed.cosine - limits.apart]
    rivals = tuple(fit.printed.product.gtin for fit in close if _odds(fit) > odds - limits.less)
    certain = not rivals and best.fits(patch.size) and _believed(best, odds, limits)
    score = min(max(best.agreed.cosine, 0.0), 1.0)
    name = Name(gtin, best.printed.side, score, certain, best.quarter, odds, rivals)
    return Identity(name, _refined(best))


def fitting(
    size: tuple[float, float], facing: Facing, gallery: Gallery, within: float = SIZES
) -> list[tuple[Print, int]]:
    """Prints that a face of about this size may bear, and their quarter turns."""
    found = list[tuple[Print, int]]()
    for printed in gallery.prints:
        if printed.facing is not facing:
            continue
        for quarter in range(4) if facing is Facing.TOP else range(1):
            wide, high = printed.size if quarter % 2 == 0 else printed.size[::-1]
            if abs(wide - size[0]) <= within and abs(high - size[1]) <= within:
                found.append((printed, quarter))
    return found


def laid_over_face(patch: Patch, gallery: Gallery, *, sized: bool = False) -> list[Fit]:
    """The prints that resemble a face most, laid over it.

    Args:
        patch: the face, laid flat.
        gallery: what may come.
        sized: whether its size is known; else prints of other sizes are tried where none of its
            size resembles it.
    """
    near = fitting(patch.size, patch.facing, gallery)
    seen = patch.features
    fits = _all_laid(seen, near)
    alike = any(fit.agreed.cosine >= RESEMBLES and fit.agreed.worst <= DIFFERS for fit in fits)
    if alike or sized:
        return fits
    known = {(printed.product.gtin, printed.side, quarter) for printed, quarter in near}
    far = [
        (printed, quarter)
        for printed, quarter in fitting(patch.size, patch.facing, gallery, WRONG)
        if (printed.product.gtin, printed.side, quarter) not in known
    ]
    return fits + _all_laid(seen, far)


def _all_laid(seen: Features, candidates: list[tuple[Print, int]]) -> list[Fit]:
    """Of these prints those that resemble a face most, laid over it."""
    if not candidates:
        return []
    turned = {quarter: seen.turned(-quarter) for quarter in {q for _, q in candidates}}
    small = {quarter: features.thinned(COARSE) for quarter, features in turned.items()}
    firsts = [
        (*found_at(small[quarter], printed.coarse), printed, quarter)
        for printed, quarter in candidates
    ]
    firsts.sort(key=lambda first: -first[0])
    top = firsts[0][0]
    kept = [first for first in firsts if first[0] > max(LEAST, top - BEHIND)][:RIVALS]
    fits, level, start = list[Fit](), -1, dict[int, Motion]()
    for coarse, motion, printed, quarter in kept:
        begin = start.get(quarter, motion)
        fit, level = _laid(turned[quarter], printed, quarter, (coarse, begin), level)
        start.setdefault(quarter, fit.motion)
        fits.append(fit)
    return fits


def _laid(
    seen: Features, printed: Print, quarter: int, first: tuple[float, Motion], level: int
) -> tuple[Fit, int]:
    """A print laid over a face, and the blur that suits both."""
    coarse, begin = first
    motion = registered(seen, printed.levels[max(level, 0)], begin, every=2)
    back = brought_back(seen, motion, printed.levels[0].weights.shape)
    if level < 0:
        cosines = [cosine_of(back, features) for features in printed.levels]
        level = cosines.index(max(cosines))
    agreed = agreement(back, printed.levels[level])
    return Fit(printed, quarter, coarse, motion, agreed, back, level), level


def _odds(fit: Fit) -> float:
    """That the print is not an unknown sibling's."""
    return shipped_trust().log_odds(evidence(fit))


def evidence(fit: Fit) -> Floats:
    """What speaks for a print, as the numbers of `trust.NAMES`."""
    printed, agreed = fit.printed, fit.agreed
    level = printed.levels[fit.level]
    whole = (
        agreed.cosine,
        math.log(agreed.worst + 0.02),
        math.log(agreed.worst_tone + 0.02),
        agreed.seen,
        float(fit.level),
        abs(fit.motion.scale),
        printed.label_ends,
        *printed.size,
        float(printed.facing is Facing.TOP),
        math.log(printed.contrast + 1e-4),
        math.log(printed.small[-1].sum() + 1.0),
    )
    told = tones(fit.seen.thinned(COARSE), level.thinned(COARSE), printed.areas)
    read = reading(fit.seen, level, printed.small)
    return np.concatenate((whole, told, read))


def _believed(fit: Fit, odds: float, limits: Limits) -> bool:
    """Whether a print agrees so well that it is no other product's, unknown siblings included."""
    return (
        fit.agreed.cosine >= limits.cosine
        and odds >= (shipped_trust().limit if limits.odds is None else limits.odds)
        and fit.printed.contrast >= limits.contrast
    )


def _refined(fit: Fit) -> Refinement:
    """The place of a face by its print, along the face's own axes."""
    x, y = fit.motion.middle
    for _ in range(fit.quarter % 4):
        x, y = -y, x
    sx, sy, st = fit.motion.sigma
    if fit.quarter % 2 == 1:
        sx, sy = sy, sx
    sigma = (math.hypot(sx, PRINTED), math.hypot(sy, PRINTED), math.hypot(st, TURNED))
    return Refinement(x, y, -fit.motion.turn, sigma)
