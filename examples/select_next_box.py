"""Which box next, and why: a small pile, one request, one decision."""

from depal.domain import BoxId, Detection, Request
from depal.geometry import OrientedBox
from depal.selection import BlockingGraph, ScoreRule, leaf_alone, select

boxes = [
    Detection(BoxId("low"), OrientedBox.from_corner((1.4, 0.0, 0.0), (0.4, 0.3, 0.2))),
    Detection(BoxId("high"), OrientedBox.from_corner((1.4, 0.0, 0.2), (0.4, 0.3, 0.2))),
    Detection(BoxId("aside"), OrientedBox.from_corner((1.4, -0.5, 0.0), (0.4, 0.3, 0.7))),
]
graph = BlockingGraph(boxes)
rule = ScoreRule(w=0.5, x_max=2.2)
for requests in ([], [Request(priority=0.8, box=BoxId("low"))]):
    decision = select(graph, requests, rule, leaf_alone)
    print(f"{len(requests)} requests: take {decision.target.id if decision.target else 'nothing'}")
    for verdict in decision.verdicts:
        print(
            f"  {verdict.box.id:6} h {verdict.h:.3f}  l {verdict.l:.2f}  s {verdict.s:.3f}"
            f"  {verdict.reason}"
        )
