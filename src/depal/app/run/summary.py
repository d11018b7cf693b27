"""What came of a run: the cell's books, the referee's word on them, and the report."""

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, field

from rich.console import RenderableType
from rich.text import Text

from depal.app.files import Json
from depal.app.reports.report import Report, plain_table
from depal.app.run.scoring import Scores
from depal.cell.departures import Departure, Fate
from depal.cell.questions import Asked
from depal.cell.wishes import Wish
from depal.cell.workplace import Difference
from depal.domain import BoxId, Gtin
from depal.simulation.faults import Struck
from depal.simulation.referee import FLOOR, HAND, PALLET, REMOVED, Referee, Summary

UNSEEN = "unseen"
"""What boxes are called that the note promises and nobody has seen."""


@dataclass(frozen=True, slots=True)
class Left:
    """A box that stayed on the pallet."""

    box: BoxId
    reason: str


@dataclass(frozen=True, slots=True)
class Outcome:
    """A run, summed up.

    Attributes:
        delivery: its id.
        boxes: how many it has.
        stack: which box of the stack each name means, as the referee knows it.
        departures: the boxes that left the pallet, in order.
        left: the boxes that did not.
        wishes: the requests and what became of them.
        questions: to the person.
        referee: the truth at the end.
        differences: where the note and what was found differ.
        disagreements: where the referee and the cell's books differ, in words.
        sim_seconds: simulated time.
        waiting_seconds: of it, waiting for people with the arm at rest.
        wall_seconds: real time.
        shares: simulated seconds by what the cell did.
        plan_seconds: real time of every planned motion [s].
        policy: which boxes could be taken.
        w: the weight of Eq. (3).
        seed: of every random number.
        speed: share of full speed.
        events_sha256: of the event log.
        scores: of the first selection in which a request counts.
        struck: the faults that have struck.
        motions: when each motion of the arm began [s].
        most_held: how many boxes hung on the arm together.
        broken: the invariant that was broken while it ran, in words; empty where none was.
        ends_amiss: what is wrong with how the requests have ended, in words.
        fell: when each box was pulled out of the hand by a fault [s].
        checks: how often the invariants were checked.
        recoveries: real time from the notice of each fault to the next motion [s].
    """

    delivery: str
    boxes: int
    stack: Mapping[BoxId, int]
    departures: tuple[Departure, ...]
    left: tuple[Left, ...]
    wishes: tuple[Wish, ...]
    questions: tuple[Asked, ...]
    referee: Summary
    differences: tuple[Difference, ...]
    disagreements: tuple[str, ...]
    sim_seconds: float
    waiting_seconds: float
    wall_seconds: float
    shares: dict[str, float]
    plan_seconds: tuple[float, ...]
    policy: str
    w: float
    seed: int
    speed: float
    events_sha256: str
    scores: Scores | None = None
    struck: tuple[Struck, ...] = ()
    motions: tuple[float, ...] = ()
    most_held: int = 0
    broken: str = ""
    ends_amiss: tuple[str, ...] = ()
    fell: Mapping[int, float] = field(default_factory=dict)
    checks: int = 0
    recoveries: tuple[float, ...] = ()

    @property
    def stored(self) -> int:
        """How many boxes stand in their places."""
        return sum(departure.fate is Fate.STORED for departure in self.departures)

    @property
    def lost(self) -> int:
        """How many boxes were lost."""
        return sum(departure.fate is Fate.LOST for departure in self.departures)

    @property
    def boxes_per_hour(self) -> float:
        """Stored per simulated hour, without the waiting for people."""
        working = self.sim_seconds - self.waiting_seconds
        return 3600 * self.stored / working if working > 0 else 0.0

    @property
    def whole(self) -> bool:
        """Whether all went as it should: nothing lost, no collision, the books are true."""
        clean = not self.lost and not self.referee.collisions and not self.disagreements
        return clean and self.stored + len(self.exceptions) == self.boxes

    @property
    def exceptions(self) -> tuple[tuple[BoxId, str, str], ...]:
        """Boxes that were set aside, taken by a person or left: name, what, reason."""
        gone = [
            (departure.box, departure.fate.value, departure.reason)
            for departure in self.departures
            if departure.fate in {Fate.SET_ASIDE, Fate.BY_PERSON}
        ]
        return (*gone, *((left.box, "left on the pallet", left.reason) for left in self.left))


def disagreements(
    referee: Referee,
    departures: Sequence[Departure],
    left: Sequence[Left],
    stack: Mapping[BoxId, int],
    flagged: Collection[Gtin] = (),
) -> tuple[str, ...]:
    """Where the truth differs from what the cell believes of each box, in words.

    Args:
        referee: who knows where boxes are, and which product each is.
        departures: the boxes that left.
        left: the boxes that did not, those that nobody has seen included.
        stack: which box of the stack each name means.
        flagged: products of which the cell itself says that note and boxes differ.
    """
    expected: dict[BoxId, tuple[str, ...]] = {entry.box: (PALLET,) for entry in left}
    for departure in departures:
        match departure.fate:
            case Fate.STORED | Fate.SET_ASIDE:
                expected[departure.box] = (str(departure.place), REMOVED)
            case Fate.BY_PERSON:
                expected[departure.box] = (REMOVED, HAND)
            case Fate.LOST:
                expected[departure.box] = (FLOOR, REMOVED, PALLET)
    found = []
    for box, places in expected.items():
        index = stack.get(box)
        where = "nowhere" if index is None else referee.where(index)
        if where not in places:
            found.append(f"box {box}: the books say {' or '.join(places)}, it is in {where}")
    return (*found, *_misnamed(referee, departures, stack, flagged))


def _misnamed(
    referee: Referee,
    departures: Sequence[Departure],
    stack: Mapping[BoxId, int],
    flagged: Collection[Gtin],
) -> list[str]:
    """Boxes that were stored as another product than they are."""
    found = []
    for departure in departures:
        index = stack.get(departure.box)
        if departure.fate is not Fate.STORED or index is None:
            continue
        truth = referee.product(index)
        if departure.gtin != truth and departure.gtin not in flagged:
            found.append(f"box {departure.box}: stored as {departure.gtin}, it is {truth}")
    return found


def run_report(outcome: Outcome, perception: str) -> Report:
    """The report of `depal run`; it holds when nothing was lost, hit or booked wrongly."""
    table = plain_table(f"{outcome.delivery}: {outcome.boxes} boxes", "", "")
    table.row("stored", f"{outcome.stored} of {outcome.boxes}")
    table.row("set aside, taken by a person or left", str(len(outcome.exceptions)))
    table.row("lost", str(outcome.lost))
    table.row("collisions", str(len(outcome.referee.collisions)))
    table.row("boxes per hour, without waiting for people", f"{outcome.boxes_per_hour:.0f}")
    table.row("simulated seconds", f"{outcome.sim_seconds:.1f}")
    for name, seconds in outcome.shares.items():
        table.row(f"  {name}", f"{seconds:.1f} ({100 * seconds / outcome.sim_seconds:.0f} %)")
    table.row("real seconds", f"{outcome.wall_seconds:.1f}")
    shown: list[RenderableType] = [table]
    if outcome.scores is not None:
        shown.append(outcome.scores.table)
    shown += [Text(f"{box}: {what}: {reason}") for box, what, reason in outcome.exceptions]
    shown += [
        Text(f"product {d.gtin}: the note promises {d.promised}, {d.found} were found")
        for d in outcome.differences
    ]
    shown += [Text(f"{wish.request.wanted}: {_served(wish)}") for wish in outcome.wishes]
    shown += [Text(line, style="red") for line in outcome.disagreements]
    shown += [
        Text(f"{hit.at:.1f} s: {hit.who} against {hit.against}, {hit.force:.0f} N", style="red")
        for hit in outcome.referee.collisions
    ]
    return Report(_fields(outcome, perception), shown, holds=outcome.whole)


def _served(wish: Wish) -> str:
    if wish.served is None:
        return "never served"
    return f"served at {wish.served:.1f} s by {wish.box}, {wish.boxes_before} boxes before it"


def _fields(outcome: Outcome, perception: str) -> dict[str, Json]:
    """What `--json` writes."""
    return {
        "delivery": outcome.delivery,
        "boxes": outcome.boxes,
        "stored": outcome.stored,
        "lost": outcome.lost,
        "collisions": len(outcome.referee.collisions),
        "exceptions": [
            {"box": box, "outcome": what, "reason": reason}
            for box, what, reason in outcome.exceptions
        ],
        "note_differences": [_difference(outcome, each) for each in outcome.differences],
        "sequence": [_departure(departure, outcome.stack) for departure in outcome.departures],
        "requests": [_wish(wish) for wish in outcome.wishes],
        "questions": [
            {
                "text": asked.question.text,
                "about": asked.question.about,
                "answer": asked.answer,
                "asked": asked.asked,
                "answered": asked.answered,
            }
            for asked in outcome.questions
        ],
        "sim_seconds": outcome.sim_seconds,
        "waiting_seconds": outcome.waiting_seconds,
        "wall_seconds": outcome.wall_seconds,
        "boxes_per_hour": outcome.boxes_per_hour,
        "shares": dict(outcome.shares),
        "plan_seconds": list(outcome.plan_seconds),
        "referee": {
            "boxes": dict(outcome.referee.boxes),
            "greatest_force": outcome.referee.greatest_force,
            "tipped": list(outcome.referee.tipped),
            "disagreements": list(outcome.disagreements),
            "collisions": [
                {"at": hit.at, "who": hit.who, "against": hit.against, "force": hit.force}
                for hit in outcome.referee.collisions
            ],
            "suction_losses": [str(loss) for loss in outcome.referee.lost],
        },
        "scores": [
            {"box": box.name, "before": box.before, "after": box.after}
            for box in (outcome.scores.boxes if outcome.scores is not None else ())
        ],
        "faults": [
            {
                "fault": each.fault.id,
                "at": each.at,
                "phase": each.phase.value,
                "box": each.box,
            }
            for each in outcome.struck
        ],
        "perception": perception,
        "policy": outcome.policy,
        "w": outcome.w,
        "seed": outcome.seed,
        "speed": outcome.speed,
        "events_sha256": outcome.events_sha256,
    }


def _difference(outcome: Outcome, each: Difference) -> dict[str, Json]:
    """A product of which the note is wrong, or a box of it was taken for another's."""
    boxes = [gone.box for gone in outcome.departures if gone.gtin == each.gtin]
    return {
        "gtin": each.gtin,
        "promised": each.promised,
        "found": each.found,
        "boxes": list(map(str, boxes)),
    }


def _departure(departure: Departure, stack: Mapping[BoxId, int]) -> dict[str, Json]:
    return {
        "stack": stack.get(departure.box),
        "box": departure.box,
        "gtin": departure.gtin,
        "grasp": departure.grasp.value if departure.grasp else None,
        "place": departure.place,
        "outcome": departure.fate.value,
        "at": departure.at,
    }


def _wish(wish: Wish) -> dict[str, Json]:
    request = wish.request
    fields: dict[str, Json] = {"priority": request.priority, "arrived": request.arrived}
    if request.gtin is not None:
        fields["gtin"] = request.gtin
    if request.box is not None:
        fields["box"] = request.box
    if request.due is not None:
        fields["due"] = request.due
    return {**fields, "served": wish.served, "boxes_before": wish.boxes_before}
