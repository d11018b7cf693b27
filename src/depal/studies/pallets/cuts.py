"""Cutting a cuboid in two, and on until there are enough."""

from collections.abc import Callable

from depal.errors import SettingError
from depal.studies.pallets.draws import Draw
from depal.studies.pallets.lattice import TICK, Cuboid

Rule = Callable[[list[Cuboid]], tuple[Cuboid, int, float]]
"""Which leaf is cut next, along which axis (0, 1, 2), at which share of its length."""

TRIES_PER_LEAF = 100
"""So many refused cuts in a row, per leaf, and no further cut is expected."""


def cut_up(whole: Cuboid, count: int, rule: Rule, least: int) -> list[Cuboid]:
    """Guillotine cuts: every cut goes right through one leaf.

    A cut that leaves a side below `least` is not made; the rule is asked anew.

    Args:
        whole: the first leaf.
        count: how many leaves there shall be.
        rule: says which cut comes next.
        least: the shortest side [ticks].

    Returns:
        `count` cuboids that fill the whole: after each cut the near part keeps the leaf's
        place in the list and the far part comes last.

    Raises:
        SettingError: no cut was possible any more before there were `count` leaves.
    """
    leaves = [whole.copy()]
    refused = 0
    while len(leaves) < count:
        leaf, axis, share = rule(leaves)
        low, high = leaf[axis], leaf[axis + 3]
        face = low + int(share * (high - low))
        if face - low >= least and high - face >= least:
            far = leaf.copy()
            leaf[axis + 3] = far[axis] = face
            leaves.append(far)
            refused = 0
        else:
            refused += 1
            if refused > TRIES_PER_LEAF * len(leaves):
                what = f"of {count} boxes only {len(leaves)} could be cut"
                expected = f"fewer boxes, or sides below {least * TICK:g} m"
                raise SettingError("count", what, expected)
    return leaves


def across(draw: Draw) -> Rule:
    """The rule for a ground plane: any leaf, its longer side in x or y, at .3 to .7 of it."""

    def rule(leaves: list[Cuboid]) -> tuple[Cuboid, int, float]:
        leaf = leaves[int(draw() * len(leaves))]
        axis = 0 if leaf[3] - leaf[0] > leaf[4] - leaf[1] else 1
        return leaf, axis, 0.3 + 0.4 * draw()

    return rule


def cut_in_height(whole: Cuboid, count: int, draw: Draw, least: int) -> list[Cuboid]:
    """Cuts one cuboid into several that stand on one another, at random heights.

    The heights of the cuts are uniform among all that leave no height below `least`.

    Args:
        whole: what is cut, at least `count * least` high.
        count: how many cuboids there shall be.
        draw: random numbers.
        least: the lowest height [ticks].

    Returns:
        `count` cuboids that fill the whole, from the bottom up.
    """
    bottom, top = whole[2], whole[5]
    spare = top - bottom - count * least
    cuts = sorted(int(draw() * spare) for _ in range(count - 1))
    faces = [bottom, *(bottom + cut + i * least for i, cut in enumerate(cuts, start=1)), top]
    x, y, _, far_x, far_y, _ = whole
    return [[x, y, faces[i], far_x, far_y, faces[i + 1]] for i in range(count)]
