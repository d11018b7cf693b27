"""Chance after chance: whether a fault strikes, by its own seeded numbers."""

from collections.abc import Callable, Iterable
from dataclasses import replace

import numpy as np

from depal.simulation.faults.catalogue import Phase
from depal.simulation.faults.plan import FaultPlan, Struck


class Chances:
    """What has struck so far, and what lasts.

    Attributes:
        struck: in order.
        step: how many boxes the arm has lifted.
    """

    def __init__(self, plan: FaultPlan, seed: int, now: Callable[[], float]) -> None:
        """Nothing has struck.

        Args:
            plan: which faults are to strike.
            seed: of every random number; each fault has a sequence of its own.
            now: the time [s].
        """
        self._plan, self._seed, self._now = plan, seed, now
        self._dice = [np.random.default_rng([seed, 7, n]) for n in range(len(plan.faults))]
        self._over: set[int] = set()
        self._met = [0] * len(plan.faults)
        self.struck: list[Struck] = []
        self.step = 0

    @property
    def planned(self) -> frozenset[str]:
        """The faults that may strike."""
        return self._plan.ids

    def strikes(self, fault_id: str, phase: Phase, box: int | None = None) -> Struck | None:
        """A chance for a fault to begin: the first of its entries that does.

        Args:
            fault_id: in the catalogue.
            phase: what the cell is doing.
            box: the box that it is at, by its index in the stack.
        """
        for number, fault in enumerate(self._plan.faults):
            if fault.id != fault_id or number in self._over or phase not in fault.phases:
                continue
            when = fault.when
            if when.box not in {None, box} or when.step not in {None, self.step}:
                continue
            if self._now() < when.time:
                continue
            self._met[number] += 1
            if self._met[number] < when.nth:
                continue
            if when.p is None:
                self._over.add(number)
            elif self._dice[number].random() >= when.p:
                continue
            self.struck.append(Struck(fault, self._now(), phase, box))
            return self.struck[-1]
        return None

    def lasts(self, fault_id: str, phase: Phase, box: int | None = None) -> Struck | None:
        """The fault of that name that lasts now; a chance for it to begin where none does."""
        return self.lasting(fault_id) or self.strikes(fault_id, phase, box)

    def lasting(self, fault_id: str) -> Struck | None:
        """The fault of that name that lasts now, where one does."""
        now = self._now()
        for struck in reversed(self.struck):
            if struck.fault.id == fault_id and now < struck.until:
                return struck
        return None

    def take_back(self, struck: Struck) -> None:
        """It did not happen after all: there will be another chance."""
        self.struck.remove(struck)
        self._over.discard(self._plan.faults.index(struck.fault))

    def mended(self, ids: Iterable[str]) -> None:
        """A person has seen to it: what lasts of these is over."""
        now, known = self._now(), frozenset(ids)
        for number, struck in enumerate(self.struck):
            if struck.fault.id in known and struck.until > now:
                over = replace(struck.fault, duration=max(now - struck.at, 0.0))
                self.struck[number] = replace(struck, fault=over)

    def fixed_dice(self, *key: int) -> np.random.Generator:
        """Numbers that stay the same for the whole run."""
        return np.random.default_rng([self._seed, 10, *key])

    def dice(self, *key: int) -> np.random.Generator:
        """Numbers for how a fault strikes, apart from whether it does."""
        return np.random.default_rng([self._seed, 8, len(self.struck), *key])
