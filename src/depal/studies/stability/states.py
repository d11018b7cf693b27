"""Random states of piles, many of which fall: what the linear program says, and what they do."""

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from depal.selection.stability import EDGE, StandingPile
from depal.studies.pallets import GENERATORS
from depal.studies.stability.physics import TOUCHING, let_go

Array = npt.NDArray[np.float64]

DENSITY = 300.0
"""Of the boxes of the study, before each is drawn from half to one and a half of it [kg/m^3]."""

SUPPORTED = 1e-6


@dataclass(frozen=True, slots=True)
class State:
    """One pile.

    Attributes:
        generator: of the pallet that it is left of.
        prisms: (n, 8) the boxes.
        masses: (n,) [kg].
    """

    generator: str
    prisms: Array
    masses: Array


@dataclass(frozen=True, slots=True)
class Compared:
    """One state: what the linear program says, and what it did in MuJoCo.

    Attributes:
        generator: of the pallet.
        boxes: how many were left.
        margin: of the linear program [g].
        quick: the margin that is found without side faces [g].
        fell: whether the pile fell.
        moved: how far the box that moved farthest did [m].
    """

    generator: str
    boxes: int
    margin: float
    quick: float
    fell: bool
    moved: float

    @property
    def unstable(self) -> bool:
        """Whether the program calls it so."""
        return self.margin <= EDGE

    @property
    def agree(self) -> bool:
        """Whether both say the same."""
        return self.unstable == self.fell


def draw_masses(rng: np.random.Generator, prisms: Array) -> Array:
    """(n,) masses by volume and a random density [kg]."""
    volumes = 8 * prisms[:, 3] * prisms[:, 4] * prisms[:, 5]
    return np.asarray(volumes * DENSITY * (0.5 + rng.random(len(prisms))))


def draw_state(seed: int, index: int) -> State:
    """The state with a number: a pallet from which a random part of the boxes was cut out.

    Boxes leave from anywhere, in random order, up to half of them; one whose absence would
    leave another with nothing at all below it stays, for such a state needs no judge. The
    generators take turns.
    """
    rng = np.random.default_rng(np.random.SeedSequence(seed, spawn_key=(index, 6)))
    name = tuple(GENERATORS)[index % len(GENERATORS)]
    prisms = GENERATORS[name](rng).prisms
    masses = draw_masses(rng, prisms)
    below = _below(prisms)
    left = np.ones(len(prisms), np.bool_)
    for row in rng.permutation(len(prisms))[: int(rng.integers(1, len(prisms) // 2 + 1))]:
        left[row] = False
        grounded = prisms[:, 2] - prisms[:, 5] < SUPPORTED
        if not (grounded | below[:, left].any(axis=1))[left].all():
            left[row] = True
    return State(name, prisms[left], masses[left])


def _below(prisms: Array) -> npt.NDArray[np.bool_]:
    """(n, n): whether the box of a column carries the box of a row; none is turned."""
    reach = prisms[:, None, 3:5] + prisms[None, :, 3:5]
    apart = np.abs(prisms[:, None, :2] - prisms[None, :, :2])
    over = (reach - apart > SUPPORTED).all(axis=2)
    bottoms, tops = prisms[:, 2] - prisms[:, 5], prisms[:, 2] + prisms[:, 5]
    return np.asarray(over & (np.abs(bottoms[:, None] - tops[None, :]) < SUPPORTED))


def compare(state: State) -> Compared:
    """Asks both."""
    pile = StandingPile(state.prisms, state.masses, rule=TOUCHING)
    let = let_go(state.prisms, state.masses)
    return Compared(
        state.generator,
        len(state.masses),
        pile.certificate().margin,
        pile.quick_bound(),
        let.fell,
        let.moved,
    )
