"""What the cell says about its work while it works: choices with reasons, and events."""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

from depal.domain import BoxId, Gtin, Perceived, Recognition, Request
from depal.executive import events as ev
from depal.geometry import Vector3
from depal.selection import Decision, Explanation, PositionWeights, ScoreRule, Verdict, explain


@dataclass(frozen=True, slots=True)
class Line:
    """One box in one choice: where it stands, its scores and its fate in words.

    Attributes:
        box: its name.
        h: Eq. (1) [m].
        l: Eq. (2).
        s: Eq. (3).
        fate: what became of it.
        reason: the fate in words.
        centre: in the cell frame [m].
        size: along its own axes [m].
        yaw: by which it is turned [rad].
        gtin: its product, None where it is not recognised.
        blockers: the boxes that must go before it.
    """

    box: BoxId
    h: float
    l: float  # noqa: E741 - the paper's name
    s: float
    fate: str
    reason: str
    centre: Vector3
    size: Vector3
    yaw: float
    gtin: Gtin | None
    blockers: tuple[BoxId, ...] = ()


@dataclass(frozen=True, slots=True)
class AimNote:
    """What a request waits for.

    Attributes:
        wanted: the product or the box.
        box: that it aims at.
        removals: boxes that are to leave before it.
        least: the proven minimum of them under the policy's rule of what blocks what.
    """

    wanted: str
    box: BoxId
    removals: int
    least: int


@dataclass(frozen=True, slots=True)
class ChoiceNote:
    """A selection as it is told: Eqs. (1)-(3) per box, best first.

    Attributes:
        at: when [s].
        target: the box to store next, None where nothing could be grasped.
        outcome: how the selection ended, in words.
        lines: every perceived box, best score first.
        cycle: boxes that block one another.
        requests: what was wanted.
        w: of Eq. (3).
        x_max: of Eq. (1) [m].
        weights: of h, Eq. (1).
        explanation: why the target, and what would have changed it; None without a target.
        aims: the box that each request aims at, with its removals and their proven minimum.
        stands: how firmly the pile stands that the target leaves, in words; empty without one.
    """

    at: float
    target: BoxId | None
    outcome: str
    lines: tuple[Line, ...]
    cycle: tuple[BoxId, ...]
    requests: tuple[Request, ...]
    w: float
    x_max: float
    weights: PositionWeights
    by_score: bool
    explanation: Explanation | None
    aims: tuple[AimNote, ...] = ()
    stands: str = ""

    @property
    def why(self) -> str:
        """Why this box, in one sentence."""
        if self.target is None:
            return self.outcome
        chosen = next(line for line in self.lines if line.box == self.target)
        pull = f", pulled by a request (l = {chosen.l:.2f})" if chosen.l > 0 else ""
        passed = [line.box for line in self.lines if line.s > chosen.s and line.box != chosen.box]
        over = f"; {len(passed)} with a better score are blocked or out of reach" if passed else ""
        return f"best score that can be taken: s = {chosen.s:.3f}, h = {chosen.h:.3f}{pull}{over}"


Heard = Callable[[int, Sequence[ev.Event]], None]
Chosen = Callable[[ChoiceNote], None]


class Journalist:
    """Passes on what happens to those who want to know: a screen, a record."""

    def __init__(self) -> None:
        """Nobody listens yet."""
        self._heard: list[Heard] = []
        self._chosen: list[Chosen] = []

    def listen(self, heard: Heard | None = None, chosen: Chosen | None = None) -> None:
        """Adds a listener to events, to choices, or both."""
        if heard is not None:
            self._heard.append(heard)
        if chosen is not None:
            self._chosen.append(chosen)

    def heard(self, last: int, events: Sequence[ev.Event]) -> None:
        """A step of the executive has been written."""
        for listener in self._heard:
            listener(last, events)

    def chose(self, at: float, decision: Decision[Any]) -> None:
        """A selection was made."""
        note = note_of(at, decision)
        for listener in self._chosen:
            listener(note)


def note_of(at: float, decision: Decision[Any]) -> ChoiceNote:
    """A decision as it is told."""
    rule: ScoreRule = decision.rule
    return ChoiceNote(
        at=at,
        target=decision.target.id if decision.target is not None else None,
        outcome=decision.outcome.value,
        lines=tuple(_line(verdict) for verdict in decision.verdicts),
        cycle=decision.cycle,
        requests=(*(aim.request for aim in decision.aims), *decision.pending),
        w=rule.w,
        x_max=rule.x_max,
        weights=rule.weights,
        by_score=decision.by_score,
        explanation=explain(decision),
        aims=tuple(
            AimNote(aim.request.wanted, aim.box, aim.removals, aim.least) for aim in decision.aims
        ),
        stands="" if decision.certificate is None else str(decision.certificate),
    )


def _line(verdict: Verdict) -> Line:
    box: Perceived = verdict.box
    (c, _, _), (s, _, _), _ = box.shape.pose.rotation
    return Line(
        box=box.id,
        h=verdict.h,
        l=verdict.l,
        s=verdict.s,
        fate=verdict.fate.value,
        reason=verdict.reason,
        centre=box.shape.centre,
        size=box.shape.size,
        yaw=math.atan2(s, c),
        gtin=box.gtin if isinstance(box, Recognition) else None,
        blockers=tuple(sorted(blocker.box for blocker in verdict.blockers)),
    )
