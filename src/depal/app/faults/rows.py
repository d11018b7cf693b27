"""The study's runs, summed up: a row for each fault, one for all pairs, and the recovery."""

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from depal.app.faults.runs import Ran
from depal.simulation.faults import CATALOGUE, End

WITHOUT = 0.95
"""Of the faults that need nobody so many end without a person."""

RECOVERED = 5.0
"""In 95 of 100 cases the software's part of a recovery takes no longer [s]."""


@dataclass(frozen=True, slots=True)
class Row:
    """One fault, all its seeds.

    Attributes:
        fault: its id.
        seeds: how many runs.
        struck: share of them in which it struck.
        ended: share that ended in a state that the catalogue names.
        invariants: share in which the invariants held.
        without_person: share in which nobody was asked.
        ends: how often each end came.
    """

    fault: str
    seeds: int
    struck: float
    ended: float
    invariants: float
    without_person: float
    ends: dict[str, int]

    @classmethod
    def of(cls, fault: str, runs: Sequence[Ran]) -> "Row":
        """Sums up the runs of a fault; one that came to no end counts against everything."""
        said = [run.verdict for run in runs if run.verdict is not None]
        n = max(len(runs), 1)
        return cls(
            fault,
            len(runs),
            sum(one.struck for one in said) / n,
            sum(one.ended for one in said) / n,
            sum(not one.broken for one in said) / n,
            sum(one.without_person for one in said) / n,
            dict(Counter(" and ".join(one.ends) for one in said)),
        )

    @property
    def needs_nobody(self) -> bool:
        """Whether the catalogue names no person for it."""
        return not {End.HELD, End.ABORTED} & set(CATALOGUE[self.fault].ends)

    @property
    def holds(self) -> bool:
        """Whether it meets the figures."""
        alone = self.without_person >= WITHOUT or not self.needs_nobody
        return self.struck > 0 and self.ended == self.invariants == 1.0 and alone


@dataclass(frozen=True, slots=True)
class Pairs:
    """All pairs of faults.

    Attributes:
        n: how many runs.
        broken: those in which an invariant did not hold, or that came to no end.
    """

    n: int
    broken: tuple[Ran, ...]

    @classmethod
    def of(cls, runs: Sequence[Ran]) -> "Pairs":
        """Sums up the runs with two faults."""
        pairs = [run for run in runs if len(run.piece.ids) > 1]
        return cls(len(pairs), tuple(run for run in pairs if is_broken(run)))


@dataclass(frozen=True, slots=True)
class RecoveryRow:
    """The software's part of recoveries.

    Attributes:
        n: how many there were.
        median: of them [s].
        p95: 95 of 100 took no longer [s].
    """

    n: int
    median: float
    p95: float

    @classmethod
    def of(cls, runs: Sequence[Ran]) -> "RecoveryRow":
        """Over all runs."""
        seconds = [second for run in runs for second in run.recoveries]
        if not seconds:
            return cls(0, 0.0, 0.0)
        median, p95 = np.percentile(seconds, [50, 95]).tolist()
        return cls(len(seconds), median, p95)


def is_broken(run: Ran) -> bool:
    """Whether an invariant did not hold, or the run came to no end."""
    return run.verdict is None or bool(run.verdict.broken)


def wrongs(run: Ran) -> list[str]:
    """What is wrong with a run, each line with the words that run it again."""
    if run.verdict is None:
        return [f"{run.piece}: no end: {run.reason}"]
    said = [f"{run.piece}: {line}" for line in run.verdict.broken]
    if not run.verdict.ended and len(run.piece.ids) == 1:
        said.append(f"{run.piece}: ended otherwise: {' and '.join(run.verdict.ends)}")
    return said
