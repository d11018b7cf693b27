"""Real deliveries, every box requested once: actions and gap of both policies."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from depal.cell.accessing import ways_in_cell
from depal.cell.planning.facing import pallet_front
from depal.domain import CellLayout, Delivery, Grasp, Perceived, Recognition
from depal.motion.collision import Body
from depal.motion.grasping import grasps
from depal.selection import BlockingGraph, geometric_rank, position_priority
from depal.selection.access import BEFORE, OVER, Ways, free_ways, masks, standings
from depal.studies.real import STACKED, far_side, perceived_stack
from depal.studies.retrieval.rows import POLICIES, Row, row_of
from depal.studies.retrieval.runs import Retrieval, Scores, by_access, by_paper


@dataclass(frozen=True, slots=True)
class StackRows:
    """One delivery.

    Attributes:
        delivery: its id.
        boxes: how many cases it has.
        rows: one per policy.
        above: requests for which `access` took more actions than `paper`.
    """

    delivery: str
    boxes: int
    rows: tuple[Row, Row]
    above: int


@dataclass(frozen=True, slots=True)
class StackPiece:
    """One delivery of a study.

    Attributes:
        delivery: with its stack.
        layout: the cell whose clearance and reach count; None for a tool without extent.
    """

    delivery: Delivery
    layout: CellLayout | None


def stack_rows(piece: StackPiece) -> tuple[StackRows, list[tuple[Retrieval, Retrieval]]]:
    """Every box of a delivery requested once, each time from the whole stack.

    Returns:
        The rows, and per box the results of `paper` and of `access`.

    Raises:
        DeliveryError: only the note is known.
    """
    delivery = piece.delivery
    boxes = BlockingGraph(perceived_stack(delivery), STACKED)
    prisms = boxes.prisms
    h = position_priority(prisms, far_side(delivery))
    scores = Scores(h.tolist(), geometric_rank(prisms, h).tolist())
    codes = standings(prisms, boxes.used_slots, STACKED.overlap, STACKED.slack)
    graph = masks(codes & (OVER | BEFORE))
    ways = _ways(piece, boxes)
    pairs = [
        (by_paper(graph, ways, slot, scores), by_access(ways, slot, scores.rank))
        for slot in boxes.used_slots.tolist()
    ]
    clearance = piece.layout is not None
    rows = (
        row_of(delivery.id, 0.0, clearance, pairs, 0),
        row_of(delivery.id, 0.0, clearance, pairs, 1),
    )
    return StackRows(delivery.id, len(boxes), rows, sum(map(_is_above, pairs))), pairs


def _is_above(pair: tuple[Retrieval, Retrieval]) -> bool:
    """Whether `access` did worse; never reaching a box is worse than anything."""
    paper, access = (np.inf if each.actions is None else each.actions for each in pair)
    return access > paper


def _ways(piece: StackPiece, boxes: BlockingGraph) -> Ways:
    layout = piece.layout
    if layout is None:
        return free_ways(boxes.prisms, STACKED, boxes.used_slots.tolist())
    front = pallet_front(layout.pallet)
    products = piece.delivery.products

    def held(box: Perceived) -> Sequence[Grasp]:
        mass = products[box.gtin].mass if isinstance(box, Recognition) else 0.0
        return grasps(box.shape, mass, layout.tool, front)

    ways, _ = ways_in_cell(boxes, layout, Body.of(layout).kinematics, held)
    return ways


def real_rows(pieces: Sequence[tuple[StackRows, list[tuple[Retrieval, Retrieval]]]]) -> list[Row]:
    """The rows of all deliveries together, one per policy."""
    pairs = [pair for _, results in pieces for pair in results]
    clearance = bool(pieces) and pieces[0][0].rows[0].clearance
    return [row_of("real", 0.0, clearance, pairs, policy) for policy in range(len(POLICIES))]
