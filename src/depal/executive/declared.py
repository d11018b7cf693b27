"""What a task file says about facts: which there are, and what they may hold."""

import math

from depal.errors import Problem, did_you_mean
from depal.executive.conditions import Value
from depal.executive.events import Change
from depal.executive.schema import FLAG, NUMBER, FactType, Repository


class Declared:
    """The facts that a repository declares."""

    def __init__(self, repository: Repository) -> None:
        """Reads the declarations."""
        self._types = _types_by_attribute(repository)

    def misfit(self, change: Change) -> Problem | None:
        """What is wrong with a change, if anything."""
        key, value = change
        subject, _, attribute = key.rpartition(".")
        by_subject = self._types.get(attribute)
        if by_subject is None:
            exists = did_you_mean(attribute, self._types)
            return Problem(key, f"no fact is called {attribute!r}", exists=exists)
        kind = by_subject.get(subject, by_subject.get(None))
        if kind is None:
            exists = did_you_mean(subject, (name for name in by_subject if name))
            return Problem(key, f"{subject!r} has no fact {attribute!r}", exists=exists)
        if not fits(value, kind):
            return Problem(key, f"{value!r} is no value for it", " or ".join(kind.kinds))
        return None


def fits(value: Value, kind: FactType) -> bool:
    """Whether a value is of a declared type. A number is finite, as those of the journal are."""
    if value is None:
        return kind.optional or FLAG in kind.kinds
    if isinstance(value, bool):
        return FLAG in kind.kinds
    if isinstance(value, int | float):
        return NUMBER in kind.kinds and (isinstance(value, int) or math.isfinite(value))
    return any(name not in {FLAG, NUMBER} for name in kind.kinds)


def _types_by_attribute(repository: Repository) -> dict[str, dict[str | None, FactType]]:
    """Types by attribute, then by the thing that has it; None for any thing of a sort.

    A subject with a capital is a sort, and the engine does not know which things are of it.
    """
    types: dict[str, dict[str | None, FactType]] = {}
    for declaration in repository.facts.values():
        subject = None if declaration.subject[:1].isupper() else declaration.subject
        types.setdefault(declaration.attribute, {})[subject] = declaration.type
    return types
