"""How a run with a fault ended, and whether the invariants held, by the referee's word."""

from collections.abc import Iterator
from dataclasses import dataclass

from depal.app.run.inspecting import DECISION, undue
from depal.app.run.summary import Outcome
from depal.cell.bookkeeping import RECORDS
from depal.cell.departures import Fate
from depal.cell.primitives.restarting import ARM
from depal.simulation.faults import CATALOGUE, End

SPARE = 1e-6
"""Two things happen at the same time when they are no further apart [s]."""


@dataclass(frozen=True, slots=True)
class Verdict:
    """What is said of one run.

    Attributes:
        ended: whether it ended as its catalogue entry says.
        broken: the invariants that did not hold, in words.
        without_person: whether nobody was asked for anything.
        struck: whether the fault struck at all.
        ends: how it ended.
    """

    ended: bool
    broken: tuple[str, ...]
    without_person: bool
    struck: bool
    ends: tuple[str, ...] = ()


def verdict_of(outcome: Outcome, *ids: str) -> Verdict:
    """Judges a run in which these faults were to strike."""
    ends = ends_of(outcome, *ids)
    allowed = {end for fault_id in ids for end in CATALOGUE[fault_id].ends} | (
        {End.ON} if len(ids) > 1 else set()
    )
    return Verdict(
        ended=not outcome.left and ends <= allowed,
        broken=tuple(broken_in(outcome)),
        without_person=not outcome.questions,
        struck=bool(outcome.struck),
        ends=tuple(sorted(end.value for end in ends)),
    )


def ends_of(outcome: Outcome, *ids: str) -> frozenset[End]:
    """Everything that the cell did about it; that it went on where it did nothing else."""
    found = set()
    for asked in outcome.questions:
        stopped = asked.question.about == ARM and "M7" in ids
        found.add(End.ABORTED if stopped else End.HELD)
    if any(departure.fate is Fate.SET_ASIDE for departure in outcome.departures):
        found.add(End.ASIDE)
    return frozenset(found or {End.ON})


def broken_in(outcome: Outcome) -> Iterator[str]:
    """The invariants that a run has broken, in words; none where all held."""
    if outcome.broken:
        yield outcome.broken  # the run was broken off there: nothing else is known
        return
    yield from outcome.ends_amiss
    yield from _accounts(outcome)
    yield from _motions(outcome)


def _accounts(outcome: Outcome) -> Iterator[str]:
    """I1 to I5, at the end."""
    accounted = outcome.stored + outcome.lost + len(outcome.exceptions)
    if accounted != outcome.boxes:
        yield f"I1: {accounted} of {outcome.boxes} boxes are accounted for"
    for line in outcome.disagreements:
        yield f"I1, I4: {line}"
    if outcome.most_held > 1:
        yield f"I2: {outcome.most_held} boxes were in the hand"
    names = [departure.box for departure in outcome.departures]
    for name in sorted({name for name in names if names.count(name) > 1}):
        yield f"I3: box {name} has ended {names.count(name)} times"
    for hit in undue(outcome.referee.collisions, outcome.fell):
        yield f"I5: {hit.at:.1f} s: {hit.who} against {hit.against}"


def _motions(outcome: Outcome) -> Iterator[str]:
    """I5 and I7: motions that began before a question was answered that forbids them."""
    for asked in outcome.questions:
        question, answered = asked.question, asked.answered
        if question.about not in {ARM, RECORDS} and not question.id.startswith(DECISION):
            continue
        for began in outcome.motions:
            if answered is not None and asked.asked + SPARE < began < answered - SPARE:
                yield f"I5, I7: {began:.1f} s: the arm moved before {question.id} was answered"
