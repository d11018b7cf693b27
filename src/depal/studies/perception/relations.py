"""Whether what stands on what, and what hides what, was seen as it is (section II-C).

The relations are the selection's: one box is on another when their footprints overlap and it is
higher, at whatever distance; it hides another when they overlap as seen from the robot and it is
nearer. A relation is asked for where it holds by a clear margin; it is accepted where it holds at
all; in between it is neither right nor wrong.
"""

from collections.abc import Callable, Collection, Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np

from depal.geometry import OrientedBox, prisms_of
from depal.perception.faces import Relation
from depal.selection.relations import A_BEFORE_B, A_ON_B, B_BEFORE_A, B_ON_A, relate
from depal.studies.statistics import Share

Pair = tuple[int, int]
"""Which is on top or hides, and which it does this to."""

CLEAR = 0.01
"""Boxes that overlap by more than this certainly stand on, or hide, each other [m]."""

BARELY = 0.0005
"""Boxes that overlap by less than this do not [m]."""

SLACK = 0.02
"""Real boxes reach into each other by so much at the most, where they bulge or settle [m]."""

LIKELY = 0.5
"""A relation of a greater probability is believed."""


@dataclass(frozen=True, slots=True)
class TrueRelations:
    """Of one kind, between boxes by their indices.

    Attributes:
        asked: must be seen.
        accepted: may be seen; those that must be included.
    """

    asked: frozenset[Pair]
    accepted: frozenset[Pair]


@dataclass(frozen=True, slots=True)
class RelationCounts:
    """Of one kind.

    Attributes:
        right: believed relations that hold, of those that are not in between.
        found: relations that must be seen and were.
    """

    right: Share = field(default_factory=Share)
    found: Share = field(default_factory=Share)

    def __add__(self, other: "RelationCounts") -> "RelationCounts":
        """Both together."""
        return RelationCounts(self.right + other.right, self.found + other.found)


def true_relations(shapes: Sequence[OrientedBox]) -> tuple[TrueRelations, TrueRelations]:
    """What stands on what, and what hides what from somebody at the robot, of true shapes."""
    clear, barely = _coded(shapes, CLEAR), _coded(shapes, BARELY)
    return (
        TrueRelations(clear(A_ON_B, B_ON_A), barely(A_ON_B, B_ON_A)),
        TrueRelations(clear(A_BEFORE_B, B_BEFORE_A), barely(A_BEFORE_B, B_BEFORE_A)),
    )


def judged(
    seen: Collection[Relation], true: TrueRelations, matched: Mapping[int, int]
) -> RelationCounts:
    """Counts the relations between boxes that were found.

    Args:
        seen: of one kind, by the indices of seen boxes.
        true: of the same kind, by the indices of true boxes.
        matched: seen boxes with the true ones that they are; others are left out.
    """
    believed = {
        (matched[relation.upper], matched[relation.lower])
        for relation in seen
        if relation.probability > LIKELY and {relation.upper, relation.lower} <= matched.keys()
    }
    there = set(matched.values())
    asked = {pair for pair in true.asked if there.issuperset(pair)}
    counted = believed & true.asked | believed - true.accepted
    return RelationCounts(
        Share(len(counted & true.asked), len(counted)), Share(len(believed & asked), len(asked))
    )


def _coded(shapes: Sequence[OrientedBox], overlap: float) -> Callable[[int, int], frozenset[Pair]]:
    """Asks for the pairs whose first stands in a relation to the second, by its two codes."""
    prisms = np.ascontiguousarray(prisms_of(shapes))
    codes = {
        (a, b): relate(prisms, a, b, overlap, SLACK)
        for a in range(len(shapes))
        for b in range(a + 1, len(shapes))
    }

    def pairs(first: int, second: int) -> frozenset[Pair]:
        return frozenset(
            pair if code & first else pair[::-1]
            for pair, code in codes.items()
            if code & (first | second)
        )

    return pairs
