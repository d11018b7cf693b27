"""The referee of perception: what a look got right, and how far off it was."""

from depal.studies.perception.identity import Identities, Names
from depal.studies.perception.matching import Matching, match_faces, matched
from depal.studies.perception.poses import PoseError, pose_error
from depal.studies.perception.relations import RelationCounts, TrueRelations, true_relations
from depal.studies.perception.score import Detected, Score, scored
from depal.studies.perception.truth import TrueBox, TrueFace, Truth, truth_of

__all__ = [
    "Detected",
    "Identities",
    "Matching",
    "Names",
    "PoseError",
    "RelationCounts",
    "Score",
    "TrueBox",
    "TrueFace",
    "TrueRelations",
    "Truth",
    "match_faces",
    "matched",
    "pose_error",
    "scored",
    "true_relations",
    "truth_of",
]
