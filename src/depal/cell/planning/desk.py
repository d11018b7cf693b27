"""The planning desk: plans motions from what the cell believes, ahead of the arm where it can."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from typing import Protocol

from depal.cell.planning.carrying import Carrying
from depal.cell.planning.clearing import Clearing
from depal.cell.planning.feeling import Feeling
from depal.cell.planning.picking import Picking
from depal.cell.planning.planner import Planner
from depal.cell.planning.plans import CarryPlan, PickPlan, ShowPlan
from depal.cell.planning.presenting import Presenting
from depal.cell.planning.promises import Promises
from depal.cell.planning.viewing import Viewing
from depal.cell.workplace import Workplace
from depal.domain import BoxId, Grasp, Perceived, PlaceId
from depal.geometry import OrientedBox
from depal.motion.kinematics import Kinematics
from depal.ports import Trajectory


class Counts(Protocol):
    """Counts the motions that are planned, and charges simulated time for them."""

    @property
    def planned(self) -> int:
        """How many motions were planned so far."""
        ...

    @property
    def spent(self) -> Sequence[float]:
        """How long each took to compute [s of wall time], for reports."""
        ...

    async def charge(self, motions: int) -> None:
        """Lets the simulated time of planning pass; motions go on meanwhile."""
        ...


class Picks(Protocol):
    """Plans how boxes are taken, and how an empty hand gets away; see `Picking`."""

    def try_pick(self, box: Perceived) -> PickPlan | str:
        """A pick of a box from where the arm will be next, or why there is none."""
        ...

    def offered(self, box: Perceived) -> tuple[Grasp, ...]:
        """The ways to hold a box, whatever has failed."""
        ...

    def masses(self, box: Perceived) -> tuple[float | None, float | None]:
        """The least and the most that a box can weigh, by the note [kg]."""
        ...

    async def pick(self, box: BoxId) -> PickPlan | str:
        """The pick of a box from where the arm stands."""
        ...

    async def pick_from(self, box: BoxId, place: PlaceId) -> PickPlan | str:
        """The pick of a box that stands in a place."""
        ...

    def park(self) -> Trajectory | None:
        """To where the arm stands idle, with an empty hand."""
        ...

    def way_back(self, plan: PickPlan) -> Iterator[Trajectory]:
        """Back along the whole approach, with an empty hand."""
        ...


class Carries(Protocol):
    """Finds places and plans how boxes get there; see `Carrying`."""

    @property
    def blocked(self) -> Mapping[PlaceId, float]:
        """Places with something in them that the cell has not put there, and since when [s]."""
        ...

    async def find_place(self, box: BoxId, places: Sequence[PlaceId]) -> CarryPlan | str:
        """The first place in a list into which a box can be put, with the motion there."""
        ...

    async def carry(self, box: BoxId, place: PlaceId) -> CarryPlan | str:
        """The motion of the held box into a place, from where it is."""
        ...

    def way_out(self, plan: CarryPlan) -> Trajectory | None:
        """Back along the straight way into a place, where the arm has stopped on it."""
        ...

    def descent(self, plan: CarryPlan) -> Trajectory | None:
        """The plan's way down, or what is left of it."""
        ...

    def retreat(self, plan: CarryPlan) -> Trajectory | None:
        """Straight out of the place from where the arm has come to rest."""
        ...


class Presents(Protocol):
    """Plans how held boxes are shown to the reader; see `Presenting`."""

    async def show(self, box: BoxId) -> ShowPlan | str:
        """The motions of a held box to the reader, one for each side that can be shown."""
        ...


class Views(Protocol):
    """Tells when the pallet can be seen; see `Viewing`."""

    def clears(self, box: BoxId, trajectory: Trajectory) -> None:
        """The box counts as gone once the arm, which sets out now, is out of the view."""
        ...

    def covered(self) -> bool:
        """Whether the arm is before the pallet now."""
        ...


class Clears(Protocol):
    """Plans how the arm gets out of wherever it has come to rest; see `Clearing`."""

    def ways_out(self) -> Iterator[Trajectory]:
        """Motions in order, each planned from where the one before has ended."""
        ...


class Feels(Protocol):
    """Plans the small motions with which the gripper feels for a face; see `Feeling`."""

    def nearer(self, plan: PickPlan, way: float) -> Trajectory | None:
        """Straight along the approach by so much [m]; None where something is in the way."""
        ...

    def early(self, plan: PickPlan) -> float:
        """How far above the plane of touch the arm stands, on something that is higher [m]."""
        ...

    def lift(self, plan: PickPlan) -> Trajectory:
        """The plan's lift from where the cups have sealed."""
        ...

    def out(self, plan: PickPlan) -> Trajectory | None:
        """As far as the plan's way out of the pile, from where a box hangs that was higher."""
        ...

    def under_cups(self, plan: PickPlan) -> OrientedBox:
        """The flat place that the plan's cups touch, in the cell frame."""
        ...


class Desk(Protocol):
    """Everything that plans for one cell, over the same promises."""

    @property
    def planner(self) -> Counts:
        """Counts and charges."""
        ...

    @property
    def promises(self) -> Promises:
        """What is planned and not yet done, and the books."""
        ...

    @property
    def kinematics(self) -> Kinematics:
        """Of the arm."""
        ...

    @property
    def picking(self) -> Picks:
        """How boxes are taken."""
        ...

    @property
    def carrying(self) -> Carries:
        """Where they go, and how."""
        ...

    @property
    def presenting(self) -> Presents:
        """How they are shown to the reader."""
        ...

    @property
    def viewing(self) -> Views:
        """When the pallet can be seen again."""
        ...

    @property
    def clearing(self) -> Clears:
        """How the arm gets out of wherever it is."""
        ...

    @property
    def feeling(self) -> Feels:
        """How the gripper feels for a face."""
        ...

    def pace(self, speed: float) -> None:
        """From the next motion on at another share of the arm's full speed, in (0, 1]."""
        ...


class MotionDesk:
    """The desk of a real arm: inverse kinematics, collisions, suction, timing.

    Attributes:
        planner: one motion at a time.
        promises: what is planned and not yet done, and the books.
        kinematics: of the arm.
        picking: how boxes are taken.
        carrying: where they go, and how.
        presenting: how they are shown to the reader.
        viewing: when the pallet can be seen again.
        clearing: how the arm gets out of wherever it is.
        feeling: how the gripper feels for a face.
    """

    def __init__(self, work: Workplace, planner: Planner) -> None:
        """A desk with nothing on it.

        Args:
            work: what the cell believes.
            planner: of this cell's motions.
        """
        self.planner = planner
        self.kinematics = planner.mover.body.kinematics
        self.promises = Promises(work.layout)
        self.picking = Picking(work, planner, self.promises)
        self.carrying = Carrying(work, planner, self.promises, self.picking)
        self.presenting = Presenting(work, planner, self.promises)
        self.viewing = Viewing(work, self.kinematics)
        self.clearing = Clearing(work, planner, self.promises)
        self.feeling = Feeling(work, planner, self.promises)

    def pace(self, speed: float) -> None:
        """From the next motion on at another share of the arm's full speed, in (0, 1]."""
        self.planner.timing = replace(self.planner.timing, speed=speed)
