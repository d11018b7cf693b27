"""The planning desk: plans motions from what the cell believes, ahead of the arm where it can."""

from depal.cell.planning.carrying import Carrying
from depal.cell.planning.picking import Picking
from depal.cell.planning.planner import Planner
from depal.cell.planning.presenting import Presenting
from depal.cell.planning.promises import Promises
from depal.cell.planning.viewing import Viewing
from depal.cell.workplace import Workplace


class Desk:
    """Everything that plans for one cell, over the same promises.

    Attributes:
        planner: one motion at a time.
        promises: what is planned and not yet done, and the books.
        picking: how boxes are taken.
        carrying: where they go, and how.
        presenting: how they are shown to the reader.
        viewing: when the pallet can be seen again.
    """

    def __init__(self, work: Workplace, planner: Planner) -> None:
        """A desk with nothing on it.

        Args:
            work: what the cell believes.
            planner: of this cell's motions.
        """
        self.planner = planner
        self.promises = Promises(work.layout)
        self.picking = Picking(work, planner, self.promises)
        self.carrying = Carrying(work, planner, self.promises, self.picking)
        self.presenting = Presenting(work, planner, self.promises)
        self.viewing = Viewing(work, planner.mover.body.kinematics)
