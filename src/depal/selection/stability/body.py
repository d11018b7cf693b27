"""One believed pile, made ready: its contacts, and its parts when boxes are taken away."""

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

from depal.selection.stability.certificate import Direction
from depal.selection.stability.patches import (
    FIRST,
    HALF_HEIGHT,
    ON_TOP,
    SECOND,
    WAY,
    Array,
    Indices,
    Touches,
    Z,
)
from depal.selection.stability.spreading import STANDS, first_falling

Flags = npt.NDArray[np.bool_]

HALVINGS = 8
"""The bound is found to the friction by so many halvings: 2 milli-g at a friction of 0.5."""


@dataclass(frozen=True, slots=True, eq=False)
class Body:
    """Boxes that touch, all of a pile or what is left of it.

    Attributes:
        centres: (n, 8) prisms; their centres are taken as centres of mass [m].
        masses: (n,) [kg]; 0 for a box that is not there.
        touches: of the boxes that are there.
        order: (n,) rows from the highest bottom to the lowest.
        standing: of the touches those that are ON_TOP.
        starts: (n + 1,) row i stands on the corners starts[i] .. starts[i + 1] - 1 of standing.
    """

    centres: Array
    masses: Array
    touches: Touches
    order: Indices
    standing: Touches
    starts: Indices

    @classmethod
    def of(cls, prisms: Array, masses: Array, touches: Touches) -> "Body":
        """A whole pile."""
        bottoms = prisms[:, Z] - prisms[:, HALF_HEIGHT]
        order = np.argsort(-bottoms, kind="stable").astype(np.int32)
        return cls(prisms, masses, touches, order, *_standing(touches, len(masses)))

    def only(self, rows: Flags) -> "Body":
        """What is left when no other rows are there."""
        bodies = self.touches.bodies
        second = bodies[:, SECOND]
        kept = rows[bodies[:, FIRST]] & ((second < 0) | rows[second])
        touches = Touches(bodies[kept], self.touches.points[kept])
        masses = np.where(rows, self.masses, 0.0)
        standing = _standing(touches, len(masses))
        return Body(self.centres, masses, touches, self.order, *standing)

    @property
    def there(self) -> Indices:
        """The rows of the boxes that are there."""
        return np.flatnonzero(self.masses > 0).astype(np.int32)

    def falling(self, push: Direction, strength: float, friction: float) -> int:
        """The first row for which `first_falling` finds no forces under a push, or STANDS."""
        x, y = push
        return first_falling(
            self.centres,
            self.masses,
            self.order,
            self.starts,
            self.standing.bodies,
            self.standing.points,
            friction,
            (strength * x, strength * y),
        )

    def bound(self, push: Direction, friction: float, enough: float = np.inf) -> tuple[float, int]:
        """The greatest acceleration for which forces are found, and who falls first beyond.

        Args:
            push: its direction.
            friction: of what stands on something; no pile sustains more [g].
            enough: looked at before any other [g]; the bound is below it only where no forces
                are found for it.

        Returns:
            [g], or minus infinity where none are found even at rest; a row or STANDS.
        """
        low, high, limiting = -np.inf, friction, STANDS
        for strength in (enough, 0.0):
            if low < strength < high:
                falling = self.falling(push, strength, friction)
                if falling == STANDS:
                    low = strength
                else:
                    high, limiting = strength, falling
        for _ in range(HALVINGS if low >= 0 else 0):
            middle = (low + high) / 2
            falling = self.falling(push, middle, friction)
            if falling == STANDS:
                low = middle
            else:
                high, limiting = middle, falling
        return low, limiting

    def parts(self) -> list[Flags]:
        """Boxes that touch one another, over any number of others: (n,) flags for each part."""
        between = self.touches.bodies[self.touches.bodies[:, SECOND] >= 0]
        n = len(self.masses)
        links = coo_array(
            (np.ones(len(between), np.int32), (between[:, FIRST], between[:, SECOND])), shape=(n, n)
        )
        _, labels = connected_components(links, directed=False)
        return [labels == label for label in np.unique(labels[self.masses > 0])]


def _standing(touches: Touches, count: int) -> tuple[Touches, Indices]:
    """What is ON_TOP, and where each row's corners begin."""
    kept = touches.bodies[:, WAY] == ON_TOP
    standing = Touches(touches.bodies[kept], touches.points[kept])
    starts = np.searchsorted(standing.bodies[:, FIRST], np.arange(count + 1)).astype(np.int32)
    return standing, starts
