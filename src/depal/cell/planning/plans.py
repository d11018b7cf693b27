"""Planned motions, ready to be followed."""

from dataclasses import dataclass, replace

from depal.cell.rules import NO_RULES, Rules
from depal.domain import BoxId, Grasp, Joints, Perceived, PlaceId
from depal.geometry import Pose, Vector3
from depal.logistics.placing import Spot
from depal.motion.collision.values import Array
from depal.motion.grasping import EXACT, swollen
from depal.motion.moves import Part, Pick
from depal.ports import Trajectory


@dataclass(frozen=True, slots=True, eq=False)
class PickPlan:
    """How a box is taken.

    Attributes:
        box: as it was perceived.
        mass: as expected [kg].
        pick: the paths.
        approach: from where the arm was expected to the plane of touch, or to where `down` begins.
        lift: off what it stands on.
        beyond: how much longer the box may be along its own axes, at either end [m].
        rules: that it keeps to.
        down: the last straight part, where it ends as soon as the cups touch something: on the way
            there bellows may brush over what the tool passes.
        short: so far before the plane of touch it ends: the cups feel for the face from there [m].
    """

    box: Perceived
    mass: float
    pick: Pick
    approach: Trajectory
    lift: Trajectory
    beyond: Vector3 = EXACT
    rules: Rules = NO_RULES
    down: Trajectory | None = None
    short: float = 0.0

    @property
    def grasp(self) -> Grasp:
        """How it is held."""
        return self.pick.grasp

    @property
    def feeling(self) -> bool:
        """Whether the tool comes down until its cups touch something, wherever that is."""
        return self.down is not None


@dataclass(frozen=True, slots=True, eq=False)
class Load:
    """A box that is held, or will be when its pick is done, and where its next motion begins.

    Attributes:
        box: its name.
        grasp: how it is held.
        size: along its own axes [m].
        mass: [kg].
        lead: straight parts that come first: the way out of the pile.
        start: (6,) where free space begins [rad].
        beyond: how much longer the box may be along its own axes, at either end [m].
        short: how much less high it may be than it is taken to be, held at its top [m].
        rules: that its next motion keeps to.
        pace: share of the arm's speed that it may move at.
    """

    box: BoxId
    grasp: Grasp
    size: Vector3
    mass: float
    lead: tuple[Part, ...]
    start: Array
    beyond: Vector3 = EXACT
    short: float = 0.0
    rules: Rules = NO_RULES
    pace: float = 1.0

    @property
    def bulky(self) -> "Load":
        """The smallest box around all that the box can be, held the same way."""
        grasp, size = swollen(self.grasp, self.size, self.beyond)
        return replace(self, grasp=grasp, size=size, beyond=EXACT, short=size[2] - self.size[2])


@dataclass(frozen=True, slots=True, eq=False)
class CarryPlan:
    """How a held box gets into its place.

    Attributes:
        load: the box.
        place: where.
        spot: in the place.
        target: `cell_from_box` where it will stand.
        motion: to just above the spot.
        descent: straight down, further than needed.
        retreat: (n, 6) straight out again, empty [rad].
    """

    load: Load
    place: PlaceId
    spot: Spot
    target: Pose
    motion: Trajectory
    descent: Trajectory
    retreat: Array

    @property
    def end(self) -> Joints:
        """Where the arm is afterwards [rad]."""
        a, b, c, d, e, f = self.retreat[-1].tolist()
        return (a, b, c, d, e, f)


@dataclass(frozen=True, slots=True, eq=False)
class ShowPlan:
    """How a held box is shown to the reader.

    Attributes:
        first: to the first side that is shown.
        turns: from each side to the next.
    """

    first: Trajectory
    turns: tuple[Trajectory, ...]
