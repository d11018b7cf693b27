"""Schemata: tasks as values, `schema(m, l, p)` of section II-B.

    m   the name with its parameters        Task.name, Task.params
    l   subtasks, each with a precondition  Task.steps
    p   the postcondition                   Task.until

An abstract schema is a `Task` and decomposes into steps; a concrete one is an `Action`, a
primitive that moves a robot or sends a message.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field
from enum import Enum

from depal.executive.conditions import ALWAYS, Condition, FactRef, Operand

FLAG, NUMBER, TEXT = "flag", "number", "text"
BASIC_KINDS = (FLAG, NUMBER, TEXT)
"""Kinds of values that are no names; every other kind is the name of a sort of things."""


@dataclass(frozen=True, slots=True)
class FactType:
    """What a fact may hold.

    Attributes:
        kinds: one or more of flag, number, text, place, or a sort of things such as Box; a value
            of a sort is the name of one thing of it.
        optional: whether the fact may be empty. A flag never is: unset, it is false.
    """

    kinds: tuple[str, ...]
    optional: bool = False


@dataclass(frozen=True, slots=True)
class FactDeclaration:
    """`fact Box.taken : flag`.

    Attributes:
        subject: a sort (every thing of it has this fact) or the name of one thing, as in kr60.
        attribute: the fact's own name.
        type: what it may hold.
        comment: what it means, without the hash.
    """

    subject: str
    attribute: str
    type: FactType
    comment: str = ""

    @property
    def name(self) -> str:
        """As it is written: `Box.taken`."""
        return f"{self.subject}.{self.attribute}"


@dataclass(frozen=True, slots=True)
class Resource:
    """`resource kr60 capacity 1`: what at most so many primitives may use at a time."""

    name: str
    capacity: int = 1
    comment: str = ""


@dataclass(frozen=True, slots=True)
class Param:
    """A parameter: a variable and the sort of thing that it stands for.

    `Box` alone stands for `Box: Box`; `From: place` gives the sort.
    """

    name: str
    sort: str


@dataclass(frozen=True, slots=True)
class Limit:
    """`limit speed 0.25 m/s`: what no primitive below may exceed.

    Attributes:
        quantity: its name; which ones there are, the primitives know.
        bound: a number in its unit, or a fact that holds one in base units; while the fact is
            empty nothing is limited.
        unit: as written, a key of UNITS; empty behind a fact.
        at_least: whether it is what no primitive may fall below: `limit margin at least 0.03 g`.
    """

    quantity: str
    bound: float | FactRef
    unit: str = ""
    at_least: bool = False


@dataclass(frozen=True, slots=True)
class Step:
    """One element of l: a subtask and its precondition.

    Attributes:
        schema: the name of the subtask's schema.
        args: variables of the parent, or names of things.
        when: the precondition.
        bias: a constant part of the subtask's emphasis.
    """

    schema: str
    args: tuple[Operand, ...]
    when: Condition = ALWAYS
    bias: float = 0.0


@dataclass(frozen=True, slots=True)
class Task:
    """An abstract schema.

    Attributes:
        name: m's functor.
        params: m's parameters.
        steps: l.
        until: p.
        when: a precondition of the task itself, wherever it stands.
        keeps: resources that, once a descendant has held them, no other tree gets until the
            task is accomplished or disabled.
        comment: what it is for, without the hash.
        within: holds as long as anything below runs. Otherwise nothing below starts, what runs is
            asked to stop as its `cancel` says, and the task keeps what it keeps.
        limits: what no primitive below may exceed.
        avoids: zones that nothing below may enter: their names, or facts that hold a name.
    """

    name: str
    params: tuple[Param, ...]
    steps: tuple[Step, ...]
    until: Condition
    when: Condition = ALWAYS
    keeps: tuple[str, ...] = ()
    comment: str = ""
    within: Condition = ALWAYS
    limits: tuple[Limit, ...] = ()
    avoids: tuple[str | FactRef, ...] = ()


class Cancel(Enum):
    """What happens to a running primitive whose node loses its gate."""

    IMMEDIATE = "immediate"
    AT_CHECKPOINT = "at_checkpoint"
    NEVER = "never"


@dataclass(frozen=True, slots=True)
class Action:
    """A concrete schema.

    Attributes:
        name: its functor; also the name under which the primitive is bound.
        params: its parameters.
        until: its postcondition; a primitive that ends without it has failed.
        when: a precondition of the action itself.
        uses: the resources that it claims, all or none.
        sets: the facts that it may change.
        cancel: what happens when it loses its gate while it runs.
        timeout: after so long it is broken off [s]; None for never.
        retries: how often it is tried again after a failure.
        backoff: the pause before the first retry, doubled each time [s].
        probe: the name of the probe that finds out, after a restart, what it has done.
        idempotent: whether it may be sent again with the same attempt.
        comment: what it does, without the hash.
        within: holds as long as it runs, as for a task.
        limits: what it may not exceed.
        avoids: zones that it may not enter, as for a task.
    """

    name: str
    params: tuple[Param, ...]
    until: Condition
    when: Condition = ALWAYS
    uses: tuple[str, ...] = ()
    sets: tuple[FactRef, ...] = ()
    cancel: Cancel = Cancel.IMMEDIATE
    timeout: float | None = None
    retries: int = 0
    backoff: float = 0.0
    probe: str | None = None
    idempotent: bool = False
    comment: str = ""
    within: Condition = ALWAYS
    limits: tuple[Limit, ...] = ()
    avoids: tuple[str | FactRef, ...] = ()


Schema = Task | Action


@dataclass(frozen=True, slots=True)
class Repository:
    """All that a task file says.

    Attributes:
        facts: declarations by name, as in "Box.taken".
        resources: by name.
        schemata: by name.
        digest: a hash of the canonical text; trees record the one that they came from.
    """

    facts: Mapping[str, FactDeclaration]
    resources: Mapping[str, Resource]
    schemata: Mapping[str, Schema]
    digest: str = field(default="", compare=False)
