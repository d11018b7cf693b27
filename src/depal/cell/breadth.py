"""How broad a box may be that nobody has named: a hand that passes keeps clear of all of it."""

import numpy as np

from depal.cell.identity import ALIKE as EITHER_WAY
from depal.cell.identity import SIZE_SPARE, plausible
from depal.cell.sight.naming import ALIKE
from depal.cell.sight.unexplained import ALONG
from depal.domain import Delivery, Perceived, Recognition
from depal.geometry import OrientedBox, Pose, Vector3
from depal.motion.grasping import EXACT

SIDEWAYS = 0.008
"""A box that no print has named is seen this far off to the side [m]."""

NAMED = 0.005
"""So much farther out than it seems a box with a name is carried: its print tells where it is to a
millimetre or two, but of some it is laid on wrongly by a centimetre [m]."""

UPRIGHT = 0.04
"""And one of which nobody has seen an edge so far up or down [m]."""

ASKEW = 0.002
"""A box stands askew whose turn against the pallet has a greater sine; the pile squares others."""

BESIDE = 0.03
"""A held box keeps so far from boxes that no print has named: two of them may be seen as one whose
edges lie elsewhere [m]."""


def astray(beyond: Vector3, *, unsized: bool = False) -> Vector3:
    """How much farther out a box may be than it seems: no less than looks err [m].

    Args:
        beyond: how much longer it may be along its own axes, at either end [m].
        unsized: whether an edge of it is a guess: then so is where it ends below.
    """
    a, b, c = beyond
    return max(a, SIDEWAYS), max(b, SIDEWAYS), max(c, UPRIGHT if unsized else 0.0)


def named_astray(box: OrientedBox, pallet: Pose, *, tried: bool = False) -> Vector3:
    """How much farther out a box with a name may be than it seems, at either end of its axes [m].

    Its name tells how large it is, and most are seen where they are, to `NAMED`. One that seems to
    stand askew may stand square, seen with an error that moves its middle as well; one that was
    tried in vain may lie the other way.

    Args:
        box: upright, in the cell frame.
        pallet: `cell_from_pallet`.
        tried: whether it was tried in vain.
    """
    turn = (pallet.inverse @ box.pose).rotation
    across = min(abs(turn[0][0]), abs(turn[1][0]))
    a, b, _ = box.size
    skew = [NAMED, NAMED]
    if across > ASKEW:
        skew = [b / 2 * across + SIDEWAYS, a / 2 * across + SIDEWAYS]
    longer = max(a, b) if tried else 0.0
    return max(skew[0], (longer - a) / 2), max(skew[1], (longer - b) / 2), 0.0


def as_broad_as_it_may_be(
    box: Perceived, delivery: Delivery, *, unsized: bool = False
) -> OrientedBox:
    """The room that a box may take beside others.

    Of products of nearly one size the wrong one is soon believed, a lower one too, a nearly
    square one turned the other way, and at which of its ends an edge was seen wrongly nobody
    knows. What has the size of none is no one box, and reaches as far as what is seen beside
    and above it counts as its own; so does, upward, what has the size of one but roughly: its
    edges were seen wrongly. What has an edge that nobody saw has a product's size by that guess
    alone: it is as broad as what has none. A name tells.

    Args:
        box: upright.
        delivery: what it can be.
        unsized: whether an edge of it is a guess.
    """
    shape = box.shape
    if isinstance(box, Recognition):
        return shape
    size = np.array(shape.size)
    most, nearest = size.copy(), np.inf
    for product in plausible(delivery, shape.size):
        along, across, high = product.size
        ways = np.array(((along, across, high), (across, along, high)))
        offs = np.abs(ways - size).max(axis=1)
        if offs.min() > SIZE_SPARE:
            continue
        nearest = min(nearest, float(offs.min()))
        either = abs(along - across) < EITHER_WAY
        most = np.maximum(most, ways[either | (offs <= SIZE_SPARE)].max(axis=0))
    if delivery.lines and np.isinf(nearest):  # of none that stands upright, as boxes do
        most += ALONG
    elif delivery.lines and unsized:
        most[:2] = np.maximum(most[:2], size[:2] + ALONG)
    rough = ALONG if delivery.lines and nearest > ALIKE else 0.0
    most[2] = max(float(most[2]), float(size[2]) + rough)
    width, depth = (2 * (most + SIDEWAYS) - size)[:2].tolist()
    x, y, z = shape.centre
    pose = Pose((x, y, z + float(most[2] - size[2]) / 2), shape.pose.rotation)
    return OrientedBox(pose, (width, depth, float(most[2])))


def room_beside(
    box: Perceived, delivery: Delivery, *, unsized: bool = False, beside: Vector3 = EXACT
) -> OrientedBox:
    """The room around a standing box that a held one keeps out of: what it may take, and more.

    Args:
        box: upright.
        delivery: what it can be.
        unsized: whether an edge of it is a guess.
        beside: how far the surface goes on beside it, at either end of its axes [m].
    """
    if isinstance(box, Recognition):
        return box.shape
    shape = as_broad_as_it_may_be(box, delivery, unsized=unsized)
    a, b, c = shape.size
    along, across = (max(far, BESIDE) for far in beside[:2])
    return OrientedBox(shape.pose, (a + 2 * along, b + 2 * across, c))
