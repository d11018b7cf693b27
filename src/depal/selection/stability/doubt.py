"""The set of masses and poses over which a margin is the worst."""

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from depal.domain import Gtin, Perceived, Product, Recognition
from depal.errors import SettingError
from depal.selection.stability.patches import HALF_HEIGHT, HALF_LENGTH, HALF_WIDTH, Array, X, Y, Z

DENSITY = 350.0
"""Of a case that nobody has named [kg/m^3]; those that ship range from 67 to 560."""

WEIGHED, GUESSED = 0.05, 0.7
"""How wrong a mass may be, as a share of it: from the note, or from the size alone."""

AS_BELIEVED = "as believed"


@dataclass(frozen=True, slots=True)
class Doubt:
    """How wrong poses may be, and how many draws of wrong masses and poses are looked at.

    The set holds what is believed; where masses are in doubt, five uneven piles: every box above
    the middle as heavy as it may be and every other as light, the same for the four sides; and
    `draws` piles in which every box is as heavy or as light, and as far along x and y, as it
    may be, by lot. The lots depend on the boxes' order by geometry alone.

    Attributes:
        pose: how far a box may stand from where it seems to, along x and along y [m].
        draws: how many lots are drawn.
    """

    pose: float = 0.0
    draws: int = 0

    def __post_init__(self) -> None:
        """Refuses what is no length and no number."""
        if not (math.isfinite(self.pose) and self.pose >= 0):
            raise SettingError("doubt pose", f"{self.pose!r} m", "a length of 0 m or more")
        if self.draws < 0:
            raise SettingError("doubt draws", f"{self.draws}", "0 or more")


SURE = Doubt()
"""Masses and poses are as believed."""

CAMERA = Doubt(pose=0.005, draws=4)
"""For poses from a camera."""


def cases_of(
    prisms: Array, masses: Array, shares: Array, doubt: Doubt
) -> Iterator[tuple[str, Array, Array]]:
    """The set: a name, prisms (n, 8) and masses (n,) [kg] of each case, what is believed first.

    Args:
        prisms: (n, 8) as believed.
        masses: (n,) as believed [kg].
        shares: (n,) how wrong each mass may be, in [0, 1).
        doubt: the poses and the draws.
    """
    yield AS_BELIEVED, prisms, masses
    if shares.any():
        for name, axis, sign in (
            ("heavy above", Z, 1.0),
            ("heavy towards +x", X, 1.0),
            ("heavy towards -x", X, -1.0),
            ("heavy towards +y", Y, 1.0),
            ("heavy towards -y", Y, -1.0),
        ):
            side = sign * (prisms[:, axis] - np.median(prisms[:, axis]))
            yield name, prisms, masses * (1.0 + np.where(side > 0, shares, -shares))
    order = np.lexsort((prisms[:, X], prisms[:, Y], prisms[:, Z]))
    for number in range(doubt.draws):
        lots = np.empty((len(prisms), 3))
        lots[order] = np.random.default_rng(number).choice((-1.0, 1.0), (len(prisms), 3))
        moved = prisms.copy()
        moved[:, X] += doubt.pose * lots[:, 0]
        moved[:, Y] += doubt.pose * lots[:, 1]
        yield f"lot {number + 1}", moved, masses * (1.0 + shares * lots[:, 2])


def weigh(
    boxes: Sequence[Perceived], prisms: Array, products: Mapping[Gtin, Product]
) -> tuple[Array, Array]:
    """What boxes weigh: by the note where they were recognised, by their size where not.

    Args:
        boxes: (n) perceived.
        prisms: (n, 8) theirs.
        products: of the note, by their numbers.

    Returns:
        Masses (n,) [kg], and how wrong they may be, (n,), as shares.
    """
    volumes = 8 * prisms[:, HALF_LENGTH] * prisms[:, HALF_WIDTH] * prisms[:, HALF_HEIGHT]
    masses, shares = volumes * DENSITY, np.full(len(boxes), GUESSED)
    for row, box in enumerate(boxes):
        if isinstance(box, Recognition) and box.gtin in products:
            masses[row], shares[row] = products[box.gtin].mass, WEIGHED
    return masses, shares
