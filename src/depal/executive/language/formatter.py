"""A repository back into its canonical text.

Facts, resources, then tasks and actions, each in the order of their declaration. The law:
reading the text gives the repository back, and writing that gives the text back.
"""

from depal.executive.conditions import ALWAYS
from depal.executive.language.condition_text import (
    GLUE,
    duration_text,
    fact_text,
    glued_condition,
    limit_text,
    number_text,
    operand_text,
    zone_text,
)
from depal.executive.language.layout import (
    column,
    comment_lines,
    finished,
    fits,
    with_comment,
    wrapped,
)
from depal.executive.schema import (
    Action,
    Cancel,
    FactDeclaration,
    FactType,
    Param,
    Repository,
    Resource,
    Schema,
    Step,
    Task,
)

_WIDEST = 40
"""What is longer than this does not push its neighbours to the right."""


def format_repository(repository: Repository) -> str:
    """The canonical text of a repository.

    Args:
        repository: as read, or built.

    Returns:
        The text, ending with a line end; empty where nothing is declared.
    """
    blocks = [
        _facts(list(repository.facts.values())),
        _resources(list(repository.resources.values())),
        *(_schema(schema) for schema in repository.schemata.values()),
    ]
    text = "\n\n".join(finished(block) for block in blocks if block)
    return f"{text}\n" if text else ""


def format_schema(schema: Schema) -> str:
    """The canonical text of one task or action, without a line end behind it."""
    return finished(_schema(schema))


def _facts(facts: list[FactDeclaration]) -> list[str]:
    names = column([fact.name for fact in facts], _WIDEST)
    kinds = column([_type(fact.type) for fact in facts if fact.comment], _WIDEST)
    lines = []
    for fact in facts:
        kind = _type(fact.type)
        padded = kind.ljust(kinds) if fact.comment else kind
        code = wrapped(f"fact {fact.name.ljust(names)} : {padded}", "", "    ")
        lines += with_comment(code, fact.comment)
    return lines


def _type(fact_type: FactType) -> str:
    kinds = f" |{GLUE}".join(fact_type.kinds)
    if not fact_type.optional:
        return kinds
    return f"{kinds}?" if len(fact_type.kinds) == 1 else f"{kinds}{GLUE}?"


def _resources(resources: list[Resource]) -> list[str]:
    codes = [
        f"resource {resource.name} capacity{GLUE}{resource.capacity}" for resource in resources
    ]
    width = column(codes, _WIDEST)
    lines = []
    for code, resource in zip(codes, resources, strict=True):
        padded = code.ljust(width) if resource.comment else code
        lines += with_comment(wrapped(padded, "", "    "), resource.comment)
    return lines


def _schema(schema: Schema) -> list[str]:
    lines = comment_lines(schema.comment)
    return lines + (_task(schema) if isinstance(schema, Task) else _action(schema))


def _task(task: Task) -> list[str]:
    clauses = [_until(task), *_bounds(task)]
    if task.keeps:
        clauses.append(f"keeps{GLUE}{', '.join(task.keeps)}")
    lines = _head("task", task, clauses)
    calls = [_call(step) for step in task.steps]
    width = column(
        [call for call, step in zip(calls, task.steps, strict=True) if _says(step)], _WIDEST
    )
    for call, step in zip(calls, task.steps, strict=True):
        text = f"-{GLUE}{call.ljust(width)}  {_says(step)}".rstrip(" ")
        lines += wrapped(text, "  ", "      ")
    return lines


def _call(step: Step) -> str:
    return f"{step.schema}({', '.join(operand_text(arg) for arg in step.args)})"


def _says(step: Step) -> str:
    """The clauses of a step."""
    clauses = []
    if step.when != ALWAYS:
        clauses.append(f"when{GLUE}{glued_condition(step.when)}")
    if step.bias:
        clauses.append(f"bias{GLUE}{number_text(step.bias)}")
    return " ".join(clauses)


def _action(action: Action) -> list[str]:
    clauses = [_until(action), *_bounds(action)]
    if action.uses:
        clauses.append(f"uses{GLUE}{', '.join(action.uses)}")
    if action.sets:
        clauses.append(f"sets{GLUE}{', '.join(fact_text(fact) for fact in action.sets)}")
    lines = _head("action", action, clauses)
    manner = "  ".join(_manner(action))
    return lines + wrapped(manner, "    ", "    ") if manner else lines


def _manner(action: Action) -> list[str]:
    """How an action is carried out, as clauses."""
    words = []
    if action.cancel is not Cancel.IMMEDIATE:
        words.append(f"cancel{GLUE}{action.cancel.value}")
    if action.timeout is not None:
        words.append(f"timeout{GLUE}{duration_text(action.timeout)}")
    again = []
    if action.retries:
        again.append(f"retries{GLUE}{action.retries}")
    if action.backoff:
        again.append(f"backoff{GLUE}{duration_text(action.backoff)}")
    if again:
        words.append(" ".join(again))
    if action.probe is not None:
        words.append(f"probe{GLUE}{action.probe}")
    if action.idempotent:
        words.append("idempotent")
    return words


def _until(schema: Schema) -> str:
    until = f"until{GLUE}{glued_condition(schema.until)}"
    return until if schema.when == ALWAYS else f"when{GLUE}{glued_condition(schema.when)} {until}"


def _bounds(schema: Schema) -> list[str]:
    """What holds throughout, what is not exceeded, and what is not entered."""
    clauses = []
    if schema.within != ALWAYS:
        clauses.append(f"within{GLUE}{glued_condition(schema.within)}")
    if schema.limits:
        clauses.append(f"limit{GLUE}{', '.join(map(limit_text, schema.limits))}")
    if schema.avoids:
        clauses.append(f"avoids{GLUE}{', '.join(map(zone_text, schema.avoids))}")
    return clauses


def _head(word: str, schema: Schema, clauses: list[str]) -> list[str]:
    """The first line where it fits, else a line a clause."""
    head = f"{word} {schema.name}({', '.join(_param(param) for param in schema.params)})"
    whole = " ".join([head, *clauses])
    if fits(whole):
        return [whole]
    lines = wrapped(head, "", "    ")
    for clause in clauses:
        lines += wrapped(clause, "    ", "        ")
    return lines


def _param(param: Param) -> str:
    return param.name if param.name == param.sort else f"{param.name}:{GLUE}{param.sort}"
