"""From a raster to the faces in it."""

import math
from collections.abc import Sequence
from dataclasses import dataclass, field
from functools import partial

import numpy as np
import numpy.typing as npt

from depal.perception.detecting.expected import Expected
from depal.perception.detecting.implying import Implied, spoken_for
from depal.perception.detecting.kernels import agreeing
from depal.perception.detecting.refuting import RefutedFaces
from depal.perception.faces import Facing, Name, Raster, Rectangle
from depal.perception.packing import packed
from depal.perception.proposals.candidates import Candidates, best, by_lines, placed
from depal.perception.rasters import Taken
from depal.perception.scoring import FaceScore, described, doubts, shipped_score
from depal.perception.seams import Seams, directions_of, seams_along

Floats = npt.NDArray[np.float64]

DIRECTIONS = {Facing.FRONT: 2, Facing.TOP: 4}
"""Edges are looked for in so many directions at the most."""

MOST = 240
"""So many candidates of one raster are weighed against each other."""

FIXED = 100.0
"""The value of a face that is known already, greater than that of all that may overlap it."""

SURE = 1.0
"""A face that is so likely may go on in the shadow of a nearer one [logarithm of odds]."""

NEAR = 0.016
"""A print belongs to a candidate whose sides are all within this of its own [m]."""


@dataclass(frozen=True, slots=True)
class Printed:
    """A place where a product's print was seen.

    Attributes:
        rectangle: where.
        name: what.
    """

    rectangle: Rectangle
    name: Name


@dataclass(frozen=True, slots=True)
class Found:
    """A face on a raster.

    Attributes:
        rectangle: where.
        odds: the logarithm of the odds that it is one face.
        known: share of it that was seen.
        slopes: of its depth along u and v.
        name: what its print may say.
    """

    rectangle: Rectangle
    odds: float
    known: float
    slopes: tuple[float, float] = (0.0, 0.0)
    name: Name | None = None

    @property
    def probability(self) -> float:
        """That it is one face."""
        return 1.0 / (1.0 + math.exp(-self.odds))


@dataclass(frozen=True, slots=True, eq=False)
class Weighed:
    """The rectangles of a raster that may be faces.

    Attributes:
        raster: what is seen.
        candidates: n rectangles.
        agreed: (n, prints) how well each print's place agrees, in [0, 1].
        odds: (n,) the logarithm of the odds that each is one face.
        prints: where prints were seen.
        fixed: faces that are known already; none that is chosen overlaps them.
    """

    raster: Raster
    candidates: Candidates
    agreed: Floats
    odds: Floats
    prints: tuple[Printed, ...] = ()
    fixed: tuple[Rectangle, ...] = ()


@dataclass(frozen=True, slots=True, eq=False)
class Finder:
    """Finds faces.

    Attributes:
        score: how likely a rectangle is a face.
        tops: the same for faces that look up.
        eager: added to every candidate's logarithm of odds before they are weighed against each
            other: so that what is not sure is found too, where nothing else explains the place.
    """

    score: FaceScore = field(default_factory=shipped_score)
    tops: FaceScore = field(default_factory=partial(shipped_score, Facing.TOP))
    eager: float = 2.5

    def score_of(self, facing: Facing) -> FaceScore:
        """The score of faces that look this way."""
        return self.tops if facing is Facing.TOP else self.score

    def weighed(
        self,
        raster: Raster,
        expected: Expected,
        prints: Sequence[Printed] | None,
        fixed: Sequence[Rectangle] = (),
        refuted: RefutedFaces | None = None,
    ) -> Weighed:
        """All rectangles of a raster that may be faces, and how likely each is one.

        Args:
            raster: what is seen.
            expected: what the boxes may measure.
            prints: where prints were seen; None where none was looked for.
            fixed: faces that are known already; none that is found overlaps them.
            refuted: what is no face.
        """
        seams = seams_along(raster, directions_of(raster, DIRECTIONS[raster.facing]))
        sizes = expected.faces(raster.facing)
        taken = Taken.by(raster, fixed) if fixed else None
        candidates, agreed = candidates_of(seams, sizes, prints, taken)
        shares = agreed.max(axis=1) if agreed.shape[1] else np.full(len(candidates), -1.0)
        shares = np.where(shares < 0.0, 0.0 if prints is not None else -1.0, shares)
        features = described(candidates.measured, candidates.sizes, sizes, shares)
        odds = self.score_of(raster.facing).log_odds(features)
        odds -= doubts(candidates.measured, candidates.sizes, sizes, shares)
        if refuted is not None:
            odds[refuted.among(candidates)] = -np.inf
        return Weighed(raster, candidates, agreed, odds, tuple(prints or ()), tuple(fixed))

    def chosen(self, weighed: Weighed, implied: Sequence[Implied] = ()) -> tuple[Found, ...]:
        """Of the rectangles the likeliest that do not overlap.

        Args:
            weighed: the rectangles of a raster.
            implied: what faces that look the other way tell of those that look this way.
        """
        candidates, odds = weighed.candidates, weighed.odds
        if not len(candidates):
            return ()
        odds = odds + spoken_for(candidates, implied)
        likely = np.flatnonzero(odds > -self.eager)
        kept = likely[best(candidates[likely], odds[likely], MOST)]
        values = np.concatenate((odds[kept] + self.eager, np.full(len(weighed.fixed), FIXED)))
        rectangles = (*candidates[kept].rectangles, *weighed.fixed)
        chosen = packed(rectangles, values, weighed.raster, values > self.eager + SURE)
        rows = [kept[k] for k in chosen if k < len(kept)]
        return tuple(
            self._found(candidates, int(row), float(odds[row]), weighed.agreed[row], weighed.prints)
            for row in rows
        )

    def _found(
        self,
        candidates: Candidates,
        row: int,
        odds: float,
        agreed: Floats,
        prints: Sequence[Printed],
    ) -> Found:
        name = None
        if agreed.size and agreed.max() > 0.0:
            name = prints[int(agreed.argmax())].name
        measured = candidates.measured[row]
        rectangle = Rectangle(*candidates.values[row].tolist())
        slopes = (float(measured[17]), float(measured[18]))
        return Found(rectangle, odds, float(measured[10]), slopes, name)


def candidates_of(
    seams: Sequence[Seams],
    sizes: Sequence[tuple[float, float]],
    prints: Sequence[Printed] | None,
    taken: Taken | None = None,
) -> tuple[Candidates, Floats]:
    """Candidates of both kinds, and how well prints agree with them.

    Args:
        seams: the evidence of edges in each direction.
        sizes: widths and heights of faces that are expected [m].
        prints: where prints were seen; None where none was looked for.
        taken: what of the raster belongs to known faces.

    Returns:
        The candidates, and (n, prints) how well each print's place agrees, in [0, 1].
    """
    lines = by_lines(seams, sizes, taken)
    if not prints:
        return lines, np.zeros((len(lines), 0))
    printed = placed(seams, [each.rectangle for each in prints], sizes)
    every = Candidates.joined([printed, lines])
    return every, _agreement(every, printed, np.array([each.name.score for each in prints]))


def _agreement(candidates: Candidates, printed: Candidates, scores: Floats) -> Floats:
    """(n, prints): the print's own score where it lies on the candidate, less the farther off."""
    out = np.empty((len(candidates), len(printed)))
    agreeing(candidates.values, printed.values, scores, NEAR, out)
    return out
