"""Results as JSON: whole or not at all, with the version and the command that made them."""

import json
import math
import os
import shlex
import sys
import tempfile
from pathlib import Path

from depal import __version__
from depal.errors import SettingError

Json = dict[str, "Json"] | list["Json"] | str | float | int | bool | None


def write_json(path: Path, fields: dict[str, Json]) -> None:
    """Writes a report.

    Args:
        path: where; replaced in one step.
        fields: the report; numbers that are not finite become null.

    Raises:
        SettingError: the folder does not exist or cannot be written to.
    """
    report: dict[str, Json] = {
        "version": __version__,
        "command": shlex.join(["depal", *sys.argv[1:]]),
        **fields,
    }
    write_text(path, json.dumps(finite(report), indent=2, allow_nan=False) + "\n", "--json")


def write_text(path: Path, text: str, option: str) -> None:
    """Writes a text file in one step.

    Raises:
        SettingError: the folder does not exist or cannot be written to.
    """
    checked_target(path, option)
    try:
        handle, name = tempfile.mkstemp(dir=path.parent, prefix=f".{path.name}.")
        with os.fdopen(handle, "w", encoding="utf-8") as file:
            file.write(text)
        Path(name).chmod(0o644)
        Path(name).replace(path)
    except OSError as error:
        what = f"cannot write {str(path)!r}: {error.strerror}"
        raise SettingError(option, what, "a file in a folder that can be written to") from error


def checked_target(path: Path | None, option: str) -> None:
    """Refuses a target that cannot be written, before long work begins.

    Raises:
        SettingError: the path is a folder, or its folder does not exist.
    """
    if path is None:
        return
    if path.is_dir():
        raise SettingError(option, f"{str(path)!r} is a folder", "the name of a file")
    if not path.parent.is_dir():
        what = f"there is no folder {str(path.parent)!r}"
        raise SettingError(option, what, "a file in a folder that exists")


def finite(value: Json) -> Json:
    """The same value with null for what JSON cannot say."""
    if isinstance(value, float) and not math.isfinite(value):
        return None
    if isinstance(value, dict):
        return {key: finite(part) for key, part in value.items()}
    if isinstance(value, list):
        return [finite(part) for part in value]
    return value
