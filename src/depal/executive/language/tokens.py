"""Text into tokens, each with its line and its column."""

import re
from collections.abc import Iterator
from dataclasses import dataclass
from enum import Enum
from typing import Final


class Kind(Enum):
    """What a token is."""

    WORD = "word"
    NUMBER = "number"
    SIGN = "sign"
    COMMENT = "comment"
    STRAY = "stray"
    END = "end"


@dataclass(frozen=True, slots=True)
class Token:
    """A word, a number or a sign of the text.

    Attributes:
        kind: what it is.
        text: as it was written.
        line: counted from one.
        column: of its first character, counted from one.
    """

    kind: Kind
    text: str
    line: int
    column: int

    @property
    def place(self) -> str:
        """Where it stands."""
        return f"line {self.line}, column {self.column}"

    @property
    def next_column(self) -> int:
        """The column after it."""
        return self.column + len(self.text)


_PATTERN: Final = re.compile(
    r"""(?P<word>[A-Za-z_][A-Za-z0-9_]*)
      | (?P<number>[0-9]+(?:\.[0-9]+)?(?:[eE][+-]?[0-9]+)?)
      | (?P<comment>\#.*)
      | (?P<sign><=|>=|!=|==|&&|\|\||[-().,:?|=<>&^~!/¬∧\N{LOGICAL OR}⟨⟩≠≤≥])
      | (?P<space>\s+)
      | (?P<stray>.)
    """,
    re.VERBOSE | re.DOTALL,
)


def tokens_of(row: str, line: int) -> Iterator[Token]:
    """The tokens of one line of text; the last one may be a comment.

    Args:
        row: the line, without its end.
        line: its number.

    Yields:
        The tokens, from left to right. What belongs to no token is a stray one.
    """
    for match in _PATTERN.finditer(row):
        kind = match.lastgroup
        if kind is not None and kind != "space":
            yield Token(Kind(kind), match.group(), line, match.start() + 1)
