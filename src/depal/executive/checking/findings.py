"""What a check of a repository finds, and how it speaks."""

from dataclasses import dataclass
from enum import Enum

from depal.errors import Problem
from depal.executive.conditions import Var
from depal.executive.schema import Schema, Step, Task


class FindingKind(Enum):
    """What can be wrong with a repository, or worth knowing about it."""

    UNKNOWN_SUBTASK = "unknown subtask"
    WRONG_ARITY = "wrong number of arguments"
    WRONG_SORT = "wrong sort of argument"
    UNBOUND_VARIABLE = "unbound variable"
    UNDECLARED_FACT = "undeclared fact"
    WRONG_VALUE = "comparison with another kind of value"
    UNKNOWN_QUANTITY = "unknown quantity"
    UNKNOWN_ZONE = "unknown zone"
    UNDECLARED_RESOURCE = "undeclared resource"
    OVER_CAPACITY = "more than the capacity"
    ENDLESS = "endless recursion"
    POWERLESS = "an action that cannot reach its own until"
    UNBOUND_PRIMITIVE = "unbound primitive"
    NEVER_ENABLED = "a branch that can never be enabled"
    UNREACHABLE = "a node that no run reaches"
    UNUSED_ACTION = "unused action"
    UNCALLED_TASK = "uncalled task"
    CONTENTION = "contention"
    SHARED_CHANGE = "one change read by several branches"


REMARKS = frozenset(
    {
        FindingKind.UNUSED_ACTION,
        FindingKind.UNCALLED_TASK,
        FindingKind.CONTENTION,
        FindingKind.SHARED_CHANGE,
    }
)
"""Kinds that are worth knowing and no mistakes."""

BREAKING = frozenset(
    {
        FindingKind.UNKNOWN_SUBTASK,
        FindingKind.WRONG_ARITY,
        FindingKind.WRONG_SORT,
        FindingKind.UNBOUND_VARIABLE,
        FindingKind.UNDECLARED_FACT,
        FindingKind.WRONG_VALUE,
        FindingKind.ENDLESS,
    }
)
"""Kinds after which a schema has no meaning that could be looked into any further."""


@dataclass(frozen=True, slots=True)
class Finding:
    """One thing that a check found.

    Attributes:
        kind: of finding.
        where: the schema, and its step where it is about one.
        what: as a sentence without its full stop.
        exists: what there is instead, to choose from; empty where there is nothing to list.
    """

    kind: FindingKind
    where: str
    what: str
    exists: str = ""

    @property
    def serious(self) -> bool:
        """Whether it is a mistake, not a remark."""
        return self.kind not in REMARKS

    @property
    def breaking(self) -> bool:
        """Whether the schema cannot be grounded or explored at all."""
        return self.kind in BREAKING

    def __str__(self) -> str:
        """The finding in one line."""
        return str(Problem(self.where, self.what, exists=self.exists))


def head_of(schema: Schema) -> str:
    """A schema as it is written: "store(Box)"."""
    return f"{schema.name}({', '.join(param.name for param in schema.params)})"


def step_of(step: Step) -> str:
    """A step as it is written, without its condition: "take(Box)"."""
    args = (arg.name if isinstance(arg, Var) else str(arg.value) for arg in step.args)
    return f"{step.schema}({', '.join(args)})"


def place_of(task: Task, number: int) -> str:
    """A step of a task, counted from one: "store(Box), step 2 check(Box)"."""
    return f"{head_of(task)}, step {number} {step_of(task.steps[number - 1])}"
