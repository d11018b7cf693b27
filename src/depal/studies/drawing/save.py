"""Putting a figure into a file: the same figure gives the same bytes, whole or not at all."""

import io
import os
from pathlib import Path

import matplotlib as mpl
from matplotlib.figure import Figure

from depal.errors import SettingError, did_you_mean

DOTS = 200
"""Per inch, in a png: 2,000 pixels across."""

UNDATED: dict[str, dict[str, None]] = {
    ".png": {"Software": None},
    ".svg": {"Date": None, "Creator": None},
    ".pdf": {"CreationDate": None, "Creator": None, "Producer": None},
}
"""What each format would say about when and by what it was made, left out."""


def save_figure(figure: Figure, path: str | Path) -> Path:
    """Writes a figure as png, svg or pdf, as its name ends.

    The file appears whole or not at all; one that was there is replaced.

    Args:
        figure: what to write.
        path: where to.

    Returns:
        The path.

    Raises:
        SettingError: another suffix, no such folder, or the file cannot be written.
    """
    target = Path(path)
    suffix = target.suffix.lower()
    if suffix not in UNDATED:
        what = f"{target.name!r} ends in {suffix!r}" if suffix else f"{target.name!r} has no suffix"
        raise SettingError("figure", what, "a name that ends in .png, .svg or .pdf")
    folder = target.parent
    if not folder.is_dir():
        near = folder.parent
        there = [entry.name for entry in near.iterdir() if entry.is_dir()] if near.is_dir() else []
        what = f"there is no folder {str(folder)!r} for {target.name!r}"
        raise SettingError("figure", what, "a folder that exists", did_you_mean(folder.name, there))
    content = _rendered(figure, suffix)
    file = target.resolve()
    part = file.with_name(f".{file.name}.{os.getpid()}.part")
    try:
        if file.exists() and not file.is_file():
            file.write_bytes(content)  # a pipe or a device: nothing to replace
            return target
        part.write_bytes(content)
        part.replace(file)
    except OSError as problem:
        part.unlink(missing_ok=True)
        what = f"{str(target)!r} cannot be written: {problem.strerror}"
        raise SettingError("figure", what, "a file that may be written") from problem
    return target


def _rendered(figure: Figure, suffix: str) -> bytes:
    """The figure as bytes; matplotlib's settings are as before when this returns."""
    buffer = io.BytesIO()
    with mpl.rc_context({"svg.hashsalt": "depal", "svg.fonttype": "path", "savefig.bbox": None}):
        figure.savefig(buffer, format=suffix[1:], dpi=DOTS, metadata=UNDATED[suffix])
    return buffer.getvalue()
