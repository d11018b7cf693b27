"""Fig. 5: a group of boxes with a requested one in its middle."""

from dataclasses import dataclass

from depal.domain import BoxId, Detection, Request
from depal.geometry import OrientedBox
from depal.selection import EXACT, BlockingGraph, ScoreRule, Verdict, leaf_alone, select

REQUESTED = BoxId("b4")
PRIORITY = 0.8
WEIGHT = 0.5
X_MAX = 2.2

_FRONT, _DEPTH = 1.5, 0.3
# name: left end along y, bottom, width, height [m]; b8 alone stands in front of the others.
_GROUP = {
    "b1": (0.75, 0.00, 0.45, 0.30),
    "b2": (0.30, 0.00, 0.50, 0.30),
    "b3": (-0.20, 0.00, 0.50, 0.30),
    "b4": (0.55, 0.30, 0.50, 0.25),
    "b5": (0.05, 0.30, 0.60, 0.25),
    "b6": (0.75, 0.55, 0.45, 0.25),
    "b7": (0.30, 0.55, 0.40, 0.25),
}
_BEFORE = ("b8", (0.42, 0.00, 0.28, 0.48))


@dataclass(frozen=True, slots=True)
class Group:
    """The group, its selection, and T of the requested box."""

    boxes: tuple[Detection, ...]
    verdicts: tuple[Verdict, ...]
    reachable: frozenset[BoxId]


def fig5() -> Group:
    """Selects among the group with b4 requested."""
    boxes = tuple(_box(name, _FRONT, *place) for name, place in _GROUP.items())
    boxes += (_box(_BEFORE[0], _FRONT - _DEPTH, *_BEFORE[1]),)
    graph = BlockingGraph(boxes, EXACT)
    request = Request(priority=PRIORITY, box=REQUESTED)
    decision = select(graph, [request], ScoreRule(WEIGHT, X_MAX), leaf_alone)
    return Group(boxes, decision.verdicts, graph.reachable(REQUESTED))


def _box(
    name: str, near: float, left: float, bottom: float, width: float, height: float
) -> Detection:
    corner = (near, left - width, bottom)
    return Detection(BoxId(name), OrientedBox.from_corner(corner, (_DEPTH, width, height)))
