"""Task files."""

from collections.abc import Sequence
from pathlib import Path
from typing import Final

from depal.errors import Problem, TaskError, did_you_mean
from depal.executive.language.parser import parse_all
from depal.executive.schema import Repository

ENDING: Final = ".task"
LIMIT: Final = 1024 * 1024
"""The largest file that is read [bytes]."""


def read_tasks(path: Path | Sequence[Path]) -> Repository:
    """Reads task files.

    Args:
        path: one file, or several that make one repository together.

    Returns:
        Everything that they declare.

    Raises:
        TaskError: when a file cannot be read, or with every problem of every file.
    """
    paths = [path] if isinstance(path, Path) else list(path)
    if not paths:
        raise TaskError("", [Problem("", "no task file was given", "at least one")])
    texts = []
    problems = []
    for each in paths:
        content = _content(each)
        if isinstance(content, Problem):
            problems.append(content)
        else:
            texts.append((str(each), content))
    if problems:
        raise TaskError("", problems)
    return parse_all(texts)


def _content(path: Path) -> str | Problem:
    """The text of a file, or why there is none."""
    where = str(path)
    try:
        with path.open("rb") as file:
            content = file.read(LIMIT + 1)
    except IsADirectoryError:
        return Problem(where, "is a directory", "a file", _there(path))
    except FileNotFoundError:
        return Problem(where, "no such file", "", _there(path.parent, path.name))
    except (OSError, ValueError) as error:
        reason = getattr(error, "strerror", None) or str(error)
        return Problem(where, f"cannot be read: {reason}")
    if len(content) > LIMIT:
        return Problem(where, "is larger than 1 MiB", "a smaller file")
    try:
        return content.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        line = content.count(b"\n", 0, error.start) + 1
        what = f"line {line}: byte {content[error.start]:#04x} is not UTF-8"
        return Problem(where, what, "a text file in UTF-8")


def _there(folder: Path, name: str = "") -> str:
    """The task files of a folder that could have been meant by a name."""
    try:
        names = [entry.name for entry in folder.iterdir() if entry.suffix == ENDING]
    except OSError:
        return f"there is no folder {str(folder)!r} either"
    return did_you_mean(name, names) if names else f"the folder has no {ENDING} file"
