"""Forces that carry a pile, box by box from the top: fast, and never too hopeful.

Every box hands what it carries down to what it stands on as a rigid body on springs would, one
spring in each corner of its contact patches, none of which pulls. Forces that balance every box
and stay within friction prove that the pile can stand, so the greatest acceleration for which
they are found is a lower bound of the margin. Side faces do not help here; `program` counts them.
"""

import numpy as np

from depal.geometry import kernel, loop_kernel
from depal.selection.stability.patches import PX, PY, PZ, SECOND, Array, Indices

STANDS = -1
"""Every box is carried."""

_DONE = 6
"""The column of the loads that tells whether a box has been looked at; before it, the load."""

_ROUNDS = 24
_FLAT = 1e-12
_NOTHING = 1e-12


@kernel
def first_falling(
    centres: Array,
    masses: Array,
    order: Indices,
    starts: Indices,
    bodies: Indices,
    points: Array,
    friction: float,
    push: tuple[float, float],
) -> int:
    """The first box, from the top, for which no forces are found; STANDS where there is none.

    Args:
        centres: (n, 3 or more) centres of mass [m].
        masses: (n,) [kg]; 0 for a box that is not there.
        order: (n,) rows from the highest bottom to the lowest.
        starts: (n + 1,) the corners on which row i stands are starts[i] .. starts[i + 1] - 1.
        bodies: (m, 3) see Touches; only what is ON_TOP, of boxes that are there.
        points: (m, 5) see Touches.
        friction: of every contact.
        push: sideways acceleration along x and y [g].

    Returns:
        A row, or STANDS.
    """
    loads = np.zeros((len(masses), _DONE + 1))
    normals = np.empty(len(bodies))
    for row in order:
        if masses[row] <= 0.0:
            continue
        loads[row, 0] += masses[row] * push[0]
        loads[row, 1] += masses[row] * push[1]
        loads[row, 2] -= masses[row]
        corners = (starts[row], starts[row + 1])
        if not _pressed(loads[row], centres[row], corners, points, normals):
            return int(row)
        if not _handed_on(row, corners, centres, bodies, points, normals, loads, friction):
            return int(row)
        loads[row, _DONE] = 1.0
    return STANDS


@loop_kernel
def _pressed(
    load: Array, centre: Array, corners: tuple[int, int], points: Array, normals: Array
) -> bool:
    """Finds the normal forces of the springs under one box; False where none carry it."""
    first, last = corners
    weight = -load[2]
    if last == first or weight <= _NOTHING:
        return False
    level = points[first, PZ] - centre[2]
    # Where the force from below must act for no moment to be left.
    mx = centre[0] + (load[4] - level * load[0]) / weight
    my = centre[1] + (-load[3] - level * load[1]) / weight
    for corner in range(first, last):
        normals[corner] = 1.0
    for _ in range(_ROUNDS):
        s1, sx, sy, sxx, sxy, syy = 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
        for corner in range(first, last):
            if normals[corner] > 0.0:
                x, y = points[corner, PX] - mx, points[corner, PY] - my
                s1, sx, sy = s1 + 1.0, sx + x, sy + y
                sxx, sxy, syy = sxx + x * x, sxy + x * y, syy + y * y
        # The plane of pressures whose sum is the weight, without a moment about the middle.
        p, q, r = sxx * syy - sxy * sxy, sy * sxy - sx * syy, sx * sxy - sy * sxx
        whole = s1 * p + sx * q + sy * r
        if not whole > _FLAT:
            return False
        changed = False
        for corner in range(first, last):
            x, y = points[corner, PX] - mx, points[corner, PY] - my
            pressure = weight * (p + q * x + r * y) / whole
            changed = changed or (pressure > 0.0) != (normals[corner] > 0.0)
            normals[corner] = pressure
        if not changed:
            return True
    return False


@loop_kernel
def _handed_on(
    row: int,
    corners: tuple[int, int],
    centres: Array,
    bodies: Indices,
    points: Array,
    normals: Array,
    loads: Array,
    friction: float,
) -> bool:
    """Adds friction to the normal forces and loads what is below; False where it slips."""
    first, last = corners
    weight = -loads[row, 2]
    middle_x, middle_y, spread = 0.0, 0.0, 0.0
    for corner in range(first, last):
        share = max(normals[corner], 0.0) / weight
        middle_x += share * points[corner, PX]
        middle_y += share * points[corner, PY]
    for corner in range(first, last):
        share = max(normals[corner], 0.0) / weight
        x, y = points[corner, PX] - middle_x, points[corner, PY] - middle_y
        spread += share * (x * x + y * y)
    # What the friction must hold: the push, and what turns the box about the middle of pressure.
    tx, ty = -loads[row, 0], -loads[row, 1]
    x, y = middle_x - centres[row, 0], middle_y - centres[row, 1]
    turn = -loads[row, 5] - (x * ty - y * tx)
    rate = turn / spread  # pressed corners never lie on one line
    for corner in range(first, last):
        if normals[corner] <= 0.0:
            continue
        share = normals[corner] / weight
        fx = share * (tx - rate * (points[corner, PY] - middle_y))
        fy = share * (ty + rate * (points[corner, PX] - middle_x))
        if abs(fx) + abs(fy) > friction * normals[corner] + _NOTHING * weight:
            return False
        below = bodies[corner, SECOND]
        if below >= 0:
            if loads[below, _DONE] > 0.0:
                return False
            fz = share * weight
            x, y = points[corner, PX] - centres[below, 0], points[corner, PY] - centres[below, 1]
            z = points[corner, PZ] - centres[below, 2]
            loads[below, 0] -= fx
            loads[below, 1] -= fy
            loads[below, 2] -= fz
            loads[below, 3] += z * fy - y * fz
            loads[below, 4] += x * fz - z * fx
            loads[below, 5] += y * fx - x * fy
    return True
