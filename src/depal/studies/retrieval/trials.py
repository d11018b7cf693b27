"""Random pallets with one request each, under both policies, with and without clearance."""

from collections.abc import Sequence
from concurrent.futures import Executor
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from depal.cell.accessing import ways_in_cell
from depal.cell.planning.facing import pallet_front
from depal.domain import Approach, BoxId, CellLayout, Detection, Grasp, Perceived
from depal.geometry import OrientedBox
from depal.motion.collision import Body
from depal.motion.grasping import grasps
from depal.selection import EXACT, BlockingGraph, geometric_rank, position_priority
from depal.selection.access import BEFORE, OVER, Mask, Ways, free_ways, masks, standings
from depal.studies.case1 import draw_trial
from depal.studies.pallets import RandomPallet, generator_named
from depal.studies.retrieval.rows import POLICIES, Row, row_of
from depal.studies.retrieval.runs import Retrieval, Scores, by_access, by_paper
from depal.studies.sweep import Progress, no_progress, sweep

Array = npt.NDArray[np.float64]

SHARES = (0.0, 0.25, 0.5, 0.75, 1.0)
"""Of boxes that only a side grasp can take."""

DENSITY = 20.0
"""Of the boxes of random pallets in the cell [kg/m^3]: so light that the suction holds them all."""

_PIECE = 50
_SIDES = 7


@dataclass(frozen=True, slots=True)
class Piece:
    """Trials first .. last - 1 of a study.

    Attributes:
        generator: the name of the pallets' generator.
        shares: of side-only boxes, one row each.
        seed: of the study.
        first: the first trial.
        last: one past the last.
        layout: the cell whose clearance and reach count; None for a tool without extent.
    """

    generator: str
    shares: tuple[float, ...]
    seed: int
    first: int
    last: int
    layout: CellLayout | None


def random_rows(
    generator: str,
    pallets: int,
    seed: int,
    shares: Sequence[float] = SHARES,
    layout: CellLayout | None = None,
    executor: Executor | None = None,
    progress: Progress = no_progress,
) -> list[Row]:
    """The rows of one generator: per share of side-only boxes one for each policy.

    Args:
        generator: the name of the pallets' generator.
        pallets: how many; trial i is the same as in case study 1.
        seed: of the study.
        shares: of boxes that only a side grasp can take.
        layout: the cell whose clearance and reach count; None for a tool without extent.
        executor: who works; None for this process.
        progress: told how far it is.

    Raises:
        SettingError: no such generator.
    """
    generator_named(generator)
    pieces = [
        Piece(generator, tuple(shares), seed, first, min(first + _PIECE, pallets), layout)
        for first in range(0, pallets, _PIECE)
    ]
    trials = [trial for piece in sweep(count_piece, pieces, executor, progress) for trial in piece]
    return [
        row_of(generator, share, layout is not None, [trial[number] for trial in trials], policy)
        for number, share in enumerate(shares)
        for policy in range(len(POLICIES))
    ]


Pair = tuple[Retrieval, Retrieval]


def count_piece(piece: Piece) -> list[tuple[Pair, ...]]:
    """Per trial and share the results of `paper` and of `access`."""
    return [count_trial(piece, index) for index in range(piece.first, piece.last)]


def count_trial(piece: Piece, index: int) -> tuple[Pair, ...]:
    """One pallet: per share the results of `paper` and of `access`."""
    trial = draw_trial(generator_named(piece.generator), piece.seed, index)
    pallet = trial.pallet
    prisms = pallet.prisms
    h = position_priority(prisms, pallet.x_max)
    scores = Scores(h.tolist(), geometric_rank(prisms, h).tolist(), trial.priority)
    graph = paper_graph(prisms)
    results: list[Pair] = []
    for ways in _ways(piece, pallet, index):
        paper = by_paper(graph, ways, trial.requested, scores)
        access = by_access(ways, trial.requested, scores.rank)
        results.append((paper, access))
    return tuple(results)


def paper_graph(prisms: Array) -> list[Mask]:
    """G: per box those that lie over it or before it."""
    rows = np.arange(len(prisms))
    codes = standings(prisms, rows, EXACT.overlap, EXACT.slack)
    return masks(codes & (OVER | BEFORE))


def _ways(piece: Piece, pallet: RandomPallet, index: int) -> list[Ways]:
    """Per share the ways to take the boxes: the boxes of a share are side-only in all greater."""
    rng = np.random.default_rng(np.random.SeedSequence(piece.seed, spawn_key=(index, _SIDES)))
    draws = rng.random(len(pallet))
    sides = [(draws < share).tolist() for share in piece.shares]
    if piece.layout is None:
        return [
            free_ways(pallet.prisms, EXACT, allowed=[_ONLY[side] for side in each])
            for each in sides
        ]
    whole = cell_ways(piece.layout, pallet)
    return [
        Ways.among(
            range(len(pallet)),
            (way for ways in whole.of for way in ways if way.approach in _ONLY[each[way.box]]),
        )
        for each in sides
    ]


_ONLY = {
    False: (Approach.VERTICAL, Approach.HORIZONTAL),
    True: (Approach.HORIZONTAL,),
}


def cell_ways(layout: CellLayout, pallet: RandomPallet) -> Ways:
    """The ways to the boxes of a random pallet that stands on the pallet of a cell."""
    deck = layout.pallet.cell_from_pallet.translation[2]
    boxes = [
        Detection(BoxId(f"b{k}"), OrientedBox.upright((x, y, z + deck), (a, b, c)))
        for k, ((x, y, z), (a, b, c)) in enumerate(
            zip(pallet.centres.tolist(), pallet.sizes.tolist(), strict=True)
        )
    ]
    front = pallet_front(layout.pallet)

    def held(box: Perceived) -> tuple[Grasp, ...]:
        mass = DENSITY * float(np.prod(box.shape.size))
        return grasps(box.shape, mass, layout.tool, front)

    kinematics = Body.of(layout).kinematics
    ways, _ = ways_in_cell(BlockingGraph(boxes, EXACT), layout, kinematics, held)
    return ways
