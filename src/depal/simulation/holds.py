"""Cups that hold a box: a module's vacuum over time, and the load on a weld."""

from dataclasses import dataclass, field

import numpy as np
import numpy.typing as npt

from depal.domain import Cup
from depal.domain.cup_group import Break, CupGroup

Floats = npt.NDArray[np.float64]

ROWS = 6
"""A weld has so many rows among the constraints: three lengths and three angles."""

TURN_SCALE = 5.0
"""Weight of a weld's angles against its lengths: cleats make the plate stiff against tilting."""

SMOOTHING = 0.5
"""Share of a new reading in the load of a weld: a peak of one step breaks nothing."""


def _zeros() -> Floats:
    return np.zeros(3)


@dataclass(slots=True)
class Hold:
    """Cups in one plane that hold one box; both modules' cups where these are coplanar.

    Attributes:
        weld: which of the model's welds.
        box: which box.
        cups: that hold it.
        group: the same as a group.
        rotation: `flange_from_face` of the plane.
        force: on the cups by the box, in the face's frame, smoothed [N].
        moment: the same about the middle of the group [N m].
        lift: what the box weighs on the tool, along the vertical, smoothed [N].
    """

    weld: int
    box: int
    cups: tuple[Cup, ...]
    group: CupGroup
    rotation: Floats
    force: Floats = field(default_factory=_zeros)
    moment: Floats = field(default_factory=_zeros)
    lift: float = 0.0

    def read(self, forces: Floats, tool: Floats, box: Floats) -> None:
        """Takes the load from the weld's constraint forces in the last step.

        The first three are what the box does to the tool in the middle of the group, along the
        cell's axes; the others belong to half the scaled angles between the two, in the axes of
        the box (to first order in those angles, which are below half a degree).

        Args:
            forces: (6,) of the weld's rows.
            tool: (3, 3) `cell_from_flange`.
            box: (3, 3) `cell_from_box`.
        """
        face_from_cell = (tool @ self.rotation).T
        force = face_from_cell @ forces[:3]
        moment = face_from_cell @ (box @ (forces[3:] * (TURN_SCALE / 2)))
        self.force = self.force + SMOOTHING * (force - self.force)
        self.moment = self.moment + SMOOTHING * (moment - self.moment)
        self.lift += SMOOTHING * (-float(forces[2]) - self.lift)


@dataclass(frozen=True, slots=True)
class Broken:
    """A hold that gave way.

    Attributes:
        at: when [s].
        box: which box.
        why: which limit was passed.
        share: of the limit that the load used.
    """

    at: float
    box: int
    why: Break
    share: float


@dataclass(frozen=True, slots=True)
class Valve:
    """A module's vacuum: a straight line from one value to another.

    Attributes:
        start: where it began [Pa].
        since: when [s].
        end: where it goes [Pa].
        time: how long that takes [s].
    """

    start: float = 0.0
    since: float = 0.0
    end: float = 0.0
    time: float = 1.0

    def level(self, now: float) -> float:
        """Below the pressure around [Pa]."""
        share = min(max((now - self.since) / self.time, 0.0), 1.0)
        return self.start + (self.end - self.start) * share
