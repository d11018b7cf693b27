"""Lines of at most 100 columns."""

import re
import textwrap
from typing import Final

from depal.executive.language.condition_text import GLUE

WIDTH: Final = 100
"""Columns of a line."""


def fits(text: str) -> bool:
    """Whether a line is short enough."""
    return len(text) <= WIDTH


def wrapped(text: str, indent: str, hanging: str) -> list[str]:
    """A text broken at its spaces into lines.

    Args:
        text: without indentation; a line that fits is left as it is.
        indent: of the first line.
        hanging: of the others.

    Returns:
        The lines; only a word longer than a line sticks out.
    """
    if fits(indent + text):
        return [indent + text]
    lines = []
    current = ""
    for piece in re.split(" +", text):
        if current and not fits(f"{current} {piece}"):
            lines.append(current)
            current = hanging + piece
        else:
            current = f"{current} {piece}" if current else indent + piece
    return [*lines, current]


def comment_lines(comment: str) -> list[str]:
    """A comment as lines above a declaration."""
    lines = textwrap.wrap(
        comment, WIDTH - len("# "), break_long_words=False, break_on_hyphens=False
    )
    return [f"# {line}" for line in lines]


def with_comment(code: list[str], comment: str) -> list[str]:
    """A comment behind a single line where it fits, else above it."""
    if not comment:
        return code
    behind = f"{code[0]}  # {comment}"
    if len(code) == 1 and fits(behind):
        return [behind]
    return [*comment_lines(comment), *code]


def column(texts: list[str], widest: int) -> int:
    """A common width for texts that stand below each other; the very long ones stick out."""
    return max((len(text) for text in texts if len(text) <= widest), default=0)


def finished(lines: list[str]) -> str:
    """Lines as text, without glue."""
    return "\n".join(line.rstrip(" ").replace(GLUE, " ") for line in lines)
