"""All runs of a study in one: counts, rates, shares of time."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from statistics import median

import numpy as np

from depal.app.files import Json
from depal.app.throughput.row import Row
from depal.cell.charges import Charges

NAN = float("nan")


@dataclass(frozen=True, slots=True)
class Spread:
    """Some numbers in four.

    Attributes:
        n: how many there are.
        median: the one in the middle.
        p95: nineteen of twenty are not above it.
        low: the least.
        high: the greatest.
    """

    n: int
    median: float
    p95: float
    low: float
    high: float

    @classmethod
    def of(cls, values: Iterable[float]) -> "Spread":
        """Of some numbers; nan where there are none."""
        found = list(values)
        if not found:
            return cls(0, NAN, NAN, NAN, NAN)
        p95 = float(np.percentile(found, 95))
        return cls(len(found), median(found), p95, min(found), max(found))


@dataclass(frozen=True, slots=True)
class Summary:
    """What the study says of the cell.

    Attributes:
        runs: how many.
        boxes: in all of them.
        stored: that stand in their places.
        exceptions: set aside, taken by a person, or left, with a reason.
        lost: dropped.
        collisions: by the referee.
        disagreements: boxes that are not where the books say, by the referee.
        placed_twice: boxes that the books have stored more than once.
        suction_losses: times that a hold gave way, whatever became of the box.
        requests: that came.
        served: of them.
        boxes_per_hour: of the runs, without the waiting for people.
        shares: of all simulated time, by what the cell did.
        wall: real time of a run [s].
        planning: real time of a planned motion [s].
        within_charge: the share of plans that took no longer than the simulated clock charges.
    """

    runs: int
    boxes: int
    stored: int
    exceptions: int
    lost: int
    collisions: int
    disagreements: int
    placed_twice: int
    suction_losses: int
    requests: int
    served: int
    boxes_per_hour: Spread
    shares: dict[str, float]
    wall: Spread
    planning: Spread
    within_charge: float

    @property
    def stored_share(self) -> float:
        """Of all boxes."""
        return self.stored / self.boxes if self.boxes else NAN

    @property
    def fields(self) -> dict[str, Json]:
        """For `--json`."""
        return {
            "runs": self.runs,
            "boxes": self.boxes,
            "stored": self.stored,
            "stored_share": self.stored_share,
            "exceptions": self.exceptions,
            "lost": self.lost,
            "collisions": self.collisions,
            "disagreements": self.disagreements,
            "placed_twice": self.placed_twice,
            "suction_losses": self.suction_losses,
            "requests": self.requests,
            "served": self.served,
            "boxes_per_hour": {
                "median": self.boxes_per_hour.median,
                "low": self.boxes_per_hour.low,
                "high": self.boxes_per_hour.high,
            },
            "shares": dict(self.shares),
            "wall_seconds": {"median": self.wall.median, "max": self.wall.high},
            "plan_seconds": {
                "n": self.planning.n,
                "median": self.planning.median,
                "p95": self.planning.p95,
                "max": self.planning.high,
                "within_charge": self.within_charge,
            },
        }


def summary_of(rows: Sequence[Row]) -> Summary:
    """Sums runs up."""
    plans = [seconds for row in rows for seconds in row.plan_seconds]
    charge = Charges().plan
    return Summary(
        runs=len(rows),
        boxes=sum(row.boxes for row in rows),
        stored=sum(row.stored for row in rows),
        exceptions=sum(len(row.exceptions) for row in rows),
        lost=sum(row.lost for row in rows),
        collisions=sum(row.collisions for row in rows),
        disagreements=sum(len(row.referee.disagreements) for row in rows),
        placed_twice=sum(row.placed_twice for row in rows),
        suction_losses=sum(len(row.referee.suction_losses) for row in rows),
        requests=sum(len(row.requests) for row in rows),
        served=sum(wish.served is not None for row in rows for wish in row.requests),
        boxes_per_hour=Spread.of(row.boxes_per_hour for row in rows),
        shares=shares_of(rows),
        wall=Spread.of(row.wall_seconds for row in rows),
        planning=Spread.of(plans),
        within_charge=sum(s <= charge for s in plans) / len(plans) if plans else NAN,
    )


def shares_of(rows: Sequence[Row]) -> dict[str, float]:
    """The shares of the simulated time of some runs together, by what the cell did."""
    seconds: dict[str, float] = {}
    for row in rows:
        for name, value in row.shares.items():
            seconds[name] = seconds.get(name, 0.0) + value
    total = sum(row.sim_seconds for row in rows)
    return {name: value / total for name, value in seconds.items()} if total else {}
