"""A text of declarations into a repository, with every problem at once."""

import dataclasses
import hashlib
from collections.abc import Iterable, Sequence

from depal.errors import Problem, TaskError
from depal.executive.language.cursor import UnreadableError
from depal.executive.language.declaration_reader import read_fact_declaration, read_resource
from depal.executive.language.formatter import format_repository
from depal.executive.language.lines import Line, logical_lines
from depal.executive.language.schema_reader import read_action, read_task, read_term
from depal.executive.language.tokens import Kind
from depal.executive.language.words import DECLARATIONS, listed, meant
from depal.executive.schema import FactDeclaration, Repository, Resource, Schema, Task

_DIGITS = 16


def parse(text: str, source: str = "tasks") -> Repository:
    """Reads a task file's text.

    Args:
        text: declarations of facts, resources, tasks and actions.
        source: what is read, for messages.

    Returns:
        Everything that it declares, with the digest of its canonical text.

    Raises:
        TaskError: with every problem; names that nothing declares are none.
    """
    return parse_all([(source, text)])


def parse_all(texts: Sequence[tuple[str, str]]) -> Repository:
    """Reads several texts as one repository.

    Args:
        texts: pairs of a source and its text; nothing is declared twice among all of them.

    Returns:
        Everything that they declare.

    Raises:
        TaskError: with every problem of every text.
    """
    builder = _Builder()
    problems: list[Problem] = []
    for source, text in texts:
        found: list[Problem] = []
        builder.read(text, source if len(texts) > 1 else "", found)
        problems += found if len(texts) == 1 else _placed(found, source)
    if problems:
        raise TaskError(texts[0][0] if len(texts) == 1 else "", problems)
    repository = Repository(builder.facts, builder.resources, builder.schemata)
    return dataclasses.replace(repository, digest=digest_of(repository))


def parse_term(text: str, source: str = "term") -> Task:
    """Reads a task in the paper's notation.

    Args:
        text: `schema(m, <(subtask, precondition), ...>, p)`, on one line or several; the glyphs
            of logic mean and, or, not, and angle brackets are read like `<` and `>`.
        source: what is read, for messages.

    Returns:
        The task.

    Raises:
        TaskError: when it is no such term.
    """
    problems: list[Problem] = []
    lines = logical_lines(text)
    if not lines:
        raise TaskError(source, [Problem("", "is empty", "schema(m, <...>, p)")])
    whole = Line([token for line in lines for token in line.tokens])
    try:
        task = read_term(whole, [], problems)
    except UnreadableError:
        raise TaskError(source, problems) from None
    if problems:
        raise TaskError(source, problems)
    return task


def digest_of(repository: Repository) -> str:
    """The hash of a repository's canonical text, 16 hexadecimal digits."""
    text = format_repository(repository).encode("utf-8", "surrogatepass")
    return hashlib.sha256(text).hexdigest()[:_DIGITS]


class _Builder:
    """Collects declarations, and notices what is declared twice."""

    def __init__(self) -> None:
        self.facts: dict[str, FactDeclaration] = {}
        self.resources: dict[str, Resource] = {}
        self.schemata: dict[str, Schema] = {}
        self._places: dict[tuple[str, str], str] = {}

    def read(self, text: str, source: str, problems: list[Problem]) -> None:
        """Adds what a text declares."""
        lines = logical_lines(text)
        index = 0
        while index < len(lines):
            line, index = lines[index], index + 1
            steps = []
            while index < len(lines) and lines[index].is_step:
                steps.append(lines[index])
                index += 1
            try:
                self._declare(line, steps, source, problems)
            except UnreadableError:
                continue

    def _declare(self, line: Line, steps: list[Line], source: str, problems: list[Problem]) -> None:
        match line.tokens[0].text:
            case "fact":
                fact = read_fact_declaration(line, problems)
                if self._is_new("fact", fact.name, line, source, problems):
                    self.facts[fact.name] = fact
            case "resource":
                resource = read_resource(line, problems)
                if self._is_new("resource", resource.name, line, source, problems):
                    self.resources[resource.name] = resource
            case "task":
                self._add(read_task(line, steps, problems), line, source, problems)
                return
            case "action":
                self._add(read_action(line, steps, problems), line, source, problems)
                return
            case "schema":
                self._add(read_term(line, steps, problems), line, source, problems)
                return
            case _:
                problems.append(_no_declaration(line))
                return
        problems += [_loose(step) for step in steps[:1]]

    def _add(self, schema: Schema, line: Line, source: str, problems: list[Problem]) -> None:
        if self._is_new("schema", schema.name, line, source, problems):
            self.schemata[schema.name] = schema

    def _is_new(
        self, kind: str, name: str, line: Line, source: str, problems: list[Problem]
    ) -> bool:
        token = line.tokens[0]
        first = self._places.get((kind, name))
        if first is None:
            self._places[kind, name] = f"{token.place} of {source}" if source else token.place
            return True
        what = f"{token.text} {name!r} is declared twice, first at {first}"
        problems.append(Problem(token.place, what, "it once"))
        return False


def _no_declaration(line: Line) -> Problem:
    if line.is_step:
        return _loose(line)
    token = line.tokens[0]
    what = f"{token.text!r} begins no declaration"
    slip = meant(token.text, DECLARATIONS) if token.kind is Kind.WORD else ""
    return Problem(token.place, what, listed(DECLARATIONS), slip)


def _loose(step: Line) -> Problem:
    return Problem(step.tokens[0].place, "a step without a task", "it below a task")


def _placed(problems: Iterable[Problem], source: str) -> list[Problem]:
    return [
        dataclasses.replace(problem, where=f"{source}, {problem.where}") for problem in problems
    ]
