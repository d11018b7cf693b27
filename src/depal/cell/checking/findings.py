"""What a check of a cell finds."""

from dataclasses import dataclass
from enum import Enum

from depal.errors import Problem


class Weight(Enum):
    """What a finding means for the cell's work."""

    ERROR = "error"
    WARNING = "warning"


@dataclass(frozen=True, slots=True)
class CellFinding:
    """One thing that is wrong with a cell, or with a delivery in it.

    Attributes:
        weight: an error keeps the cell from its work, a warning makes it poorer.
        problem: where, what, what was expected, what exists.
        gtin: the product that it is about, where it is about one.
    """

    weight: Weight
    problem: Problem
    gtin: str = ""

    def __str__(self) -> str:
        """The finding in one line."""
        return f"{self.weight.value}: {self.problem}"


def error(where: str, what: str, expected: str = "", exists: str = "") -> CellFinding:
    """Something that keeps the cell from its work."""
    return CellFinding(Weight.ERROR, Problem(where, what, expected, exists))


def warning(where: str, what: str, expected: str = "", exists: str = "") -> CellFinding:
    """Something that makes the cell's work poorer."""
    return CellFinding(Weight.WARNING, Problem(where, what, expected, exists))
