"""The same selection with a general graph library, where one is installed."""

import time
from collections.abc import Sequence

import numpy as np

from depal.domain import Detection, Request
from depal.selection import ScoreRule

_SLACK = 1e-6


def networkx_selection(
    boxes: Sequence[Detection], request: Request, rule: ScoreRule
) -> float | None:
    """Algorithm 1 as one would write it with numpy and networkx.

    Args:
        boxes: axis-aligned.
        request: for one of them.
        rule: of the score.

    Returns:
        The time of one selection [s], or None where networkx is not installed.
    """
    try:
        import networkx as nx  # noqa: PLC0415 - a peer, not a dependency
    except ImportError:
        return None
    start = time.perf_counter()
    centres = np.array([box.shape.centre for box in boxes])
    halves = np.array([box.shape.size for box in boxes]) / 2
    low, high = centres - halves, centres + halves
    shared = (np.minimum(high[:, None], high[None]) - np.maximum(low[:, None], low[None])) > _SLACK
    on_top = shared[..., 0] & shared[..., 1] & (low[None, :, 2] >= high[:, None, 2] - _SLACK)
    occludes = shared[..., 1] & shared[..., 2] & (high[None, :, 0] <= low[:, None, 0] + _SLACK)
    graph = nx.DiGraph()
    graph.add_nodes_from(range(len(boxes)))
    graph.add_edges_from(np.argwhere(on_top | occludes).tolist())
    wanted = next(i for i, box in enumerate(boxes) if box.id == request.box)
    pulled = {wanted, *nx.descendants(graph, wanted)}
    weights = rule.weights
    h = (
        weights.side * np.abs(centres[:, 1])
        + weights.depth * (rule.x_max - centres[:, 0])
        + weights.height * centres[:, 2]
    )
    scores = {
        i: rule.w * (request.priority if i in pulled else 0.0) + (1 - rule.w) * h[i] for i in graph
    }
    queue = sorted(graph, key=scores.__getitem__, reverse=True)
    next(i for i in queue if graph.out_degree(i) == 0)
    return time.perf_counter() - start
