"""Whether two solids come closer than a margin: kernels over boxes, spheres and segments."""

import math

import numpy as np
import numpy.typing as npt

from depal.geometry import loop_kernel

Array = npt.NDArray[np.float64]


@loop_kernel
def sphere_meets_box(
    x: float, y: float, z: float, radius: float, centre: Array, rotation: Array, half: Array
) -> bool:
    """Whether a sphere reaches into a box; centre (3,), rotation (3, 3), half edges (3,) [m]."""
    dx, dy, dz = x - centre[0], y - centre[1], z - centre[2]
    gap = 0.0
    for axis in range(3):
        along = dx * rotation[0, axis] + dy * rotation[1, axis] + dz * rotation[2, axis]
        beyond = abs(along) - half[axis]
        if beyond > radius:
            return False
        if beyond > 0.0:
            gap += beyond * beyond
    return gap <= radius * radius


@loop_kernel
def boxes_meet(  # noqa: C901, PLR0911, PLR0912 - fifteen axes, the first that parts ends it
    c1: Array, r1: Array, h1: Array, c2: Array, r2: Array, h2: Array, margin: float
) -> bool:
    """Whether two boxes, the first grown by a margin on each side, overlap (separating axes).

    A negative margin shrinks the first box; one that vanishes meets nothing.
    """
    a0, a1, a2 = h1[0] + margin, h1[1] + margin, h1[2] + margin
    if a0 <= 0.0 or a1 <= 0.0 or a2 <= 0.0:
        return False
    dx, dy, dz = c2[0] - c1[0], c2[1] - c1[1], c2[2] - c1[2]
    # Rotation of the second seen from the first, and the shift along the first's axes.
    t0 = dx * r1[0, 0] + dy * r1[1, 0] + dz * r1[2, 0]
    t1 = dx * r1[0, 1] + dy * r1[1, 1] + dz * r1[2, 1]
    t2 = dx * r1[0, 2] + dy * r1[1, 2] + dz * r1[2, 2]
    m00 = r1[0, 0] * r2[0, 0] + r1[1, 0] * r2[1, 0] + r1[2, 0] * r2[2, 0]
    m01 = r1[0, 0] * r2[0, 1] + r1[1, 0] * r2[1, 1] + r1[2, 0] * r2[2, 1]
    m02 = r1[0, 0] * r2[0, 2] + r1[1, 0] * r2[1, 2] + r1[2, 0] * r2[2, 2]
    b0, b1, b2 = h2[0], h2[1], h2[2]
    n00, n01, n02 = abs(m00), abs(m01), abs(m02)
    if abs(t0) > a0 + b0 * n00 + b1 * n01 + b2 * n02:
        return False
    m10 = r1[0, 1] * r2[0, 0] + r1[1, 1] * r2[1, 0] + r1[2, 1] * r2[2, 0]
    m11 = r1[0, 1] * r2[0, 1] + r1[1, 1] * r2[1, 1] + r1[2, 1] * r2[2, 1]
    m12 = r1[0, 1] * r2[0, 2] + r1[1, 1] * r2[1, 2] + r1[2, 1] * r2[2, 2]
    n10, n11, n12 = abs(m10), abs(m11), abs(m12)
    if abs(t1) > a1 + b0 * n10 + b1 * n11 + b2 * n12:
        return False
    m20 = r1[0, 2] * r2[0, 0] + r1[1, 2] * r2[1, 0] + r1[2, 2] * r2[2, 0]
    m21 = r1[0, 2] * r2[0, 1] + r1[1, 2] * r2[1, 1] + r1[2, 2] * r2[2, 1]
    m22 = r1[0, 2] * r2[0, 2] + r1[1, 2] * r2[1, 2] + r1[2, 2] * r2[2, 2]
    n20, n21, n22 = abs(m20), abs(m21), abs(m22)
    if abs(t2) > a2 + b0 * n20 + b1 * n21 + b2 * n22:
        return False
    if abs(t0 * m00 + t1 * m10 + t2 * m20) > a0 * n00 + a1 * n10 + a2 * n20 + b0:
        return False
    if abs(t0 * m01 + t1 * m11 + t2 * m21) > a0 * n01 + a1 * n11 + a2 * n21 + b1:
        return False
    if abs(t0 * m02 + t1 * m12 + t2 * m22) > a0 * n02 + a1 * n12 + a2 * n22 + b2:
        return False
    # The nine cross products; parallel edges give short axes that separate nothing, so they are
    # safe to test with a little slack.
    e = 1e-9
    if abs(t2 * m10 - t1 * m20) > a1 * n20 + a2 * n10 + b1 * n02 + b2 * n01 + e:
        return False
    if abs(t2 * m11 - t1 * m21) > a1 * n21 + a2 * n11 + b0 * n02 + b2 * n00 + e:
        return False
    if abs(t2 * m12 - t1 * m22) > a1 * n22 + a2 * n12 + b0 * n01 + b1 * n00 + e:
        return False
    if abs(t0 * m20 - t2 * m00) > a0 * n20 + a2 * n00 + b1 * n12 + b2 * n11 + e:
        return False
    if abs(t0 * m21 - t2 * m01) > a0 * n21 + a2 * n01 + b0 * n12 + b2 * n10 + e:
        return False
    if abs(t0 * m22 - t2 * m02) > a0 * n22 + a2 * n02 + b0 * n11 + b1 * n10 + e:
        return False
    if abs(t1 * m00 - t0 * m10) > a0 * n10 + a1 * n00 + b1 * n22 + b2 * n21 + e:
        return False
    if abs(t1 * m01 - t0 * m11) > a0 * n11 + a1 * n01 + b0 * n22 + b2 * n20 + e:
        return False
    return not abs(t1 * m02 - t0 * m12) > a0 * n12 + a1 * n02 + b0 * n21 + b1 * n20 + e


@loop_kernel
def segments_within(p: Array, q: Array, r: Array, s: Array, distance: float) -> bool:
    """Whether two segments, p to q and r to s, come within a distance [m] of each other."""
    ux, uy, uz = q[0] - p[0], q[1] - p[1], q[2] - p[2]
    vx, vy, vz = s[0] - r[0], s[1] - r[1], s[2] - r[2]
    wx, wy, wz = p[0] - r[0], p[1] - r[1], p[2] - r[2]
    a = ux * ux + uy * uy + uz * uz
    e = vx * vx + vy * vy + vz * vz
    f = vx * wx + vy * wy + vz * wz
    tiny = 1e-12
    if a <= tiny and e <= tiny:
        t, k = 0.0, 0.0
    elif a <= tiny:
        t, k = 0.0, min(max(f / e, 0.0), 1.0)
    else:
        c = ux * wx + uy * wy + uz * wz
        if e <= tiny:
            t, k = min(max(-c / a, 0.0), 1.0), 0.0
        else:
            b = ux * vx + uy * vy + uz * vz
            slope = a * e - b * b
            t = min(max((b * f - c * e) / slope, 0.0), 1.0) if slope > tiny else 0.0
            k = (b * t + f) / e
            if k < 0.0:
                t, k = min(max(-c / a, 0.0), 1.0), 0.0
            elif k > 1.0:
                t, k = min(max((b - c) / a, 0.0), 1.0), 1.0
    dx = wx + t * ux - k * vx
    dy = wy + t * uy - k * vy
    dz = wz + t * uz - k * vz
    return math.sqrt(dx * dx + dy * dy + dz * dz) <= distance
