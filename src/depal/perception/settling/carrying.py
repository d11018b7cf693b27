"""What a box stands on, where that is near to its bottom."""

import math
from collections.abc import Sequence
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


@dataclass(frozen=True, slots=True)
class Contact:
    """A box that stands on something.

    Attributes:
        upper: the box, by its index.
        lower: what it stands on; None for the ground.
        gap: between the two as it seems [m].
    """

    upper: int
    lower: int | None
    gap: float


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
        if _meets(gap, float(spread[a, a])):
            found.append(Contact(a, None, gap))
            continue
        for b in np.flatnonzero(np.abs(bottoms[a] - tops) < MOST).tolist():
            gap = float(bottoms[a] - tops[b])
            doubt = float(spread[a, a] + spread[b, b] - 2 * spread[a, b])
            if b != a and _meets(gap, doubt) and footprint_overlap(prisms, a, b) > OVERLAP:
                found.append(Contact(a, b, gap))
    return found


def _meets(gap: float, variance: float) -> bool:
    limit = min(max(TIMES * math.sqrt(max(variance, 0.0)), LEAST), MOST)
    return abs(gap) < limit
