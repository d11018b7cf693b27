"""From what the safety controller says to what may move, and how fast: pure."""

import math
from dataclasses import dataclass

from depal.errors import DeviceError
from depal.executive.events import Change
from depal.ports import Safety, SafetyState

STALE = 0.5
"""An input that has not been heard for longer counts as bad [s]."""

SUSPENDED, SPEED = "cell.suspended", "cell.speed"
"""The facts of the task files."""


@dataclass(frozen=True, slots=True)
class Judgement:
    """What the safety inputs say.

    Attributes:
        good: they were heard, and not long ago.
        tripped: a stop is active or the gate is open: only a person's start ends that.
        inside: somebody is in the protective field.
        near: somebody is in the warning field.
    """

    good: bool
    tripped: bool = False
    inside: bool = False
    near: bool = False

    @property
    def may_move(self) -> bool:
        """Whether a motion may begin."""
        return self.good and not self.tripped and not self.inside

    @property
    def suspended(self) -> bool:
        """Whether nothing may move until that is over by itself; a stop is more than that."""
        return not self.tripped and not self.may_move

    @property
    def reason(self) -> str:
        """Why nothing may move, for people; empty where it may."""
        if self.tripped:
            return "a safety stop is active, or the gate is open"
        if not self.good:
            return "the safety inputs are silent"
        return "somebody is in the protective field" if self.inside else ""


def heard(safety: Safety) -> SafetyState | None:
    """What the safety controller says; None where it cannot be reached."""
    try:
        return safety.state()
    except DeviceError:
        return None


def judged(state: SafetyState | None, now: float, before: Judgement | None = None) -> Judgement:
    """What inputs mean.

    Args:
        state: what was heard; None for nothing.
        now: the time [s].
        before: the judgement before this one; a stop that was active stays so in the dark.

    Returns:
        The judgement. Nothing that is absent or stale is ever taken for good.
    """
    if state is None or (state.read is not None and not 0.0 <= now - state.read <= STALE):
        return Judgement(good=False, tripped=before is not None and before.tripped)
    return Judgement(
        good=True, tripped=state.tripped, inside=state.inside, near=state.near or state.inside
    )


def speed_under(judgement: Judgement, near: float) -> float:
    """The greatest speed of the tool [m/s]: none while suspended, `near` with somebody near."""
    if judgement.suspended:
        return 0.0
    return near if judgement.near or not judgement.good else math.inf


def facts_under(judgement: Judgement, near: float) -> tuple[Change, ...]:
    """What the task files are told."""
    slow = near if judgement.near or not judgement.good else None
    return (SUSPENDED, judgement.suspended), (SPEED, slow)
