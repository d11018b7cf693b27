"""Why this box, why not that one, and what would have changed it.

What is said is computed: each change names the value at which the choice turns, and the box that
is chosen beyond it, as Algorithm 1 would choose it. A box whose grasp was not tried counts as one
that can be grasped.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np

from depal.domain import BoxId
from depal.selection.counterfactuals import (
    Change,
    Kind,
    by_priority,
    by_removal,
    by_w,
    by_wish,
    by_withdrawal,
    shares_for,
    wish_for,
)
from depal.selection.decision import Decision, Fate, Verdict
from depal.selection.relations import PERCEIVED, Tolerances
from depal.selection.score import ScoreRule
from depal.selection.situation import Situation


@dataclass(frozen=True, slots=True)
class Parts:
    """Where a score comes from: s = w l + (1 - w) (side + depth + height).

    Attributes:
        side: of h, by |y| [m].
        depth: of h, by x_max - x [m].
        height: of h, by z [m].
        h: Eq. (1) [m].
        l: Eq. (2).
        w: the share of l.
        s: Eq. (3).
        pulled_by: what the request is for that l comes from; empty where none pulls.
    """

    side: float
    depth: float
    height: float
    h: float
    l: float  # noqa: E741 - the paper's name
    w: float
    s: float
    pulled_by: str = ""

    @property
    def text(self) -> str:
        """In words."""
        pull = f" (request for {self.pulled_by})" if self.pulled_by else ""
        return (
            f"s = {self.s:.3f} = {self.w:g} l + {1 - self.w:g} h; l = {self.l:.3f}{pull}; "
            f"h = {self.h:.3f}: side {self.side:.3f}, depth {self.depth:.3f}, "
            f"height {self.height:.3f}"
        )


@dataclass(frozen=True, slots=True)
class Explanation:
    """Why one box was chosen or not.

    Attributes:
        box: which.
        fate: what became of it.
        reason: the fate in words.
        parts: of its score.
        before: the boxes that must leave before it, those that block nothing else's leaving
            first: an order in which each can be taken.
        rival: for the chosen box the runner-up, the best other box that could be taken; for
            another box the chosen one. None where there is none.
        lead: by how much its score is above the rival's; negative below.
        changes: what would have changed it: for the chosen box, to another box; for another
            box, to this one.
    """

    box: BoxId
    fate: Fate
    reason: str
    parts: Parts
    before: tuple[BoxId, ...]
    rival: BoxId | None
    lead: float
    changes: tuple[Change, ...]

    @property
    def lines(self) -> tuple[str, ...]:
        """In words, the most important first."""
        lines = [f"{self.box}: {self.fate.value} ({self.reason})", self.parts.text]
        if self.before:
            lines.append(f"must leave first: {', '.join(self.before)}")
        if self.rival is not None:
            place = "above" if self.lead >= 0 else "below"
            role = "the runner-up" if self.fate is Fate.CHOSEN else "the chosen box"
            lines.append(f"{abs(self.lead):.3f} {place} {role} {self.rival}")
        return (*lines, *(change.text for change in self.changes))


def explain(
    decision: Decision[Any], box: BoxId | None = None, tolerances: Tolerances = PERCEIVED
) -> Explanation | None:
    """Why a box was chosen, or why it was not.

    Args:
        decision: of `select`. What would have changed it is computed where it was made by G;
            by another rule of what blocks what the changes are empty.
        box: which; None for the chosen one.
        tolerances: of the graph that the decision was made with.

    Returns:
        The explanation; None where no box is named and none was chosen.

    Raises:
        PileError: that box was not perceived.
    """
    target = decision.target
    named = target.id if box is None and target is not None else box
    if named is None:
        return None
    verdict = decision.verdict(named)
    now = Situation(decision, tolerances)
    chosen = verdict.fate is Fate.CHOSEN
    rival = _runner_up(decision, now) if chosen else target and decision.verdict(target.id)
    changes: tuple[Change, ...] = ()
    if _by_g(decision, now):
        changes = tuple(_changes_from(now, verdict) if chosen else _changes_to(now, verdict))
    return Explanation(
        box=verdict.box.id,
        fate=verdict.fate,
        reason=verdict.reason,
        parts=_parts(decision, verdict, now),
        before=_before(now, verdict.box.id),
        rival=rival.box.id if rival else None,
        lead=verdict.s - rival.s if rival else 0.0,
        changes=changes,
    )


def _by_g(decision: Decision[Any], now: Situation) -> bool:
    """Whether G and the scores alone made this decision, and would again."""
    if not decision.by_score:
        return False
    blockers = all(v.blockers == now.graph.blockers(v.box.id) for v in decision.verdicts)
    return blockers and now.again() == (decision.target.id if decision.target else None)


def _runner_up(decision: Decision[Any], now: Situation) -> Verdict | None:
    others = [
        verdict
        for verdict in decision.verdicts
        if verdict.box.id in now.free and verdict.fate is Fate.NOT_TRIED
    ]
    return others[0] if others else None


def _parts(decision: Decision[Any], verdict: Verdict, now: Situation) -> Parts:
    rule: ScoreRule = decision.rule
    x, y, z = verdict.box.shape.centre
    pulling = [
        aim.request
        for aim in decision.aims
        if verdict.box.id in now.graph.reachable(aim.box) and aim.request.priority == verdict.l
    ]
    return Parts(
        side=rule.weights.side * float(np.abs(y)),
        depth=rule.weights.depth * (rule.x_max - x),
        height=rule.weights.height * z,
        h=verdict.h,
        l=verdict.l,
        w=rule.w,
        s=verdict.s,
        pulled_by=pulling[0].wanted if pulling else "",
    )


def _before(now: Situation, box: BoxId) -> tuple[BoxId, ...]:
    """T(b) without b, in an order in which each can be taken; those in cycles come last."""
    left = sorted(now.graph.reachable(box) - {box})
    blockers = {name: {b.box for b in now.graph.blockers(name)} for name in left}
    order: list[BoxId] = []
    while ready := [name for name in left if not blockers[name] - set(order)]:
        order += ready
        left = [name for name in left if name not in ready]
    return (*order, *left)


def _changes_from(now: Situation, verdict: Verdict) -> Iterator[Change]:
    target = verdict.box.id
    yield from by_w(now, target)
    yield from by_priority(now, target)
    yield from by_withdrawal(now, target)
    yield from by_wish(now, target)
    yield from by_removal(now, target)


def _changes_to(now: Situation, verdict: Verdict) -> Iterator[Change]:
    """What would have had this box chosen."""
    box = verdict.box.id
    if verdict.fate is Fate.NOT_TRIED:
        yield from shares_for(now, box)
        yield from wish_for(now, box)
    elif verdict.fate is Fate.BLOCKED:
        first = _before(now, box)
        gone = now.again(without=first)
        if gone == box:
            names = ", ".join(first)
            yield Change(Kind.REMOVAL, box, f"{'box' if len(first) == 1 else 'boxes'} {names}")
