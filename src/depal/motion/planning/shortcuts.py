"""Shorter paths: detours are cut off at random, then corners are pulled straight."""

import numpy as np

from depal.geometry import kernel
from depal.motion.collision.checking import Case
from depal.motion.collision.edges import edge_is_free
from depal.motion.collision.values import Array
from depal.motion.planning.axes import Axes, span
from depal.motion.planning.samples import stream_of, uniform

PASSES = 6
"""So often every corner is pulled at the most."""

WORTH = 1e-3
"""A gain below this is none [s]."""


@kernel
def shorten(case: Case, axes: Axes, path: Array, tries: int, seed: int) -> Array:
    """A path with its detours cut off: straight joint lines between random points of it."""
    stream = stream_of(seed)
    points = path.copy()
    for _ in range(tries):
        n = len(points)
        if n < 3:  # noqa: PLR2004 - nothing to cut
            return points
        lengths = np.zeros(n)
        for k in range(1, n):
            lengths[k] = lengths[k - 1] + span(points[k - 1], points[k], axes.speed)
        total = lengths[n - 1]
        s, e = total * uniform(stream), total * uniform(stream)
        if s > e:
            s, e = e, s
        i = min(max(np.searchsorted(lengths, s, side="right") - 1, 0), n - 2)
        j = min(max(np.searchsorted(lengths, e, side="right") - 1, 0), n - 2)
        if i == j:
            continue
        a = _between(points, lengths, i, s)
        b = _between(points, lengths, j, e)
        if span(a, b, axes.speed) > 0.999 * (e - s):
            continue
        if not edge_is_free(case, a, b, axes.step):
            continue
        cut = np.empty((i + 1 + 2 + n - 1 - j, 6))
        cut[: i + 1] = points[: i + 1]
        cut[i + 1] = a
        cut[i + 2] = b
        cut[i + 3 :] = points[j + 1 :]
        points = cut
    return points


@kernel
def _between(points: Array, lengths: Array, k: int, s: float) -> Array:
    part = lengths[k + 1] - lengths[k]
    u = (s - lengths[k]) / part if part > 0.0 else 0.0
    between: Array = points[k] + (points[k + 1] - points[k]) * u
    return between


@kernel
def pull(case: Case, axes: Axes, path: Array) -> Array:
    """A path whose corners are pulled towards the straight line, as far as it stays free."""
    points, old = path.copy(), np.empty(6)
    for _ in range(PASSES):
        gain = 0.0
        for k in range(1, len(points) - 1):
            before, after = points[k - 1], points[k + 1]
            old[:] = points[k]
            one, other = span(before, old, axes.speed), span(old, after, axes.speed)
            whole = one + other
            if whole - span(before, after, axes.speed) < WORTH:
                continue
            middle = before + (after - before) * (one / whole)
            share = 1.0
            while share > 0.05:  # noqa: PLR2004 - nothing is left to gain
                new = old + (middle - old) * share
                now = span(before, new, axes.speed) + span(new, after, axes.speed)
                if (
                    whole - now > WORTH
                    and edge_is_free(case, before, new, axes.step)
                    and edge_is_free(case, new, after, axes.step)
                ):
                    points[k] = new
                    gain += whole - now
                    break
                share *= 0.6
        if gain < WORTH:
            break
    return points
