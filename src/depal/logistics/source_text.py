"""Files as text, with an error that says why one cannot be read."""

from pathlib import Path

from depal.errors import InputError, Problem, did_you_mean

MEBIBYTE = 1024 * 1024
"""Bytes in one MiB."""


def read_text(path: Path, kind: type[InputError], endings: tuple[str, ...], limit: int) -> str:
    """The text of a file.

    Args:
        path: the file.
        kind: the class of the error.
        endings: how files of this kind end, to name others that exist.
        limit: the largest size that is read [MiB].

    Returns:
        The text, decoded from UTF-8, without a byte order mark.

    Raises:
        InputError: of the given kind, when the file cannot be read.
    """
    source = str(path)
    try:
        with path.open("rb") as file:
            content = file.read(limit * MEBIBYTE + 1)
    except (FileNotFoundError, NotADirectoryError):
        raise kind(source, [_missing(path, endings)]) from None
    except IsADirectoryError:
        problem = Problem("", "is a directory", "a file", _others("", path, endings))
        raise kind(source, [problem]) from None
    except (OSError, ValueError) as error:
        reason = getattr(error, "strerror", None) or str(error)
        raise kind(source, [Problem("", f"cannot be read: {reason}")]) from None
    if len(content) > limit * MEBIBYTE:
        raise kind(source, [Problem("", f"is larger than {limit} MiB", "a smaller file")])
    try:
        return content.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        line = content.count(b"\n", 0, error.start) + 1
        what = f"byte {content[error.start]:#04x} is not UTF-8"
        raise kind(source, [Problem(f"line {line}", what, "a text file in UTF-8")]) from None


def _missing(path: Path, endings: tuple[str, ...]) -> Problem:
    if not path.parent.is_dir():
        return Problem("", "no such file", exists=f"there is no folder {str(path.parent)!r} either")
    return Problem("", "no such file", exists=_others(path.name, path.parent, endings))


def _others(name: str, folder: Path, endings: tuple[str, ...]) -> str:
    """The files of a folder that could have been meant by a name."""
    try:
        files = [entry.name for entry in folder.iterdir() if entry.suffix.lower() in endings]
    except OSError:
        files = []
    return did_you_mean(name, files) if files else f"the folder has no {' or '.join(endings)} file"
