"""The ways that geometry leaves: to a box from above, and from the front.

From above a box waits for whatever lies over it, at whatever distance; what stands before it does
not matter. From the front it waits for what stands before it and for what rests on it: a bridge
over a gap above it may stay. In a packing without gaps what is over a box is reached through what
rests on it, so the front's closure holds that of above, and equals the paper's T(b).
"""

from collections.abc import Iterable, Sequence
from typing import Any

import numpy as np
import numpy.typing as npt

from depal.domain import Approach
from depal.geometry import footprint_overlap, kernel
from depal.selection.access.ways import Mask, Way, Ways
from depal.selection.relations import (
    A_BEFORE_B,
    A_ON_B,
    B_BEFORE_A,
    B_ON_A,
    HALF_HEIGHT,
    Tolerances,
    Z,
    relate,
)

Array = npt.NDArray[np.float64]
Codes = npt.NDArray[np.uint8]

OVER, BEFORE, RESTS = 1, 2, 4
"""How a box stands to another: over it, before it, directly on it."""

BOTH_WAYS = (Approach.VERTICAL, Approach.HORIZONTAL)


@kernel
def standings(prisms: Array, used: npt.NDArray[np.intp], overlap: float, slack: float) -> Codes:
    """How every box stands to every other.

    Args:
        prisms: (n, 8).
        used: the rows that hold a box.
        overlap: see Tolerances [m].
        slack: see Tolerances [m]; what stands no further than this over a box rests on it.

    Returns:
        (n, n), a sum of OVER, BEFORE and RESTS in row a, column b: of b to a.
    """
    codes = np.zeros((len(prisms), len(prisms)), np.uint8)
    for i in range(len(used)):
        for j in range(i + 1, len(used)):
            a, b = used[i], used[j]
            code = relate(prisms, a, b, overlap, slack)
            gap = abs(prisms[a, Z] - prisms[b, Z]) - prisms[a, HALF_HEIGHT] - prisms[b, HALF_HEIGHT]
            rests = RESTS if gap <= slack else 0
            if code & B_ON_A:
                codes[a, b] |= OVER | rests
            if code & A_ON_B:
                codes[b, a] |= OVER | rests
            if code & B_BEFORE_A:
                codes[a, b] |= BEFORE
            if code & A_BEFORE_B:
                codes[b, a] |= BEFORE
    return codes


def free_ways(
    prisms: Array,
    tolerances: Tolerances,
    used: Iterable[int] | None = None,
    allowed: Sequence[Sequence[Approach]] | None = None,
) -> Ways:
    """The ways that the boxes alone leave: a tool without extent, an arm that reaches everything.

    Args:
        prisms: (n, 8) in the cell frame, the robot looking along +x.
        tolerances: how wrong the poses may be.
        used: the rows that hold a box; None for all.
        allowed: per row the approaches that its product allows; None for both.

    Returns:
        The AND/OR graph over the rows.
    """
    rows = list(range(len(prisms)) if used is None else used)
    codes = standings(prisms, np.array(rows, np.intp), tolerances.overlap, tolerances.slack)
    over, front = masks(codes & OVER), masks(codes & (BEFORE | RESTS))
    blockers = {Approach.VERTICAL: over, Approach.HORIZONTAL: front}
    return Ways.among(
        rows,
        (
            Way(row, approach, blockers[approach][row])
            for row in rows
            for approach in (BOTH_WAYS if allowed is None else allowed[row])
        ),
    )


@kernel
def crowding(prisms: Array, used: npt.NDArray[np.intp], swept: Array, overlap: float) -> Codes:
    """Which boxes reach into swept spaces.

    Args:
        prisms: (n, 8).
        used: the rows that hold a box.
        swept: (m, 8) upright prisms that have to be empty.
        overlap: boxes may reach into them by this [m].

    Returns:
        (m, n) 1 where a box reaches into a space.
    """
    found = np.zeros((len(swept), len(prisms)), np.uint8)
    both = np.empty((2, 8))
    for k in range(len(swept)):
        both[0] = swept[k]
        for row in used:
            both[1] = prisms[row]
            apart = abs(both[0, Z] - both[1, Z])
            if both[0, HALF_HEIGHT] + both[1, HALF_HEIGHT] - apart <= overlap:
                continue
            if footprint_overlap(both, 0, 1) > overlap:
                found[k, row] = 1
    return found


def masks(codes: npt.NDArray[np.integer[Any]]) -> list[Mask]:
    """Per row the set of the columns that are not 0."""
    return [
        int.from_bytes(np.packbits(row != 0, bitorder="little").tobytes(), "little")
        for row in codes
    ]
