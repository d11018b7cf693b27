"""What a run is asked for, and what it needs: read and checked."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path

from depal.cell.workplace import Settings
from depal.domain import BoxId, CellLayout, Delivery, Gtin, Request
from depal.executive.schema import Repository
from depal.geometry import Vector3
from depal.simulation.faults import FaultPlan
from depal.simulation.imaging.severity import Severity
from depal.simulation.truth_sight import SightSettings

CAMERA, TRUTH = "camera", "truth"

PERCEPTIONS = (CAMERA, TRUTH)


@dataclass(frozen=True, slots=True)
class Options:
    """What `depal run` was asked for.

    Attributes:
        delivery: a reference, "case2", or "" for the one that is run by default.
        cell: a cell file or the name of one that ships.
        note: what the cell is told instead of the delivery's own note; "" for that.
        requests: a file of requests, "none", or "" for what the delivery brings.
        w: the weight of Eq. (3).
        policy: which boxes may be taken.
        guard: whether a box waits that would leave a pile with too little margin.
        perception: where boxes come from.
        severity: how far cameras and boxes are from ideal.
        seed: of every random number.
        speed: share of the arm's full speed.
        record: the folder to keep a record in.
        cone: whether motions respect the suction's limits; only tests switch it off.
        faults: a file of faults, or "" for none.
        tasks: task files in place of the shipped ones.
    """

    delivery: str = ""
    cell: str = "default"
    note: str = ""
    requests: str = ""
    w: float = 0.5
    policy: str = "paper"
    guard: bool = False
    perception: str = "truth"
    severity: str = "normal"
    seed: int = 0
    speed: float = 1.0
    record: Path | None = None
    cone: bool = True
    faults: str = ""
    tasks: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
class Job:
    """Everything that a run needs, read and checked.

    Attributes:
        layout: the cell.
        delivery: with its stack, or a bare note.
        requests: known from their own times on.
        settings: of the controller.
        seed: of every random number.
        sight: how good the perception is that knows the truth.
        perception: where boxes come from.
        severity: how far cameras and boxes are from ideal.
        named: names that boxes get by where they stand, in the cell frame [m].
        cone: whether motions respect the suction's limits.
        impossible: products that the arm cannot handle, and why; their cases go to a person.
        note: what the cell is told instead of the delivery's own note.
        faults: what is to strike.
        inspected: whether the referee checks the invariants as it goes, and ends it where one is
            broken.
        horizon: a run that has not ended by then is broken off [s]; None for never.
        tasks: what the cell can do; None for the shipped tasks.
    """

    layout: CellLayout
    delivery: Delivery
    requests: tuple[Request, ...]
    settings: Settings
    seed: int = 0
    sight: SightSettings = field(default_factory=SightSettings)
    cone: bool = True
    impossible: Mapping[Gtin, str] = field(default_factory=dict)
    perception: str = TRUTH
    severity: Severity = Severity.NORMAL
    named: tuple[tuple[BoxId, Vector3], ...] = ()
    note: Delivery | None = None
    faults: FaultPlan = field(default_factory=FaultPlan)
    inspected: bool = False
    horizon: float | None = None
    tasks: Repository | None = None

    @property
    def told(self) -> Delivery:
        """What the cell and the store know of the delivery: true or not."""
        return self.delivery if self.note is None else self.note
