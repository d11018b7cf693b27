"""Algorithm 1: which box next, with every reason.

The paper's loop of lines 15-22 pops boxes until one can be grasped and never ends when none
can; here it ends in a named outcome with a reason for each box.
"""

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, replace
from typing import TypeVar

import numpy as np

from depal.domain import Perceived, Request
from depal.selection.blocking import Aim, Blocking
from depal.selection.decision import Decision, Outcome, Refused, Scores
from depal.selection.links import EMPTY
from depal.selection.score import ScoreRule, mixed_score, position_priority, queue_order
from depal.selection.walks import blocker_table, propagate
from depal.selection.wanted import aims_of, strongest_first

G = TypeVar("G")


@dataclass(frozen=True, slots=True)
class LeafAlone:
    """The grasp of the studies: whatever nothing blocks can be taken."""


def leaf_alone(_: Perceived) -> LeafAlone:
    """The reachability test of case study 1: every leaf of G has a reachable pose."""
    return LeafAlone()


def select(
    graph: Blocking,
    requests: Iterable[Request],
    rule: ScoreRule,
    grasp_for: Callable[[Perceived], G | Refused],
) -> Decision[G]:
    """One call of BOXSELECTION.

    Args:
        graph: the perceived boxes and what blocks them (lines 3 and 5): G, or another rule.
        requests: what is wanted now (line 2); what nothing has seen yet stays pending.
        rule: w, x_max and the weights of h.
        grasp_for: lines 17 and 18: a reachable grasp of a box, or why there is none. It is
            asked for boxes that nothing blocks, by falling score, until one can be grasped.

    Returns:
        The decision; its target is to be stored next (lines 19 and 23).
    """
    aims, pending = aims_of(graph, requests)
    sets = graph.ahead(aims)
    scores = _ahead(_scored(graph, aims, rule), sets)
    free = scores.slots[graph.links.blockers[scores.slots] == 0]
    refusals: dict[int, str] = {}
    target, grasp = None, None
    for slot in free.tolist():
        answer = grasp_for(graph.at(slot))
        if not isinstance(answer, Refused):
            target, grasp = graph.at(slot), answer
            break
        refusals[slot] = answer.reason
    return Decision(
        outcome=_outcome(graph, target),
        target=target,
        grasp=grasp,
        aims=aims,
        pending=pending,
        cycle=graph.cycle(),
        rule=rule,
        scores=scores,
        boxes=graph.by_slot(),
        blocker_table=blocker_table(graph.links),
        refusals=refusals,
        by_score=not sets,
    )


def _scored(graph: Blocking, aims: tuple[Aim, ...], rule: ScoreRule) -> Scores:
    """Lines 6-13: every box with h, l and s, and the queue ordered by s."""
    h = position_priority(graph.prisms, rule.x_max, rule.weights)
    l = propagate(graph.links, *strongest_first(graph, aims))  # noqa: E741 - the paper's name
    s = mixed_score(h, l, rule.w)
    order = queue_order(graph.prisms, h, s)
    return Scores(order[graph.links.blockers[order] != EMPTY], h, l, s)


def _ahead(scores: Scores, sets: Sequence[frozenset[int]]) -> Scores:
    """The same queue, with the slots of these sets in front, set by set."""
    if not sets:
        return scores
    group = np.full(len(scores.s), len(sets), np.int64)
    for number, members in reversed(list(enumerate(sets))):
        group[list(members)] = number
    order = np.argsort(group[scores.slots], kind="stable")
    return replace(scores, slots=scores.slots[order])


def _outcome(graph: Blocking, target: Perceived | None) -> Outcome:
    if target is not None:
        return Outcome.CHOSEN
    return Outcome.NOTHING_CAN_BE_GRASPED if len(graph) else Outcome.NOTHING_PERCEIVED
