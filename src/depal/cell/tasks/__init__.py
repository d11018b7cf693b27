"""The repository of tasks: `store.task` is the paper's running example, `cell.task` the rest.

The two files are read together; a cell with other tasks brings other files.
"""

from importlib import resources
from pathlib import Path

from depal.executive.language import read_tasks
from depal.executive.schema import Repository

FILES = ("store.task", "cell.task")


def read_shipped_tasks() -> Repository:
    """Both files as one repository."""
    folder = Path(str(resources.files("depal.cell.tasks")))
    return read_tasks([folder / name for name in FILES])
