"""Results as JSON: whole or not at all, with the version and the command that made them."""

import json
import math
import os
import shlex
import sys
from pathlib import Path

from depal import __version__
from depal.errors import SettingError

Json = dict[str, "Json"] | list["Json"] | str | float | int | bool | None


PICTURES = (".png", ".svg", ".pdf")
"""The suffixes of pictures that can be drawn."""


def write_json(path: Path, fields: dict[str, Json]) -> None:
    """Writes a report.

    Args:
        path: where; replaced in one step.
        fields: the report; numbers that are not finite become null.

    Raises:
        SettingError: the folder does not exist or cannot be written to.
    """
    write_text(path, report_text(fields), "--json")


def report_text(fields: dict[str, Json]) -> str:
    """A report as JSON, with the version and the command that made it.

    Args:
        fields: the report; numbers that are not finite become null.
    """
    report: dict[str, Json] = {
        "version": __version__,
        "command": shlex.join(["depal", *sys.argv[1:]]),
        **fields,
    }
    return json.dumps(finite(report), indent=2, allow_nan=False) + "\n"


def write_text(path: Path, text: str, option: str) -> None:
    """Writes a text file in one step.

    Raises:
        SettingError: the folder does not exist or cannot be written to.
    """
    checked_target(path, option)
    target = path.resolve()
    part = target.with_name(f".{target.name}.{os.getpid()}.part")
    try:
        if target.exists() and not target.is_file():
            target.write_text(text, encoding="utf-8")  # a pipe or a device: nothing to replace
            return
        part.write_text(text, encoding="utf-8")
        part.replace(target)
    except OSError as error:
        part.unlink(missing_ok=True)
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
    if not path.resolve().parent.is_dir():
        what = f"there is no folder {str(path.parent)!r}"
        raise SettingError(option, what, "a file in a folder that exists")


def checked_targets(json_file: Path | None, plot: Path | None) -> None:
    """Refuses targets of a study before it begins.

    Raises:
        SettingError: one cannot be written, the picture's suffix is unknown, or both are one.
    """
    checked_target(json_file, "--json")
    checked_target(plot, "--plot")
    if plot is None:
        return
    if plot.suffix.lower() not in PICTURES:
        what = f"{plot.name!r} is no picture's name"
        raise SettingError("--plot", what, f"a name that ends in {', '.join(PICTURES)}")
    if json_file is not None and json_file.resolve() == plot.resolve():
        what = f"--json and --plot both name {str(plot)!r}"
        raise SettingError("--plot", what, "two different files")


def finite(value: Json) -> Json:
    """The same value with null for what JSON cannot say."""
    if isinstance(value, float) and not math.isfinite(value):
        return None
    if isinstance(value, dict):
        return {key: finite(part) for key, part in value.items()}
    if isinstance(value, list):
        return [finite(part) for part in value]
    return value
