"""What is measured higher than a box around it: a tool that comes to its top keeps clear of it."""

from collections.abc import Iterable

import numpy as np

from depal.cell.blocks import over, solids_over
from depal.geometry import OrientedBox
from depal.ports import Relief

HIGHER = 0.045
"""What is measured higher than a box's top by less may be the top itself [m]."""

NEAR = 0.35
"""No tool reaches farther beyond the sides of the box that it takes [m]."""

AROUND = 0.02
"""Where a box has left, what was measured so far around it may have been its edge [m]."""


def towers(
    relief: Relief, box: OrientedBox, gone: Iterable[OrientedBox] = ()
) -> tuple[OrientedBox, ...]:
    """Upright solids in the cell frame around what is higher than a box, near to it.

    Args:
        relief: as it was measured.
        box: that a tool is to come to.
        gone: boxes that have left since; what was measured there is not there any more.
    """
    grid_from_cell = relief.cell_from_grid.inverse
    local = box.seen_from(grid_from_cell)
    top = local.centre[2] + local.size[2] / 2
    with np.errstate(invalid="ignore"):
        high = relief.heights > top + HIGHER
    high &= over(relief, local, NEAR)
    for each in gone:
        high &= ~over(relief, each.seen_from(grid_from_cell), AROUND)
    return solids_over(relief, high, top)
