"""Whether every name in a repository stands for something that fits."""

from collections import Counter
from collections.abc import Collection, Iterator

from depal.errors import did_you_mean
from depal.executive.checking.findings import Finding, FindingKind, head_of, place_of
from depal.executive.conditions import FactRef, Literal, Operand, Var
from depal.executive.exploring.grounding import declaration_of, known_sorts, sorts_of
from depal.executive.schema import Action, Repository, Schema, Step, Task


def check_names(repository: Repository, primitives: Collection[str] | None) -> Iterator[Finding]:
    """Subtasks, arguments, facts, resources and primitives.

    Args:
        repository: any.
        primitives: the names that are bound to code; None where that is not known yet.
    """
    for schema in repository.schemata.values():
        yield from _check_resources(repository, schema)
        if isinstance(schema, Task):
            for number, step in enumerate(schema.steps, start=1):
                yield from _check_step(repository, schema, number, step)
        else:
            for fact in schema.sets:
                yield from check_fact(repository, schema, fact, f"{head_of(schema)}, sets")
            if primitives is not None and schema.name not in primitives:
                what = f"no primitive is bound to {schema.name!r}"
                exists = did_you_mean(schema.name, primitives)
                yield Finding(FindingKind.UNBOUND_PRIMITIVE, head_of(schema), what, exists)


def _check_step(repository: Repository, task: Task, number: int, step: Step) -> Iterator[Finding]:
    where = place_of(task, number)
    subtask = repository.schemata.get(step.schema)
    unbound = [bad for arg in step.args for bad in _unbound(repository, task, arg, where)]
    yield from unbound
    if subtask is None:
        what = f"unknown subtask {step.schema!r}"
        exists = did_you_mean(step.schema, repository.schemata)
        yield Finding(FindingKind.UNKNOWN_SUBTASK, where, what, exists)
        return
    if len(step.args) != len(subtask.params):
        takes = f"{head_of(subtask)} takes {_arguments(len(subtask.params))}"
        what = f"{takes}, {len(step.args)} given"
        yield Finding(FindingKind.WRONG_ARITY, where, what)
        return
    if unbound:
        return
    sorts = sorts_of(task)
    for arg, param in zip(step.args, subtask.params, strict=True):
        if isinstance(arg, Var):
            given = sorts[arg.name]
            name = arg.name if arg.name == given else f"{arg.name}, a {given},"
        else:
            given = param.sort if isinstance(arg.value, str) else "number"
            name = str(arg.value)
        if given != param.sort:
            what = f"{name} is given where {head_of(subtask)} takes a {param.sort}"
            fitting = [one for one, sort in sorts.items() if sort == param.sort]
            exists = f"there is: {', '.join(fitting)}" if fitting else ""
            yield Finding(FindingKind.WRONG_SORT, where, what, exists)


def _arguments(count: int) -> str:
    return "1 argument" if count == 1 else f"{count} arguments"


def check_fact(
    repository: Repository, schema: Schema, fact: FactRef, where: str
) -> Iterator[Finding]:
    """Whether a fact's subject is bound and the fact declared."""
    unbound = list(_unbound(repository, schema, fact.subject, where))
    yield from unbound
    sorts = sorts_of(schema)
    if unbound or declaration_of(repository, fact, sorts) is not None:
        return
    thing = fact.subject
    subject = sorts[thing.name] if isinstance(thing, Var) else str(thing.value)
    name = f"{subject}.{fact.attribute}"
    exists = did_you_mean(name, repository.facts)
    yield Finding(FindingKind.UNDECLARED_FACT, where, f"undeclared fact {name!r}", exists)


def _unbound(
    repository: Repository, schema: Schema, operand: Operand, where: str
) -> Iterator[Finding]:
    """A variable that is no parameter; a name that is a sort's or has a capital counts as one."""
    names = [param.name for param in schema.params]
    if isinstance(operand, Literal):
        name = operand.value
        things = {fact.subject for fact in repository.facts.values()}
        if not isinstance(name, str):
            return
        if name not in known_sorts(repository) and (not name[:1].isupper() or name in things):
            return
    elif operand.name in names:
        return
    shown = operand.value if isinstance(operand, Literal) else operand.name
    what = f"{shown!r} is no parameter of {head_of(schema)}"
    exists = did_you_mean(str(shown), names)
    yield Finding(FindingKind.UNBOUND_VARIABLE, where, what, exists)


def _check_resources(repository: Repository, schema: Schema) -> Iterator[Finding]:
    word, names = ("uses", schema.uses) if isinstance(schema, Action) else ("keeps", schema.keeps)
    for name, count in Counter(names).items():
        where = f"{head_of(schema)}, {word}"
        resource = repository.resources.get(name)
        if resource is None:
            what = f"undeclared resource {name!r}"
            exists = did_you_mean(name, repository.resources)
            yield Finding(FindingKind.UNDECLARED_RESOURCE, where, what, exists)
        elif count > resource.capacity:
            what = f"{word} {name} {count} times; its capacity is {resource.capacity}"
            yield Finding(FindingKind.OVER_CAPACITY, where, what)
