"""The contact-force linear program: the greatest sideways acceleration that a pile sustains.

Unknown are the forces in all corners of all contact patches, each a sum of pushes along the
edges of its friction pyramid, and the acceleration. Six equations balance every box. The program
knows that boxes lean against each other; side faces push, and by default do not hold by friction:
nothing presses the cases of a pile together sideways, so a pile that needs it falls.
"""

from dataclasses import dataclass

import numpy as np
from scipy.optimize import linprog
from scipy.sparse import csc_array

from depal.geometry import kernel
from depal.selection.stability.patches import (
    FIRST,
    NX,
    NY,
    ON_TOP,
    PX,
    PY,
    PZ,
    SECOND,
    WAY,
    Array,
    Indices,
    Touches,
)

SECONDS = 5.0
"""One program may take so long; it takes some ten milliseconds [s]."""

LEAST = -1.0
"""Margins below this are not told apart: the pile cannot stand [g]."""

ARM = 0.2
"""Moments are counted in forces at this arm, about the half of a case [m]."""

_MOVES = 1e-7


@dataclass(frozen=True, slots=True)
class Sustained:
    """One direction's greatest acceleration.

    Attributes:
        most: in the direction of the push [g]; LEAST where the pile cannot stand.
        limiting: the rows that would begin to move.
        solved: False where the solver gave up; `most` is then LEAST.
    """

    most: float
    limiting: tuple[int, ...]
    solved: bool


def sustained(
    centres: Array,
    masses: Array,
    touches: Touches,
    friction: tuple[float, float],
    push: tuple[float, float],
    most: float,
) -> Sustained:
    """Solves the program in one direction.

    Args:
        centres: (n, 3 or more) centres of mass [m].
        masses: (n,) [kg]; 0 for a box that is not there.
        touches: the contacts of the boxes that are there.
        friction: of what stands on something, and of side faces.
        push: the unit direction of the acceleration, along x and y.
        most: no acceleration above this is asked for [g].

    Returns:
        What the pile sustains.
    """
    there = np.flatnonzero(masses > 0)
    place = np.full(len(masses), -1, np.int32)
    place[there] = np.arange(len(there))
    starts, rows, values = _columns(
        centres, place, touches.bodies, touches.points, friction[0], friction[1]
    )
    count = len(starts) - 1
    weight = masses[there] / masses[there].mean()
    sideways = np.array([6 * i + axis for i in range(len(there)) for axis in (0, 1)], np.int32)
    pushes = np.outer(weight, push).ravel()
    matrix = csc_array(
        (
            np.concatenate([values, pushes]),
            np.concatenate([rows, sideways]),
            np.append(starts, len(rows) + len(sideways)),
        ),
        shape=(6 * len(there), count + 1),
    )
    gravity = np.zeros(6 * len(there))
    gravity[2::6] = weight
    bounds = np.zeros((count + 1, 2))
    bounds[:, 1] = np.inf
    bounds[count] = (LEAST, most)
    cost = np.zeros(count + 1)
    cost[count] = -1.0
    result = linprog(  # type: ignore[call-overload] # its types know no sparse matrix
        cost,
        A_eq=matrix,
        b_eq=gravity,
        bounds=bounds,
        method="highs-ds",
        options={"presolve": True, "time_limit": SECONDS},
    )
    if result.status != 0:
        return Sustained(LEAST, (), result.status == 2)  # noqa: PLR2004 - infeasible
    moves = np.abs(result.eqlin.marginals.reshape(-1, 6)).max(axis=1)
    moving = moves > _MOVES * max(moves.max(), _MOVES)
    return Sustained(-float(result.fun), tuple(there[moving].tolist()), solved=True)


@kernel
def _columns(
    centres: Array, place: Indices, bodies: Indices, points: Array, friction: float, beside: float
) -> tuple[Indices, Indices, Array]:
    """The columns of the forces, compressed: starts, rows and values.

    Columns are the pushes along the pyramids' edges, or along the normal where there is no
    friction; rows are the six balances of each box.
    """
    most = 4 * len(bodies)
    starts = np.zeros(most + 1, np.int32)
    rows, values = np.empty(12 * most, np.int32), np.empty(12 * most)
    columns, filled = 0, 0
    for corner in range(len(bodies)):
        on_top = bodies[corner, WAY] == ON_TOP
        mu = friction if on_top else beside
        nx, ny, nz = points[corner, NX], points[corner, NY], 1.0 if on_top else 0.0
        for edge in range(4 if mu > 0.0 else 1):
            along = mu if edge % 2 == 0 else -mu
            # Two edges along x, or across the normal, and two along y, or up and down.
            level = edge < 2  # noqa: PLR2004
            fx = nx + (0.0 if not level else along if on_top else -along * ny)
            fy = ny + ((0.0 if level else along) if on_top else (along * nx if level else 0.0))
            fz = nz + (0.0 if on_top or level else along)
            for side in range(2):
                body = bodies[corner, FIRST if side == 0 else SECOND]
                if body < 0:
                    continue
                sign = 1.0 if side == 0 else -1.0
                x, y = points[corner, PX] - centres[body, 0], points[corner, PY] - centres[body, 1]
                z = points[corner, PZ] - centres[body, 2]
                turn = (y * fz - z * fy, z * fx - x * fz, x * fy - y * fx)
                wrench = (fx, fy, fz, turn[0] / ARM, turn[1] / ARM, turn[2] / ARM)
                for axis in range(6):
                    if wrench[axis] != 0.0:
                        rows[filled] = 6 * place[body] + axis
                        values[filled] = sign * wrench[axis]
                        filled += 1
            columns += 1
            starts[columns] = filled
    return starts[: columns + 1].copy(), rows[:filled].copy(), values[:filled].copy()
