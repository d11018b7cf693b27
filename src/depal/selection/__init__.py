"""Which box next: section II-C, Eqs. (1)-(3) and Algorithm 1."""

from depal.selection.blocking import Aim, Blocking
from depal.selection.building import link_prisms
from depal.selection.counterfactuals import Change
from depal.selection.decision import Decision, Fate, Outcome, Refused, Scores, Verdict
from depal.selection.explaining import Explanation, Parts, explain
from depal.selection.graph import Blocker, BlockingGraph
from depal.selection.relations import EXACT, PERCEIVED, Relation, Tolerances
from depal.selection.score import (
    PAPER_WEIGHTS,
    PositionWeights,
    ScoreRule,
    geometric_rank,
    position_priority,
)
from depal.selection.select import LeafAlone, leaf_alone, select

__all__ = [
    "EXACT",
    "PAPER_WEIGHTS",
    "PERCEIVED",
    "Aim",
    "Blocker",
    "Blocking",
    "BlockingGraph",
    "Change",
    "Decision",
    "Explanation",
    "Fate",
    "LeafAlone",
    "Outcome",
    "Parts",
    "PositionWeights",
    "Refused",
    "Relation",
    "ScoreRule",
    "Scores",
    "Tolerances",
    "Verdict",
    "explain",
    "geometric_rank",
    "leaf_alone",
    "link_prisms",
    "position_priority",
    "select",
]
