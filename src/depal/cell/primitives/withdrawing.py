"""The arm gets out of the cameras' view of the pallet."""

from depal.cell.planning.desk import Desk
from depal.cell.workplace import Workplace


async def out_of_view(work: Workplace, desk: Desk) -> None:
    """With an empty hand to where the arm stands idle, if it stands before the pallet.

    Where no way is found it stays: a look is worth less then, and nothing worse.
    """
    if work.held is not None or not desk.viewing.covered():
        return
    parking = desk.picking.park()
    if parking is not None:
        await desk.planner.charge(1)
        await work.ports.arm.follow(parking)
