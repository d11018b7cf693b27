"""Several tasks at once, as one: what they do to each other can be explored as well."""

from collections.abc import Sequence
from dataclasses import replace

from depal.executive.conditions import AllOf, Condition, Literal
from depal.executive.exploring.grounding import grounded
from depal.executive.schema import Param, Repository, Step, Task
from depal.executive.tree import Node, ground

NAME = "together"


def together(
    repository: Repository, calls: Sequence[tuple[str, Sequence[str]]]
) -> tuple[Repository, tuple[str, ...]]:
    """A repository with a task more, `together`, of which the given ones are the steps.

    It is accomplished when all of them are. One difference to trees of their own remains: a tree
    ends when it is accomplished; a step of this task would begin again if that became untrue.

    Args:
        repository: of schemata.
        calls: the tasks, at least two, with the things that their parameters stand for.

    Returns:
        The repository, and the arguments of the task: the calls as they are written.

    Raises:
        TaskError: an unknown task or a wrong call.
    """
    roots = [ground(repository, name, args).root for name, args in calls]
    task = Task(
        name=NAME,
        params=tuple(Param(f"Task{number}", "task") for number, _ in enumerate(roots, 1)),
        steps=tuple(Step(root.schema.name, tuple(map(Literal, root.args))) for root in roots),
        until=AllOf(tuple(map(_until, roots))),
    )
    labels = tuple(root.label for root in roots)
    return replace(repository, schemata={**repository.schemata, NAME: task}), labels


def _until(root: Node) -> Condition:
    return grounded(root.schema.until, root.binding)
