"""All rectangles of a raster that may be faces, in the raster's own plane."""

from collections.abc import Sequence
from dataclasses import astuple, dataclass

import numpy as np
import numpy.typing as npt

from depal.perception.faces import Rectangle
from depal.perception.proposals import kernels
from depal.perception.proposals.kernels import FEATURES
from depal.perception.proposals.lines import Rectangles, between_lines, measured, running
from depal.perception.rasters import Taken
from depal.perception.seams import Seams

Floats = npt.NDArray[np.float64]

FEWEST = 0.3
"""A rectangle of which a smaller share is known is left out."""

ALIKE = 0.010
"""Rectangles whose sides all lie so near to one another are the same [m]."""


RATHER = 0.045
FEW = 4
"""Of rectangles whose sides lie so near to one another [m], only the few best are weighed."""


@dataclass(frozen=True, slots=True, eq=False)
class Candidates:
    """Rectangles with what was measured of each.

    Attributes:
        values: (n, 6) u, v, width, height [m], turn [rad], depth [m], as in `Rectangle`.
        measured: (n, FEATURES) as `proposals.kernels` says.
    """

    values: Floats
    measured: Floats

    def __len__(self) -> int:
        """How many there are."""
        return len(self.values)

    def __getitem__(self, rows: npt.NDArray[np.intp]) -> "Candidates":
        """Some of them."""
        return Candidates(self.values[rows], self.measured[rows])

    @property
    def sizes(self) -> Floats:
        """(n, 2) width and height [m]."""
        return self.values[:, 2:4]

    @property
    def rectangles(self) -> tuple[Rectangle, ...]:
        """Each as a value."""
        return tuple(Rectangle(*row) for row in self.values.tolist())

    @classmethod
    def joined(cls, parts: Sequence["Candidates"]) -> "Candidates":
        """Several together."""
        empty = cls(np.zeros((0, 6)), np.zeros((0, FEATURES)))
        every = [empty, *parts]
        return cls(
            np.concatenate([each.values for each in every]),
            np.concatenate([each.measured for each in every]),
        )


def by_lines(
    seams: Sequence[Seams], sizes: Sequence[tuple[float, float]], taken: Taken | None = None
) -> Candidates:
    """Rectangles between edges, in every direction that edges have.

    Args:
        seams: the evidence of edges in each direction.
        sizes: widths and heights of faces that are expected [m]; none where nothing is.
        taken: what of the raster belongs to known faces.
    """
    found = Candidates.joined([_in_raster(between_lines(each, sizes, taken)) for each in seams])
    good = (found.measured[:, 10] >= FEWEST) & np.isfinite(found.measured[:, 16])
    return found[np.flatnonzero(good)]


def placed(
    seams: Sequence[Seams],
    rectangles: Sequence[Rectangle],
    sizes: Sequence[tuple[float, float]] = (),
) -> Candidates:
    """Rectangles that something else suggests, measured like the others.

    Args:
        seams: the evidence of edges in each direction.
        rectangles: in the raster's plane.
        sizes: widths and heights of faces that are expected [m]; none where nothing is.

    Returns:
        The same rectangles in the same order, but for those that leave the raster.
    """
    nearest = [
        min(range(len(seams)), key=lambda k: abs(seams[k].turn - rectangle.turn))
        for rectangle in rectangles
    ]
    values = np.array([astuple(rectangle) for rectangle in rectangles]).reshape(-1, 6)
    measures = np.zeros((len(values), FEATURES))
    for k, turned in enumerate(seams):
        rows = np.flatnonzero(np.array(nearest) == k)
        if rows.size:
            measures[rows] = _measured_at(turned, values[rows], sizes)
    known = np.isfinite(measures[:, 16])
    values[known, 5] = measures[known, 16]
    return Candidates(values, measures)


def _measured_at(turned: Seams, values: Floats, known: Sequence[tuple[float, float]]) -> Floats:
    """What is measured of rectangles (n, 6), as they lie nearest in a turned raster."""
    way, step = turned.raster_from_turned, turned.step
    middles = (values[:, :2] / step - way[:, 2]) @ way[:, :2]
    halves = values[:, 2:4] / step / 2
    height, width = turned.level.shape
    sides = np.round(np.hstack((middles - halves, middles + halves))).astype(np.int64)
    limits = [width - 1, height - 1, width - 1, height - 1]
    return measured(turned, np.clip(sides, 0, limits), running(turned), known)


def best(candidates: Candidates, odds: Floats, most: int) -> npt.NDArray[np.intp]:
    """The rows of the best, none like a better one.

    Args:
        candidates: all.
        odds: (n,) the logarithm of the odds of each.
        most: so many at the most.
    """
    u, v, w, h, turn, _ = candidates.values.T
    # Sides as they lie; candidates of different directions differ by their turns' effect too.
    sides = np.column_stack((u - w / 2, v - h / 2, u + w / 2, v + h / 2, turn * (w + h) / 4))
    order = np.argsort(-odds, kind="stable")
    kept = np.zeros(most, dtype=np.int64)
    count = kernels.unlike(sides, order, ALIKE, RATHER, FEW, kept)
    return kept[:count]


def _in_raster(found: Rectangles) -> Candidates:
    """The rectangles in the plane of the raster [m]."""
    step, seams = found.seams.step, found.seams
    x0, y0, x1, y1 = found.pixels.T.astype(float)
    middles = np.column_stack(((x0 + x1) / 2, (y0 + y1) / 2))
    way = seams.raster_from_turned
    at = (middles @ way[:, :2].T + way[:, 2]) * step
    turn = np.full(len(at), seams.turn)
    values = (at, (x1 - x0) * step, (y1 - y0) * step, turn, found.features[:, 16])
    return Candidates(np.column_stack(values), found.features)
