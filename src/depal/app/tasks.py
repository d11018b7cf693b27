"""`depal tasks`: task files checked, drawn, explored and laid out."""

import re
from collections.abc import Mapping, Sequence
from importlib.resources import files
from pathlib import Path
from typing import Final

from rich.console import RenderableType
from rich.text import Text

from depal.app.files import Json, write_text
from depal.app.reports.report import Report
from depal.cell.files import find_cell
from depal.cell.quantities import QUANTITIES
from depal.errors import Problem, SettingError, TaskError, did_you_mean
from depal.executive.checking import Finding, check
from depal.executive.conditions import Value, at_once
from depal.executive.drawing import tree_mermaid, tree_svg, tree_text
from depal.executive.exploring import Exploration, TraceStep, explore, together
from depal.executive.exploring.grounding import conditions_of
from depal.executive.exploring.together import NAME
from depal.executive.language import format_repository, read_tasks
from depal.executive.schema import Repository, Schema, Task
from depal.executive.tree import Tree, ground, sweep

SHIPPED: Final = {"store": ("store",), "cell": ("store", "cell")}
"""The shipped task files by name, each with those that it builds on."""

_CALL: Final = re.compile(r"\s*(\w+)\s*(?:\(([^()]*)\))?\s*")
_NUMBER: Final = re.compile(r"[+-]?\d+(\.\d*)?([eE][+-]?\d+)?")


def paths_of(name: str) -> list[Path]:
    """The files behind a name: of a shipped file, else a path."""
    if name not in SHIPPED:
        if not Path(name).exists():
            what = f"there is no file {name!r}"
            raise SettingError("FILE", what, "a task file", f"shipped ones {_there(SHIPPED)}")
        return [Path(name)]
    return [Path(str(files("depal.cell.tasks") / f"{one}.task")) for one in SHIPPED[name]]


def _there(names: Mapping[str, object]) -> str:
    return f"by name: {', '.join(names)}"


def repository_of(names: Sequence[str]) -> Repository:
    """Everything that some files declare together.

    Raises:
        InputError: a file that does not exist or cannot be read.
    """
    return read_tasks(list(dict.fromkeys(path for name in names for path in paths_of(name))))


def check_report(names: Sequence[str], cell: str = "") -> Report:
    """Checks task files.

    Args:
        names: of files, which make one repository together.
        cell: a cell file or the name of one that ships, whose zones they may avoid; "" where that
            is not known yet.

    Returns:
        All findings; it holds where none is serious.
    """
    repository = repository_of(names)
    zones = [zone.name for zone in find_cell(cell).zones] if cell else None
    findings = check(repository, None, QUANTITIES, zones)
    mistakes = sum(one.serious for one in findings)
    counts = f"{len(repository.schemata)} schemata, {len(repository.facts)} facts"
    said = f"{_counted(mistakes, 'mistake')}, {_counted(len(findings) - mistakes, 'remark')}"
    shown: list[RenderableType] = [_shown(one) for one in findings]
    shown.append(Text(f"{' '.join(names)}: {counts}; {said}", style="bold"))
    fields: dict[str, Json] = {
        "files": list(names),
        "schemata": len(repository.schemata),
        "mistakes": mistakes,
        "findings": [
            {
                "kind": one.kind.value,
                "serious": one.serious,
                "where": one.where,
                "what": one.what,
                "exists": one.exists,
            }
            for one in findings
        ],
    }
    return Report(fields=fields, shown=shown, holds=not mistakes)


def _shown(finding: Finding) -> Text:
    word, style = ("mistake", "red") if finding.serious else ("remark ", "yellow")
    return Text.assemble((word, style), f"  {finding}")


def _counted(count: int, word: str) -> str:
    return f"{count or 'no'} {word}{'' if count == 1 else 's'}"


def tree_of(name: str, call: str) -> tuple[Repository, Tree]:
    """Allocates a task of a file.

    Args:
        name: of the file.
        call: as in "store(b1)", or "store" for the schema itself; empty for the only task that
            no other one calls.

    Raises:
        InputError: no such file or task, or one with mistakes in it.
    """
    repository = repository_of([name])
    broken = [one for one in check(repository) if one.breaking]
    if broken:
        raise TaskError(name, [Problem(one.where, one.what, exists=one.exists) for one in broken])
    schema, args = _called(repository, name, call)
    return repository, ground(repository, schema.name, args)


def trees_of(name: str, calls: Sequence[str]) -> tuple[Repository, Tree]:
    """Allocates tasks of a file; several of them as one.

    Args:
        name: of the file.
        calls: see `tree_of`; none is the same as an empty one.

    Raises:
        InputError: see `tree_of`.
    """
    trees = [tree_of(name, call) for call in calls or [""]]
    if len(trees) == 1:
        return trees[0]
    roots = [(tree.root.schema.name, tree.root.args) for _, tree in trees]
    repository, labels = together(trees[0][0], roots)
    return repository, ground(repository, NAME, labels)


def _called(repository: Repository, name: str, call: str) -> tuple[Schema, tuple[str, ...]]:
    tasks = {one.name: one for one in repository.schemata.values() if isinstance(one, Task)}
    inner = {step.schema for task in tasks.values() for step in task.steps}
    outer = [task for task in tasks if task not in inner]
    match = _CALL.fullmatch(call) if call else None
    if call and match is None:
        raise SettingError("TASK", f"{call!r} is no call of a task", "one as in store(b1)")
    if match is None and len(outer) != 1:
        exists = did_you_mean("", tasks, limit=len(tasks))
        raise SettingError("TASK", f"{name} has several tasks to choose from", exists=exists)
    wanted = match[1] if match else outer[0]
    schema = repository.schemata.get(wanted)
    if schema is None:
        exists = did_you_mean(wanted, tasks, limit=len(tasks))
        raise SettingError("TASK", f"{name} has no task {wanted!r}", exists=exists)
    if match is None or match[2] is None:
        return schema, tuple(param.name for param in schema.params)
    return schema, tuple(arg.strip() for arg in match[2].split(",") if arg.strip())


def drawing(name: str, call: str, facts: str | None, form: str) -> str:
    """Draws a task.

    Args:
        name: of the file.
        call: see `tree_of`.
        facts: what is the case, as in "b1.taken=true,b1.target=shelf"; None for no states.
        form: text, svg or mermaid.

    Returns:
        The drawing.

    Raises:
        InputError: nothing that can be drawn.
    """
    forms = {"text": tree_text, "svg": tree_svg, "mermaid": tree_mermaid}
    if form not in forms:
        raise SettingError("--format", f"unknown format {form!r}", exists=did_you_mean(form, forms))
    repository, tree = tree_of(name, call)
    if facts is None:
        return forms[form](tree, None)
    return forms[form](tree, sweep(tree, facts_of(repository, tree, facts), at_once))


def facts_of(repository: Repository, tree: Tree, written: str) -> dict[str, Value]:
    """Facts as they are written behind an option.

    Raises:
        SettingError: a fact without a value, or one that the tree does not mention.
    """
    known = {key for node in conditions_of(repository, tree) for one in node for key in one.facts}
    facts = {}
    for part in filter(None, (part.strip() for part in written.split(","))):
        key, sign, value = (piece.strip() for piece in part.partition("="))
        if not sign:
            raise SettingError("--facts", f"{part!r} has no value", f"one as in {part}=true")
        if key not in known:
            what = f"no condition of {tree.root.label} mentions {key!r}"
            raise SettingError("--facts", what, exists=did_you_mean(key, known))
        facts[key] = value_of(value)
    return facts


def value_of(written: str) -> Value:
    """A value as it is written: true, false, empty, a number, or a name."""
    words: dict[str, Value] = {"true": True, "false": False, "empty": None, "": None}
    if written in words:
        return words[written]
    return float(written) if _NUMBER.fullmatch(written) else written


def explore_report(
    name: str,
    calls: Sequence[str],
    *,
    limit: int,
    disturb: Sequence[str],
    split: bool,
    facts: str | None,
) -> Report:
    """Explores a task, or several at once.

    Args:
        name: of the file.
        calls: see `trees_of`.
        limit: of the number of states.
        disturb: facts that change by themselves, as in "Box.taken" or "Box.taken=false".
        split: whether changes of several facts come one by one.
        facts: what is the case at first; None for nothing.

    Returns:
        What was found; it holds where there is no hazard.
    """
    repository, tree = trees_of(name, calls)
    wanted: dict[str, list[Value]] = {}
    for part in disturb:
        key, sign, value = part.partition("=")
        wanted.setdefault(key, []).extend([value_of(value)] if sign else [])
    found = explore(
        repository,
        tree.root.schema.name,
        tree.root.args,
        limit,
        facts=None if facts is None else facts_of(repository, tree, facts),
        disturbances=wanted,
        atomic=not split,
    )
    return Report(fields=_fields(found), shown=_lines(found), holds=not found.hazards)


def _lines(found: Exploration) -> list[RenderableType]:
    lines: list[RenderableType] = []
    for hazard in found.hazards:
        lines.append(Text.assemble((hazard.kind.value, "red"), f": {hazard.what}"))
        lines += [Text(f"  {n:>2}  {one.what}", "dim") for n, one in enumerate(hazard.trace, 1)]
    lines += [Text.assemble(("waits", "yellow"), f": for {one.what}") for one in found.waits]
    lines += [Text.assemble(("idle", "yellow"), f": {one} never starts") for one in found.idle]
    if found.attended:
        lines.append(
            Text.assemble(
                ("asks", "yellow"),
                f": in {_counted(found.attended, 'state')} a person decides about another try",
            )
        )
    extent = "all" if found.complete else "the limit was reached after"
    lines.append(
        Text(
            f"{found.task}: {extent} {found.states} states ({found.valuations} sets of facts, "
            f"{found.transitions} transitions); {_counted(len(found.hazards), 'hazard')}",
            style="bold",
        )
    )
    return lines


def _fields(found: Exploration) -> dict[str, Json]:
    return {
        "task": found.task,
        "states": found.states,
        "valuations": found.valuations,
        "transitions": found.transitions,
        "complete": found.complete,
        "hazards": [
            {"kind": one.kind.value, "what": one.what, "trace": _trace(one.trace)}
            for one in found.hazards
        ],
        "waits": [{"what": one.what, "trace": _trace(one.trace)} for one in found.waits],
        "idle": list(found.idle),
        "attended": found.attended,
    }


def _trace(steps: Sequence[TraceStep]) -> list[Json]:
    return [
        {"what": one.what, "facts": dict(one.facts), "running": list(one.running)} for one in steps
    ]


def formatted(name: str, *, write: bool) -> tuple[str, bool]:
    """A task file in its canonical layout.

    Args:
        name: of the file; of a shipped one that alone.
        write: whether the file is replaced where it differs.

    Returns:
        The canonical text, and whether the file already had it.
    """
    path = paths_of(name)[-1]
    text = format_repository(read_tasks([path]))
    same = path.read_text(encoding="utf-8") == text
    if write and not same:
        write_text(path, text, "--write")
    return text, same
