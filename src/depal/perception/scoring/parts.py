"""What sizes tell: that a face goes on behind something, that a rectangle is rather two faces."""

from collections.abc import Sequence

import numpy as np
import numpy.typing as npt

from depal.perception.proposals.parts import COVERED, LEAST

Floats = npt.NDArray[np.float64]

UNSURE = 0.006
"""An edge whose end is hidden fits no better than with this misfit [m]."""

GAIN = 0.01
"""A rectangle is taken for a part of a face only where that fits so much better [m]."""

DIVIDED = 2.5
"""A rectangle with a seam as strong as its outline, between two of expected sizes, loses so much
[logarithm of odds]."""

PARTLY = 2.5
"""So much surer a face must be of which something is hidden [logarithm of odds]."""

WEAKER = 0.15
"""A seam that is so much weaker than the outline says nothing."""


def whole(
    sizes: Floats, expected: Sequence[tuple[float, float]], covered: Floats
) -> tuple[Floats, Floats]:
    """The sizes of the faces of which rectangles are what is seen.

    Args:
        sizes: (n, 2) width and height of the rectangles [m].
        expected: widths and heights of faces that may be there [m]; none where nobody knows.
        covered: (n, 4) the share of the left, top, right and lower side beyond which something
            nearer begins.

    Returns:
        (n, 2) the width and height, with the hidden part [m], and (n,) how much is to be added to
        the misfit for what is not seen [m].
    """
    found, more = sizes.copy(), np.zeros(len(sizes))
    if not len(expected):
        return found, more
    known = np.array(expected, dtype=float)
    hidden = np.column_stack((covered[:, [0, 2]].max(axis=1), covered[:, [1, 3]].max(axis=1)))
    rows = np.flatnonzero((hidden > COVERED).any(axis=1))
    seen = sizes[rows, None, :]
    grown = np.where((hidden[rows] > COVERED)[:, None, :], np.maximum(seen, known[None]), seen)
    away = np.hypot(*(grown - known[None]).transpose(2, 0, 1))
    away[seen.prod(axis=2) < LEAST * grown.prod(axis=2)] = np.inf
    plain = np.hypot(*(seen - known[None]).transpose(2, 0, 1)).min(axis=1)
    best = away.argmin(axis=1)
    each = np.arange(len(rows))
    better = away[each, best] + UNSURE + GAIN < plain
    found[rows[better]] = grown[each, best][better]
    more[rows[better]] = UNSURE
    return found, more


def doubts(
    measured: Floats, sizes: Floats, expected: Sequence[tuple[float, float]], prints: Floats
) -> Floats:
    """(n,) what is to be taken from the logarithm of the odds of rectangles.

    Args:
        measured: (n, FEATURES) as `proposals` says.
        sizes: (n, 2) width and height [m].
        expected: widths and heights of faces that may be there [m]; none where nobody knows.
        prints: (n,) how well the best print fits; one that was seen knows better than its lines.
    """
    seam, outline = measured[:, 21], measured[:, 4:8].min(axis=1)
    strong = np.clip(1.0 - (outline - seam) / WEAKER, 0.0, 1.0)
    rather_two = (seam > 0.0) & (prints <= 0.0)
    partly = whole(sizes, expected, measured[:, 22:26])[1] > 0.0
    return np.asarray(np.where(rather_two, DIVIDED * strong, 0.0) + np.where(partly, PARTLY, 0.0))
