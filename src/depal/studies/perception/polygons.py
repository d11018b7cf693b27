"""How well two areas agree: the intersection over the union."""

import numpy as np
import numpy.typing as npt

Floats = npt.NDArray[np.float64]


def area_of(corners: Floats) -> float:
    """The area of a polygon, (n, 2) in order, either way round."""
    return abs(_signed_area(corners))


def common_area(first: Floats, second: Floats) -> float:
    """The area that two convex polygons share (Sutherland and Hodgman's clipping).

    Args:
        first: (n, 2) in order, either way round.
        second: (m, 2) the same.
    """
    left = first
    edges = second if _signed_area(second) >= 0 else second[::-1]
    for start, end in zip(edges, np.roll(edges, -1, axis=0), strict=True):
        left = _kept(left, start, end - start)
        if len(left) < 3:  # noqa: PLR2004 - no area
            return 0.0
    return area_of(left)


def agreement(first: Floats, second: Floats) -> float:
    """Intersection over union of two convex polygons, in [0, 1]; 0 where both have no area."""
    common = common_area(first, second)
    union = area_of(first) + area_of(second) - common
    return min(common / union, 1.0) if union > 0 else 0.0


def _signed_area(corners: Floats) -> float:
    x, y = (corners - corners[0]).T
    return float(x @ np.roll(y, -1) - y @ np.roll(x, -1)) / 2


def _kept(corners: Floats, start: Floats, way: Floats) -> Floats:
    """The part of a polygon to the left of a line."""
    beside = way[0] * (corners[:, 1] - start[1]) - way[1] * (corners[:, 0] - start[0])
    kept: list[Floats] = []
    for i, corner in enumerate(corners):
        j = i + 1 if i + 1 < len(corners) else 0
        if beside[i] >= 0:
            kept.append(corner)
        if (beside[i] >= 0) != (beside[j] >= 0):
            share = beside[i] / (beside[i] - beside[j])
            kept.append(corner + share * (corners[j] - corner))
    return np.array(kept).reshape(-1, 2)
