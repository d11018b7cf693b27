"""What Algorithm 1 decided, and why, for every box."""

from dataclasses import dataclass, field
from enum import Enum
from typing import TYPE_CHECKING, Generic, TypeVar, cast

import numpy as np
import numpy.typing as npt

from depal.domain import BoxId, Perceived, Request
from depal.errors import PileError, Problem, did_you_mean
from depal.selection.blocking import Aim
from depal.selection.graph import Blocker
from depal.selection.links import Array, Indices
from depal.selection.relations import Relation
from depal.selection.score import ScoreRule

if TYPE_CHECKING:  # it solves programs, which whoever only selects need not load
    from depal.selection.stability import Certificate

G = TypeVar("G")


class Outcome(Enum):
    """How a selection ends."""

    CHOSEN = "a box is chosen"
    NOTHING_CAN_BE_GRASPED = "nothing can be grasped"
    NOTHING_PERCEIVED = "no box is perceived"


class Fate(Enum):
    """What became of one box in one selection."""

    CHOSEN = "chosen"
    BLOCKED = "blocked"
    IN_CYCLE = "in a cycle of blockers"
    UNREACHABLE = "no reachable grasp"
    NOT_TRIED = "scored lower than the chosen box"


@dataclass(frozen=True, slots=True)
class Refused:
    """Why a box that nothing blocks cannot be grasped."""

    reason: str


@dataclass(frozen=True, slots=True)
class Verdict:
    """One box in one selection.

    Attributes:
        box: what was perceived.
        h: priority of its position, Eq. (1) [m].
        l: priority inherited from requests, Eq. (2).
        s: score, Eq. (3).
        blockers: the boxes that block it directly.
        fate: what became of it.
        reason: the fate in words, with the names that matter.
    """

    box: Perceived
    h: float
    l: float  # noqa: E741 - the paper's name
    s: float
    blockers: frozenset[Blocker]
    fate: Fate
    reason: str


@dataclass(frozen=True, slots=True)
class Scores:
    """The scores of one selection, by slot of the graph.

    Attributes:
        slots: (n,) the slots with a box, by falling score; ties by geometry.
        h: (slots,) Eq. (1) [m].
        l: (slots,) Eq. (2).
        s: (slots,) Eq. (3).
    """

    slots: npt.NDArray[np.intp]
    h: Array
    l: Array  # noqa: E741 - the paper's name
    s: Array


@dataclass(frozen=True, slots=True)
class Decision(Generic[G]):
    """The result of Algorithm 1.

    Attributes:
        outcome: how it ended.
        target: the box to store next, or None.
        grasp: the reachable grasp that was found for it, or None.
        aims: the perceived box that each request asks for.
        pending: requests for what nothing has seen yet.
        cycle: a cycle of blockers, each blocked by the next, where there is one.
        rule: what the scores depend on.
        scores: by slot, in the order in which boxes were tried.
        boxes: (slots,) the perceived box of each slot, None where it is empty.
        blocker_table: offsets, blockers and relations by slot.
        refusals: why boxes that nothing blocks could not be grasped, by slot.
        certificate: how firmly the pile stands that the target leaves, where that was asked.
        by_score: whether the scores alone decided, or some boxes went ahead whatever theirs.
    """

    outcome: Outcome
    target: Perceived | None
    grasp: G | None
    aims: tuple[Aim, ...]
    pending: tuple[Request, ...]
    cycle: tuple[BoxId, ...]
    rule: ScoreRule
    scores: Scores = field(repr=False)
    boxes: tuple[Perceived | None, ...] = field(repr=False)
    blocker_table: tuple[Indices, Indices, Indices] = field(repr=False)
    refusals: dict[int, str] = field(repr=False)
    certificate: "Certificate | None" = None
    by_score: bool = True

    @property
    def verdicts(self) -> tuple[Verdict, ...]:
        """Every perceived box with its score, its blockers and its fate, best score first."""
        return tuple(self._verdict(slot) for slot in self.scores.slots.tolist())

    def verdict(self, box: BoxId) -> Verdict:
        """The verdict on one box.

        Raises:
            PileError: that box was not perceived.
        """
        slots = self.scores.slots.tolist()
        for slot in slots:
            if self._box(slot).id == box:
                return self._verdict(slot)
        exists = did_you_mean(str(box), (str(self._box(slot).id) for slot in slots))
        raise PileError("", [Problem("decision", f"no box {box!r} was perceived", exists=exists)])

    def _box(self, slot: int) -> Perceived:
        return cast("Perceived", self.boxes[slot])

    def _verdict(self, slot: int) -> Verdict:
        box = self._box(slot)
        offsets, blockers, relations = self.blocker_table
        span = slice(offsets[slot], offsets[slot + 1])
        blocked_by = frozenset(
            Blocker(self._box(other).id, Relation(relation))
            for other, relation in zip(
                blockers[span].tolist(), relations[span].tolist(), strict=True
            )
        )
        fate, reason = self._fate(slot, blocked_by)
        h, l, s = (float(part[slot]) for part in (self.scores.h, self.scores.l, self.scores.s))  # noqa: E741
        return Verdict(box, h, l, s, blocked_by, fate, reason)

    def _fate(self, slot: int, blockers: frozenset[Blocker]) -> tuple[Fate, str]:
        box = self._box(slot)
        if self.target is not None and box.id == self.target.id:
            return Fate.CHOSEN, "the best score of all boxes that can be grasped"
        if box.id in self.cycle:
            start = self.cycle.index(box.id)
            chain = [*self.cycle[start:], *self.cycle[: start + 1]]
            return Fate.IN_CYCLE, " is blocked by ".join(chain)
        if blockers:
            on_top = sorted(b.box for b in blockers if b.relation & Relation.ON_TOP)
            before = sorted(b.box for b in blockers if b.relation & Relation.OCCLUDES)
            crowds = sorted(b.box for b in blockers if b.relation == Relation.CROWDS)
            parts = [f"{', '.join(on_top)} on top"] if on_top else []
            parts += [f"{', '.join(before)} in front"] if before else []
            parts += [f"{', '.join(crowds)} where the tool has to go"] if crowds else []
            return Fate.BLOCKED, "; ".join(parts)
        if slot in self.refusals:
            return Fate.UNREACHABLE, self.refusals[slot]
        target = "" if self.target is None else f" than {self.target.id}"
        return Fate.NOT_TRIED, f"scored lower{target}"
