"""The tasks of a run: those that ship, or a store's own."""

from collections.abc import Sequence
from pathlib import Path
from typing import Final

from depal.cell.quantities import QUANTITIES
from depal.cell.tasks import read_shipped_tasks
from depal.domain import CellLayout
from depal.errors import Problem, TaskError
from depal.executive.checking import check
from depal.executive.language import read_tasks
from depal.executive.schema import Action, Repository

CALLED: Final = (
    "depalletize",
    "store",
    "set_aside",
    "hand_over",
    "recover",
    "exchange",
    "restart_arm",
)
"""Tasks that the cell allocates by itself."""


def tasks_of(files: Sequence[str], layout: CellLayout) -> Repository:
    """What a cell can do, checked against what it has.

    Args:
        files: task files that make one repository together, in place of the shipped ones; none
            for those.
        layout: of the cell.

    Raises:
        TaskError: with every mistake in them, before anything moves.
    """
    shipped = read_shipped_tasks()
    tasks = read_tasks([Path(each) for each in files]) if files else shipped
    bound = [name for name, schema in shipped.schemata.items() if isinstance(schema, Action)]
    zones = [zone.name for zone in layout.zones]
    found = [one for one in check(tasks, bound, QUANTITIES, zones) if one.serious]
    problems = [Problem(one.where, one.what, exists=one.exists) for one in found]
    problems += [
        Problem("", f"there is no task {name!r}, which the cell calls by itself")
        for name in CALLED
        if name not in tasks.schemata
    ]
    if problems:
        raise TaskError(", ".join(files) or "the shipped tasks", problems)
    return tasks
