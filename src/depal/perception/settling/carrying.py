"""What a box stands on, where that is near to its bottom."""

import math
from collections.abc import Sequence
from collections.abc import Set as AbstractSet
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from depal.geometry import footprint_overlap, prisms_of
from depal.perception.settling.draft import Draft, Z

Floats = npt.NDArray[np.float64]

OVERLAP = 0.015
"""Boxes that overlap on the ground by more may carry one another [m]."""

LEAST, MOST = 0.008, 0.03
"""A gap below a box is no gap where it is smaller; it is one where it is larger [m]."""

TIMES = 2.5
"""In between it is none where it is less than so many of its standard deviations."""


EXACT = 0.0015
"""A box's bottom and what carries it meet so exactly, as a standard deviation [m]."""

LEVEL = 0.003
"""A box of which nobody sees what carries it stands so exactly on a level that others tell [m]."""

NONE = 0.1
"""How likely it is that it stands on none of them, against one where it seems to stand exactly."""

SURELY = 0.65
"""The likeliest level is taken where it is at least so probable."""

ONE = 0.003
"""Levels that differ by less are one [m]."""


@dataclass(frozen=True, slots=True)
class Contact:
    """A box that stands on something.

    Attributes:
        upper: the box, by its index.
        lower: what it stands on; None for the ground, or for what nobody sees.
        gap: how much too high the box seems to be [m].
        sigma: how exactly it stands there, as a standard deviation [m].
    """

    upper: int
    lower: int | None
    gap: float
    sigma: float = EXACT


def contacts(
    drafts: Sequence[Draft], states: Floats, covariance: Floats, ground: float
) -> list[Contact]:
    """All pairs of a box and something below it that meet, as far as can be seen.

    Args:
        drafts: boxes.
        states: (n, 4) where they seem to be.
        covariance: (4 n + ..., 4 n + ...) of that.
        ground: height of what the lowest stand on [m].
    """
    if not drafts:
        return []
    prisms = prisms_of(d.shape(s) for d, s in zip(drafts, states, strict=True))
    tops, bottoms = prisms[:, 2] + prisms[:, 5], prisms[:, 2] - prisms[:, 5]
    z = 4 * np.arange(len(drafts)) + Z
    spread = covariance[np.ix_(z, z)]
    found = list[Contact]()
    for a, draft in enumerate(drafts):
        if not draft.stands:
            continue
        gap = float(bottoms[a] - ground)
        if _meets(max(gap, 0.0), float(spread[a, a])):  # nothing stands lower
            found.append(Contact(a, None, gap))
            continue
        for b in np.flatnonzero(np.abs(bottoms[a] - tops) < MOST).tolist():
            gap = float(bottoms[a] - tops[b])
            doubt = float(spread[a, a] + spread[b, b] - 2 * spread[a, b])
            if b != a and _meets(gap, doubt) and footprint_overlap(prisms, a, b) > OVERLAP:
                found.append(Contact(a, b, gap))
    carried = {contact.upper for contact in found}
    levels = _levels(drafts, bottoms, carried, ground)
    for a in sorted({k for k, draft in enumerate(drafts) if draft.stands} - carried):
        above = _above(float(bottoms[a]), float(spread[a, a]), levels)
        if above is not None:
            found.append(Contact(a, None, above, LEVEL))
    return found


def _levels(
    drafts: Sequence[Draft], bottoms: Floats, carried: AbstractSet[int], ground: float
) -> Floats:
    """(n,) heights at which boxes may stand: where some do, and on boxes that stand there [m]."""
    known = _merged([ground, *(float(bottoms[k]) for k in sorted(carried))])
    heights = _merged([draft.size[2] for draft in drafts if draft.stands])
    return np.array(_merged([*known, *(low + high for low in known for high in heights)]))


def _merged(heights: Sequence[float]) -> list[float]:
    """Heights, those once that are nearly equal."""
    out = list[float]()
    for height in sorted(heights):
        if not out or height - out[-1] > ONE:
            out.append(height)
    return out


def _above(bottom: float, variance: float, levels: Floats) -> float | None:
    """How far a box is above the level that it surely stands on [m]; None where none is sure."""
    gaps = bottom - levels
    chances = np.exp(-0.5 * gaps**2 / (variance + LEVEL**2)) * (np.abs(gaps) < MOST)
    best = int(chances.argmax())
    sure = chances[best] > SURELY * (float(chances.sum()) + NONE)
    return float(gaps[best]) if sure else None


def _meets(gap: float, variance: float) -> bool:
    limit = min(max(TIMES * math.sqrt(max(variance, 0.0)), LEAST), MOST)
    return abs(gap) < limit
