"""Out of wherever the arm has come to rest: the first motion after a restart."""

from depal.cell.planning.desk import Desk
from depal.cell.workplace import Workplace
from depal.ports import Guard


async def get_clear(work: Workplace, desk: Desk, guard: Guard | None = None) -> str | None:
    """Straight out of a place, or off the pallet, with whatever the hand holds.

    Returns:
        Why it has stopped half-way, or None.
    """
    for motion in desk.clearing.ways_out():
        stopped = await work.ports.arm.follow(motion, guard)
        if stopped is not None:
            return stopped
    return None
