"""Which faults are to strike, and when: plain values."""

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import numpy as np

from depal.simulation.faults.catalogue import CATALOGUE, Phase

LIFTED = frozenset({Phase.CARRY, Phase.PLACE, Phase.READ, Phase.TELL})
"""In these phases a box has been lifted."""

CHANCES = {Phase.WRITE: 20, Phase.PLAN: 3}
"""So many chances of a phase there are from one lift to the next, where there are several."""


@dataclass(frozen=True, slots=True)
class When:
    """All that must hold at a chance for a fault.

    Attributes:
        box: the box in the hand or under the cups, by its index in the stack; None for any.
        step: how many boxes the arm has lifted before; None for any.
        time: not before this [s].
        p: the probability at each chance; None for once, at the first chance.
        phase: what the cell is doing; None for any in which the fault can strike.
        nth: at the so-manieth chance at which all the rest holds, from 1.
    """

    box: int | None = None
    step: int | None = None
    time: float = 0.0
    p: float | None = None
    phase: Phase | None = None
    nth: int = 1


ALWAYS = When()


@dataclass(frozen=True, slots=True)
class Fault:
    """A fault that is to strike.

    Attributes:
        id: in the catalogue.
        when: all that must hold.
        duration: how long it lasts [s]; None for as long as the catalogue says.
    """

    id: str
    when: When = ALWAYS
    duration: float | None = None

    @property
    def lasts(self) -> float:
        """How long it lasts [s]."""
        return CATALOGUE[self.id].lasts if self.duration is None else self.duration

    @property
    def phases(self) -> tuple[Phase, ...]:
        """In which it can strike."""
        phase = self.when.phase
        return CATALOGUE[self.id].phases if phase is None else (phase,)


@dataclass(frozen=True, slots=True)
class FaultPlan:
    """All faults of a run.

    Attributes:
        faults: in the order of the file.
    """

    faults: tuple[Fault, ...] = ()

    @classmethod
    def of(cls, *ids: str) -> "FaultPlan":
        """Each of these once, at its first chance."""
        return cls(tuple(map(Fault, ids)))

    @classmethod
    def at_random(cls, ids: Sequence[str], seed: int, boxes: int) -> "FaultPlan":
        """Faults, each once, at a step and in a phase of a seed.

        Args:
            ids: in the catalogue.
            seed: of steps and phases.
            boxes: so many boxes will be lifted, if all goes well.
        """
        faults = []
        for number, fault_id in enumerate(ids):
            random = np.random.default_rng([seed, 9, number])
            phases = CATALOGUE[fault_id].phases
            phase = phases[int(random.integers(len(phases)))]
            step = int(random.integers(boxes)) + (phase in LIFTED)
            nth = int(random.integers(1, CHANCES.get(phase, 1) + 1))
            faults.append(Fault(fault_id, When(step=step, phase=phase, nth=nth)))
        return cls(tuple(faults))

    @property
    def ids(self) -> frozenset[str]:
        """Which faults there are."""
        return frozenset(fault.id for fault in self.faults)


@dataclass(frozen=True, slots=True)
class Struck:
    """A fault that has struck.

    Attributes:
        fault: which.
        at: when [s].
        phase: what the cell was doing.
        box: the box that it was at, by its index in the stack.
    """

    fault: Fault
    at: float
    phase: Phase
    box: int | None

    @property
    def until(self) -> float:
        """When it is over [s]; it may never be."""
        return self.at + self.fault.lasts if math.isfinite(self.fault.lasts) else math.inf


def ids_of(struck: Iterable[Struck]) -> frozenset[str]:
    """The faults that have struck."""
    return frozenset(each.fault.id for each in struck)
