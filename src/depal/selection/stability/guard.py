"""Which box to take when the pile that it leaves must stand: a pure rule over an order."""

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from typing import Generic, TypeVar

from depal.selection.stability.certificate import Certificate

C = TypeVar("C")

THRESHOLD = 0.03
"""A pile is left with this margin at least [g]: a push that tilting the deck by 1.7 degrees is."""


@dataclass(frozen=True, slots=True)
class PassedOver(Generic[C]):
    """A candidate that is put later, and the pile that it would leave."""

    candidate: C
    certificate: Certificate

    @property
    def reason(self) -> str:
        """In words."""
        return f"the pile that it leaves: {self.certificate}"


@dataclass(frozen=True, slots=True)
class Guarded(Generic[C]):
    """What a guard says.

    Attributes:
        chosen: the candidate to take, or None where there was none.
        certificate: of the pile that it leaves.
        passed_over: those of a better place in the order that are put later, in their order.
        forced: whether every candidate leaves less than the threshold, so that the one with the
            best margin is taken.
    """

    chosen: C | None
    certificate: Certificate | None
    passed_over: tuple[PassedOver[C], ...]
    forced: bool

    @property
    def reason(self) -> str:
        """In words."""
        if self.certificate is None:
            return "there was nothing to choose from"
        if self.forced:
            return f"no candidate leaves a firm pile; this one the firmest: {self.certificate}"
        later = f"; {len(self.passed_over)} put later" if self.passed_over else ""
        return f"the pile that it leaves: {self.certificate}{later}"


def guard(
    candidates: Iterable[C],
    certify: Callable[[C], Certificate],
    threshold: float = THRESHOLD,
) -> Guarded[C]:
    """Takes the first candidate that leaves a pile with enough margin.

    Args:
        candidates: by falling preference; no more are drawn than are looked at.
        certify: the margin of the pile that a candidate leaves.
        threshold: the least margin that is enough [g].

    Returns:
        That candidate and those that are put later. Where every one leaves less, the one that
        leaves most, the first of equals; those before it in the order are put later.
    """
    low: list[PassedOver[C]] = []
    for candidate in candidates:
        certificate = certify(candidate)
        if certificate.margin >= threshold:
            return Guarded(candidate, certificate, tuple(low), forced=False)
        low.append(PassedOver(candidate, certificate))
    if not low:
        return Guarded(None, None, (), forced=False)
    best = max(range(len(low)), key=lambda place: low[place].certificate.margin)
    return Guarded(low[best].candidate, low[best].certificate, tuple(low[:best]), forced=True)
