"""The collision check of one motion: who moves, what is held, what stands around."""

import math
from dataclasses import dataclass

import numpy as np

from depal.domain import CellLayout
from depal.geometry import Vector3
from depal.motion.collision.checking import (
    FENCE,
    FLOOR,
    FREE,
    HAND,
    ITSELF,
    TILT,
    Case,
    Margins,
    first_free_along,
    first_hit,
    first_hit_along,
)
from depal.motion.collision.edges import edge_is_free
from depal.motion.collision.rubbing import overlaps
from depal.motion.collision.values import Arm, Array, Hand, Scene, arm_of
from depal.motion.kinematics import Kinematics

STEP = 0.02
"""No point of the arm moves further between two checks [m]."""

DEEPEST = 0.03
"""Boxes whose poses are known badly do not seem to overlap by more [m]."""


@dataclass(frozen=True, slots=True)
class Body:
    """The arm of a cell, ready for checks.

    Attributes:
        kinematics: of the arm.
        arm: its capsules.
        fence: (4,) smallest x, y and greatest x, y that anything may reach [m].
    """

    kinematics: Kinematics
    arm: Arm
    fence: Array

    @classmethod
    def of(cls, layout: CellLayout) -> "Body":
        """The arm of a cell."""
        (x0, y0), (x1, y1) = layout.floor
        return cls(Kinematics(layout.robot), arm_of(layout.robot), np.array([x0, y0, x1, y1]))


@dataclass(frozen=True, slots=True)
class Upright:
    """A held box is not to be tilted.

    Attributes:
        up: the direction in the flange's frame that points up when it stands.
        tilt: how far it may lean [rad].
    """

    up: Vector3
    tilt: float


class Checker:
    """Checks configurations and paths; conservative: it may refuse, it never misses."""

    def __init__(
        self,
        body: Body,
        hand: Hand,
        scene: Scene,
        margins: Margins,
        upright: Upright | None = None,
        rubbed: Array | None = None,
    ) -> None:
        """For one hand in one scene.

        Args:
            body: the arm.
            hand: the tool and what it holds.
            scene: what stands around.
            margins: how far things stay apart.
            upright: how a held box may lean.
            rubbed: (n,) how deep a held box may reach into each case [m]; by the margin for cases
                if left out.
        """
        self._upright = upright
        self._body = body
        self._hand = hand
        self._scene = scene
        solids = scene.solids
        self.case = Case(
            body.kinematics.dims,
            body.arm,
            hand.solids,
            hand.holding,
            solids,
            np.where(scene.pile, margins.pile if rubbed is None else -rubbed, margins.held),
            body.fence,
            margins,
            np.array(upright.up if upright else (0.0, 0.0, 1.0)),
            math.cos(upright.tilt) if upright else -2.0,
        )

    def with_margins(self, margins: Margins) -> "Checker":
        """The same with other margins."""
        return Checker(self._body, self._hand, self._scene, margins, self._upright)

    def rubbing(self, joints: Array, more: float) -> "Checker":
        """The same, but a held box may reach no deeper into a case than it seems to already.

        Args:
            joints: (6,) where the box stands among others, with the errors of their poses [rad].
            more: so much deeper it may reach [m].
        """
        seems = overlaps(self.case, np.asarray(joints, dtype=np.float64), DEEPEST)
        return Checker(
            self._body,
            self._hand,
            self._scene,
            self.case.margins,
            self._upright,
            np.minimum(seems + more, -self.case.margins.pile),
        )

    def free(self, joints: Array) -> bool:
        """Whether nothing is touched."""
        return bool(first_hit(self.case, joints)[0] == FREE)

    def path_free(self, path: Array) -> bool:
        """Whether no row of a path (n, 6) touches anything."""
        return bool(first_hit_along(self.case, path)[0] == FREE)

    def first_free(self, path: Array) -> int | None:
        """The first row of a path (n, 6) that touches nothing; None where all do."""
        row = int(first_free_along(self.case, path))
        return None if row == FREE else row

    def first_hit(self, path: Array) -> int | None:
        """The first row of a path (n, 6) that touches something; None where none does."""
        row = int(first_hit_along(self.case, path)[0])
        return None if row == FREE else row

    def edge_free(self, start: Array, end: Array, step: float = STEP) -> bool:
        """Whether the straight joint line between two configurations is free."""
        return bool(edge_is_free(self.case, start, end, step))

    def why(self, joints: Array) -> str:
        """What touches what, in words; empty where nothing does."""
        part, what = first_hit(self.case, joints)
        return "" if part == FREE else self._words(int(part), int(what))

    def why_along(self, path: Array) -> str:
        """The same for the first row of a path that touches something."""
        row, part, what = first_hit_along(self.case, path)
        return "" if row == FREE else self._words(int(part), int(what))

    def _words(self, part: int, what: int) -> str:
        if part < HAND:
            mover = f"link {self._body.arm.link[part]} of the arm"
        elif self._hand.holding and part - HAND == len(self._hand.solids.centre) - 1:
            mover = "the held box"
        else:
            mover = "the tool"
        if what == FLOOR:
            return f"{mover} at the floor"
        if what == TILT:
            return "the held box leans too far"
        if what == FENCE:
            return f"{mover} at the fence"
        if what >= ITSELF:
            return f"{mover} against link {self._body.arm.link[what - ITSELF]}"
        return f"{mover} against {self._scene.names[what]}"
