"""What the gripper feels tells where one box ends."""

import numpy as np
import numpy.typing as npt
from cells_at_work import Cell, pile

from depal.geometry import OrientedBox
from depal.ports import View

Floats = npt.NDArray[np.float64]


def bounds(box: OrientedBox) -> tuple[Floats, Floats]:
    """Lower and upper corner."""
    return box.corners.min(axis=0), box.corners.max(axis=0)


def test_what_is_under_the_cups_is_flat_and_lies_on_the_face_that_is_held() -> None:
    """In the plane of touch, and nowhere beyond the face, however the box is held."""
    cell = Cell(1)
    (box,) = pile(1)
    cell.work.pile.see(View(0.0, (box,)))
    least, most = bounds(box.shape)
    held = 0
    for way in cell.desk.picking.offered(box)[:4]:
        plan = cell.desk.picking.try_pick(box, way, only=True)
        if isinstance(plan, str):
            continue
        held += 1
        cell.arm.at = plan.lift.start
        place = cell.desk.feeling.under_cups(plan)
        low, high = bounds(place)
        assert min(place.size) < 0.01
        assert (low > least - 0.003).all()
        assert (high < most + 0.003).all()
    assert held
