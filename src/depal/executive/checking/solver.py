"""Conditions over facts of which some are unknown, and whether any facts satisfy them all."""

from collections.abc import Callable, Mapping, Sequence

from depal.executive.conditions import (
    AllOf,
    Always,
    AnyOf,
    Compare,
    Condition,
    FactRef,
    Holds,
    Lasting,
    Literal,
    Not,
    Value,
    compared,
    is_set,
    key_of,
)
from depal.executive.exploring.domains import Domains, lasting_key

BUDGET = 20_000
"""How many partial assignments are tried before the question is left open."""

Truth = bool | None
"""True, false, or not yet known."""


def judge(  # noqa: PLR0911 - one return a kind of condition
    condition: Condition, known: Mapping[str, Value]
) -> Truth:
    """The value of a grounded condition where only some facts are known.

    Args:
        condition: without variables.
        known: values by fact, and by the stand-in of a time condition; what is missing is
            unknown, not unset.

    Returns:
        Its value where the known facts settle it, else None.
    """
    match condition:
        case Always():
            return True
        case Holds(fact):
            key = key_of(fact, {})
            return is_set(known[key]) if key in known else None
        case Compare():
            return _judge_comparison(condition, known)
        case Not(part):
            inner = judge(part, known)
            return None if inner is None else not inner
        case AllOf(parts):
            return _strong(parts, known, settling=False)
        case AnyOf(parts):
            return _strong(parts, known, settling=True)
        case Lasting(part, _):
            key = lasting_key(condition)
            lasted = is_set(known[key]) if key in known else None
            inner = judge(part, known)
            if inner is False or lasted is False:
                return False
            return None if inner is None or lasted is None else True


def _strong(parts: Sequence[Condition], known: Mapping[str, Value], *, settling: bool) -> Truth:
    truths = [judge(part, known) for part in parts]
    if settling in truths:
        return settling
    return None if None in truths else not settling


def _judge_comparison(condition: Compare, known: Mapping[str, Value]) -> Truth:
    left = key_of(condition.fact, {})
    if left not in known:
        return None
    other = condition.other
    if isinstance(other, FactRef):
        right = key_of(other, {})
        return compared(known[left], condition.op, known[right]) if right in known else None
    if isinstance(other, Literal):
        return compared(known[left], condition.op, other.value)
    raise TypeError(other)


def satisfiable(conditions: Sequence[Condition], domains: Domains, budget: int = BUDGET) -> Truth:
    """Whether some facts make all conditions hold at once.

    Exact: values are tried one fact after the other, and a branch is left as soon as one
    condition is settled false.

    Args:
        conditions: grounded.
        domains: the values of every fact that they mention.
        budget: how many partial assignments may be tried.

    Returns:
        The answer, or None when the budget is used up.
    """
    return _search(conditions, domains, {}, _Budget(budget).spend)


class _Budget:
    """Counts down."""

    def __init__(self, left: int) -> None:
        self.left = left

    def spend(self) -> bool:
        """Whether one more may be tried."""
        self.left -= 1
        return self.left >= 0


def _search(
    conditions: Sequence[Condition],
    domains: Domains,
    known: dict[str, Value],
    spend: Callable[[], bool],
) -> Truth:
    if not spend():
        return None
    truths = [judge(condition, known) for condition in conditions]
    if False in truths:
        return False
    if None not in truths:
        return True
    key = _unknown(conditions[truths.index(None)], known)
    if key is None or key not in domains:
        return None
    open_question = False
    for value in domains[key]:
        found = _search(conditions, domains, known | {key: value}, spend)
        if found:
            return True
        open_question |= found is None
    return None if open_question else False


def _unknown(condition: Condition, known: Mapping[str, Value]) -> str | None:
    """The first fact of a condition that is not known and matters."""
    match condition:
        case Holds(fact):
            keys = [key_of(fact, {})]
        case Compare(fact, _, other):
            keys = [key_of(one, {}) for one in (fact, other) if isinstance(one, FactRef)]
        case Not(part):
            return _unknown(part, known)
        case AllOf(parts) | AnyOf(parts):
            unsettled = (part for part in parts if judge(part, known) is None)
            return next((key for part in unsettled if (key := _unknown(part, known))), None)
        case Lasting(part, _):
            inner = _unknown(part, known)
            keys = [inner or lasting_key(condition)]
        case Always():
            keys = []
    return next((key for key in keys if key not in known), None)
