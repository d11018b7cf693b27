"""A selection as it was, to be asked again with something changed."""

from collections.abc import Iterable, Sequence
from typing import Any

import numpy as np
import numpy.typing as npt

from depal.domain import BoxId, Perceived, Request
from depal.selection.decision import Decision, Refused
from depal.selection.graph import BlockingGraph
from depal.selection.relations import PERCEIVED, Tolerances
from depal.selection.score import ScoreRule, mixed_score, position_priority, queue_order
from depal.selection.select import LeafAlone, select
from depal.selection.walks import propagate
from depal.selection.wanted import aims_of, strongest_first

Array = npt.NDArray[np.float64]


class Situation:
    """The boxes, requests and refused grasps of a decision by G.

    Attributes:
        graph: G, built anew.
        requests: what was wanted, those for what nothing has seen included.
        rule: of the scores.
        free: the boxes that nothing blocks and whose grasp was not refused, best first.
        h: (free,) Eq. (1) [m].
        l: (free,) Eq. (2).
    """

    def __init__(self, decision: Decision[Any], tolerances: Tolerances = PERCEIVED) -> None:
        """The situation of a decision.

        Args:
            decision: made with a BlockingGraph.
            tolerances: of that graph.
        """
        boxes = [box for box in decision.boxes if box is not None]
        self.graph = BlockingGraph(boxes, tolerances)
        self.requests = (*(aim.request for aim in decision.aims), *decision.pending)
        self.rule = decision.rule
        self._refused = {
            box.id: decision.refusals[slot]
            for slot, box in enumerate(decision.boxes)
            if box is not None and slot in decision.refusals
        }
        leaves = self.graph.leaves()
        self.free: tuple[BoxId, ...] = tuple(
            verdict.box.id
            for verdict in decision.verdicts
            if verdict.box.id in leaves and verdict.box.id not in self._refused
        )
        self._prisms = self._of_free(self.graph.prisms)
        self.h = position_priority(self._prisms, self.rule.x_max, self.rule.weights)
        self.l = self.inherited(self.requests)

    def inherited(self, requests: Iterable[Request]) -> Array:
        """(free,) Eq. (2) under other requests."""
        aims, _ = aims_of(self.graph, requests)
        return self._of_free(propagate(self.graph.links, *strongest_first(self.graph, aims)))

    def best(self, l: Array, w: float) -> BoxId:  # noqa: E741 - the paper's name
        """The free box with the best score under other l and w.

        Args:
            l: (free,) Eq. (2).
            w: of Eq. (3).
        """
        return self.free[int(queue_order(self._prisms, self.h, mixed_score(self.h, l, w))[0])]

    def again(
        self,
        requests: Sequence[Request] | None = None,
        rule: ScoreRule | None = None,
        without: Iterable[BoxId] = (),
    ) -> BoxId | None:
        """What is chosen under other requests, another rule, or without some boxes."""
        removed = [self.graph[box] for box in without]
        for box in removed:
            self.graph.remove(box.id)
        wanted = self.requests if requests is None else requests
        decision = select(self.graph, wanted, rule or self.rule, self._grasp)
        for box in removed:
            self.graph.add(box)
        return None if decision.target is None else decision.target.id

    def _grasp(self, box: Perceived) -> LeafAlone | Refused:
        reason = self._refused.get(box.id)
        return LeafAlone() if reason is None else Refused(reason)

    def _of_free(self, values: Array) -> Array:
        slots = [self.graph.slot_of(box) for box in self.free]
        return np.asarray(values[np.array(slots, np.intp)])
