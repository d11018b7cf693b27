"""Tasks and actions as they are written, and the paper's term of a task."""

from collections.abc import Sequence
from collections.abc import Set as AbstractSet

from depal.errors import Problem
from depal.executive.conditions import Operand
from depal.executive.language.clause_reader import read_clauses
from depal.executive.language.condition_reader import operand, read_condition
from depal.executive.language.cursor import Cursor, UnreadableError
from depal.executive.language.lines import Line, joined
from depal.executive.language.words import CLOSE_LIST, OPEN_LIST
from depal.executive.schema import BASIC_KINDS, Action, Param, Step, Task

_Head = tuple[str, tuple[Param, ...]]


def read_task(line: Line, steps: Sequence[Line], problems: list[Problem]) -> Task:
    """`task NAME(Params) [when C] until C [within C] [limit Q X] [avoids Z] [keeps R]`, its steps.

    Args:
        line: it begins with `task`.
        steps: each begins with `-`.
        problems: what is wrong is added here, in the head and in every step.

    Returns:
        The task.

    Raises:
        UnreadableError: when any part cannot be read.
    """
    cursor = Cursor(line, problems)
    head: _Head | None = None
    clauses = None
    try:
        cursor.advance()
        head = _head(cursor, "a task")
        clauses = read_clauses(cursor, "a task", variables_of(head))
    except UnreadableError:
        pass
    read = _steps(steps, variables_of(head) if head else frozenset(), problems)
    if head is None or clauses is None or len(read) < len(steps):
        raise UnreadableError
    name, params = head
    if not steps:
        cursor.note(line.tokens[0], f"task {name!r} has no steps", "lines as in - take(Box)")
        raise UnreadableError
    if clauses.until is None:
        what = f"task {name!r} has no 'until'"
        cursor.note(line.tokens[0], what, "until and the condition that ends it")
        raise UnreadableError
    comment = joined([*line.comments, *(text for step in steps for text in step.comments)])
    return Task(
        name,
        params,
        tuple(read),
        until=clauses.until,
        when=clauses.when,
        keeps=clauses.keeps,
        comment=comment,
        within=clauses.within,
        limits=clauses.limits,
        avoids=clauses.avoids,
    )


def _steps(
    lines: Sequence[Line], variables: AbstractSet[str], problems: list[Problem]
) -> list[Step]:
    steps = []
    for line in lines:
        try:
            steps.append(_step(Cursor(line, problems), variables))
        except UnreadableError:
            continue
    return steps


def _step(cursor: Cursor, variables: AbstractSet[str]) -> Step:
    """`- NAME(args) [when COND] [bias X]`."""
    cursor.advance()
    name, args = _call(cursor, variables)
    clauses = read_clauses(cursor, "a step", variables)
    return Step(name, args, clauses.when, clauses.bias)


def _call(cursor: Cursor, variables: AbstractSet[str]) -> tuple[str, tuple[Operand, ...]]:
    name = cursor.name("a subtask").text
    opened = cursor.here
    cursor.expect("(", f"{name!r}: a call is NAME(arguments), as in take(Box)")
    args: list[Operand] = []
    if not cursor.accept(")"):
        args.append(operand(cursor.name("an argument").text, variables))
        while cursor.accept(","):
            args.append(operand(cursor.name("an argument").text, variables))
        cursor.close(opened)
    return name, tuple(args)


def read_action(line: Line, steps: Sequence[Line], problems: list[Problem]) -> Action:
    """`action NAME(Params) [when COND] until COND` and what else is known of it.

    Args:
        line: it begins with `action`.
        steps: what stands below it and begins with `-`: a mistake.
        problems: what is wrong is added here.

    Returns:
        The action.

    Raises:
        UnreadableError: when it cannot be read.
    """
    cursor = Cursor(line, problems)
    for step in steps[:1]:
        cursor.note(step.tokens[0], "an action has no steps", "a task in place of the action")
    cursor.advance()
    name, params = head = _head(cursor, "an action")
    clauses = read_clauses(cursor, "an action", variables_of(head))
    if clauses.until is None:
        what = f"action {name!r} has no 'until'"
        cursor.note(line.tokens[0], what, "until and the condition that it makes true")
        raise UnreadableError
    return Action(
        name,
        params,
        until=clauses.until,
        when=clauses.when,
        uses=clauses.uses,
        sets=clauses.sets,
        cancel=clauses.cancel,
        timeout=clauses.timeout,
        retries=clauses.retries,
        backoff=clauses.backoff,
        probe=clauses.probe,
        idempotent=clauses.idempotent,
        within=clauses.within,
        limits=clauses.limits,
        avoids=clauses.avoids,
        comment=joined(line.comments),
    )


def read_term(line: Line, steps: Sequence[Line], problems: list[Problem]) -> Task:
    """`schema(m, <(subtask, precondition), ...>, p)`, the notation of section II-B.

    Args:
        line: it begins with `schema`.
        steps: what stands below it and begins with `-`: a mistake.
        problems: what is wrong is added here.

    Returns:
        The task that the term stands for.

    Raises:
        UnreadableError: when it cannot be read.
    """
    cursor = Cursor(line, problems)
    for step in steps[:1]:
        cursor.note(step.tokens[0], "a term has its steps inside", "them between < and >")
    if not cursor.accept("schema"):
        cursor.fail("'schema(m, <...>, p)'")
    opened = cursor.here
    cursor.expect("(", "'schema'")
    name, params = head = _head(cursor, "a task")
    variables = variables_of(head)
    cursor.expect(",", "the name and its parameters")
    if not cursor.accept(*OPEN_LIST):
        cursor.fail("'<', which opens the list of subtasks")
    read = [_pair(cursor, variables)]
    while cursor.accept(","):
        read.append(_pair(cursor, variables))
    if not cursor.accept(*CLOSE_LIST):
        cursor.fail("',' and another subtask, or '>', which closes the list of subtasks")
    cursor.expect(",", "the list of subtasks, and then the postcondition")
    until = read_condition(cursor, variables)
    cursor.close(opened)
    if not cursor.at_end:
        cursor.fail("nothing behind the term")
    return Task(name, params, tuple(read), until, comment=joined(line.comments))


def _pair(cursor: Cursor, variables: AbstractSet[str]) -> Step:
    """`(subtask, precondition)`."""
    opened = cursor.here
    if not cursor.accept("("):
        cursor.fail("'(', which opens a subtask and its precondition, as in (take(Box), true)")
    name, args = _call(cursor, variables)
    cursor.expect(",", "the subtask, and then its precondition")
    when = read_condition(cursor, variables)
    cursor.close(opened)
    return Step(name, args, when)


def _head(cursor: Cursor, of: str) -> _Head:
    """`NAME(Params)`."""
    name = cursor.name(of).text
    opened = cursor.here
    cursor.expect("(", f"{name!r}: the head is NAME(parameters), as in store(Box)")
    params: list[Param] = []
    if not cursor.accept(")"):
        _add_param(cursor, params)
        while cursor.accept(","):
            _add_param(cursor, params)
        cursor.close(opened)
    return name, tuple(params)


def _add_param(cursor: Cursor, params: list[Param]) -> None:
    """`Box`, which is its own sort, or `From: place`."""
    token = cursor.name("a parameter")
    sort = token
    if cursor.accept(":"):
        sort = cursor.name("a sort")
    if sort.text in BASIC_KINDS:
        what = f"{sort.text!r} is a kind of value and no sort of things"
        cursor.note(sort, what, "a sort, as in Box or From: place")
    if any(param.name == token.text for param in params):
        cursor.note(token, f"parameter {token.text!r} stands twice", "two different names")
        return
    params.append(Param(token.text, sort.text))


def variables_of(head: _Head) -> frozenset[str]:
    """The names of the parameters."""
    return frozenset(param.name for param in head[1])
