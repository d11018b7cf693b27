"""Whether the cases of a stack can stand where the file says they stand."""

from collections.abc import Iterator, Sequence

import numpy as np
import numpy.typing as npt

from depal.geometry import Vector3
from depal.logistics.findings import Finding
from depal.logistics.parts import ROUNDING, TOLERANCE, StackPart

Array = npt.NDArray[np.float64]

_ROWS = 64
"""Cases that are compared with all others at once: bounds the memory."""

_NAMED = 5
"""How many neighbours one finding names."""


def cases_beyond_the_pallet(stack: Sequence[StackPart], pallet: Vector3) -> Iterator[Finding]:
    """Every case that reaches over an edge of the pallet or below its deck.

    Args:
        stack: the stacked cases.
        pallet: length, width and deck height of the pallet [m].

    Yields:
        One finding per case, with every side that it reaches over.
    """
    length, width, _ = pallet
    for case in stack:
        if case.corner is None:
            continue
        (x, y, z), (a, b, _) = case.corner, case.size or (0.0, 0.0, 0.0)
        sides = [
            ("x", x, -x),
            ("y", y, -y),
            ("z", z, -z),
            ("x", x + a, x + a - length),
            ("y", y + b, y + b - width),
        ]
        reached = [
            f"{axis} = {end:.6g} m" for axis, end, depth in sides if depth > TOLERANCE + ROUNDING
        ]
        if reached:
            expected = f"x in 0..{length:g}, y in 0..{width:g} and z >= 0 m"
            what = f"is not on the pallet: reaches to {', '.join(reached)}"
            yield Finding(("stack", case.index), what, expected)


def cases_that_overlap(stack: Sequence[StackPart]) -> Iterator[Finding]:
    """Every case that reaches into one that comes later in the file.

    Args:
        stack: the stacked cases; those without a sound corner and size are left out.

    Yields:
        One finding per case, which names the first of the cases that it reaches into.
    """
    solid = _solid(stack)
    for rows, shared in _shared_edges(solid):
        depth = np.minimum(np.minimum(shared[0], shared[1]), shared[2])
        deep = (depth > TOLERANCE + ROUNDING) & (np.arange(len(solid)) > rows[:, None])
        for row in np.flatnonzero(deep.any(axis=1)):
            others = np.flatnonzero(deep[row])
            named = [
                f"stack[{solid[other].index}] by {depth[row, other] * 1000:.0f} mm"
                for other in others[:_NAMED]
            ]
            more = f" and {len(others) - _NAMED} more" if len(others) > _NAMED else ""
            what = f"overlaps {', '.join(named)}{more}"
            loc = ("stack", solid[rows[row]].index)
            yield Finding(loc, what, "cases that share no space")


def cases_that_float(stack: Sequence[StackPart]) -> Iterator[Finding]:
    """Every case above the deck under which no other case ends.

    Args:
        stack: the stacked cases; where one has no sound corner or size nothing is said, for
            it may be the one that carries.

    Yields:
        One finding per case.
    """
    solid = _solid(stack)
    if len(solid) < len(stack):
        return
    bottoms = np.array([case.corner[2] for case in solid if case.corner])
    tops = bottoms + [case.size[2] for case in solid if case.size]
    for rows, shared in _shared_edges(solid):
        above = (shared[0] > TOLERANCE) & (shared[1] > TOLERANCE)
        touching = np.abs(tops - bottoms[rows, None]) <= TOLERANCE + ROUNDING
        carrying = above & touching & (np.arange(len(solid)) != rows[:, None])
        for row in rows[~carrying.any(axis=1) & (bottoms[rows] > TOLERANCE + ROUNDING)]:
            what = f"floats: nothing ends under its bottom at z = {bottoms[row]:.6g} m"
            yield Finding(("stack", solid[row].index), what, "a case whose top is there, or z = 0")


def _solid(stack: Sequence[StackPart]) -> list[StackPart]:
    return [case for case in stack if case.corner is not None and case.size is not None]


def _shared_edges(solid: Sequence[StackPart]) -> Iterator[tuple[npt.NDArray[np.intp], Array]]:
    """How far cases share the x, y and z of others [m]; negative where they are apart.

    Yields:
        The indices of some cases, (r,), and what each shares with every case, (3, r, n).
    """
    low = np.array([case.corner for case in solid], dtype=np.float64).reshape(-1, 3).T.copy()
    high = low + np.array([case.size for case in solid], dtype=np.float64).reshape(-1, 3).T
    for start in range(0, len(solid), _ROWS):
        rows = np.arange(start, min(start + _ROWS, len(solid)))
        upper = np.minimum(high[:, rows, None], high[:, None])
        yield rows, upper - np.maximum(low[:, rows, None], low[:, None])
