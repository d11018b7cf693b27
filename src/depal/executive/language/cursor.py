"""A place in a logical line, and the words for what is wrong there."""

import math
from collections.abc import Collection
from typing import Final, NoReturn

from depal.errors import Problem
from depal.executive.language.lines import Line
from depal.executive.language.tokens import Kind, Token
from depal.executive.language.words import KEYWORDS, SECONDS, listed, meant

LARGEST_COUNT: Final = 1_000_000
"""The largest whole number that counts anything."""


class UnreadableError(Exception):
    """A logical line cannot be read any further; the problem is already noted."""


class Cursor:
    """Reads a logical line from left to right.

    Attributes:
        problems: what was wrong so far, in the order of the text.
    """

    def __init__(self, line: Line, problems: list[Problem]) -> None:
        """Starts before the first token."""
        self._tokens = [*line.tokens, line.end]
        self._index = 0
        self.problems = problems

    @property
    def here(self) -> Token:
        """The next token; at the end an empty one."""
        return self._tokens[self._index]

    @property
    def at_end(self) -> bool:
        """Whether the line is used up."""
        return self.here.kind is Kind.END

    @property
    def is_call(self) -> bool:
        """Whether the next two tokens are a name and an opening parenthesis."""
        return self.here.kind is Kind.WORD and self._tokens[self._index + 1].text == "("

    @property
    def is_fact(self) -> bool:
        """Whether the next two tokens are a name and a full stop."""
        return self.here.kind is Kind.WORD and self._tokens[self._index + 1].text == "."

    def advance(self) -> Token:
        """Takes the next token; never at the end."""
        token = self.here
        self._index += 1
        return token

    def accept(self, *texts: str) -> bool:
        """Takes the next token if it is one of these."""
        if self.here.text in texts and not self.at_end:
            self._index += 1
            return True
        return False

    def expect(self, text: str, after: str) -> None:
        """Takes the next token, which must be this one."""
        if not self.accept(text):
            slip = self.here.kind is Kind.WORD
            self.fail(f"{text!r} after {after}", meant(self.here.text, (text,)) if slip else "")

    def close(self, opened: Token) -> None:
        """Takes the parenthesis that closes another one."""
        if not self.accept(")"):
            self.fail(f"')' to close the '(' at {opened.place}")

    def name(self, of: str) -> Token:
        """Takes a name.

        Args:
            of: what it names, for instance "a task".
        """
        token = self.here
        if token.kind is Kind.WORD and token.text in KEYWORDS:
            self.fail(f"the name of {of}", what=f"{token.text!r} is a keyword and cannot be a name")
        if token.kind is not Kind.WORD:
            self.fail(f"the name of {of}, made of letters, digits and underscores")
        return self.advance()

    def number(self, of: str) -> float:
        """Takes a number, which may be negative."""
        negative = self.accept("-")
        if self.here.kind is not Kind.NUMBER:
            self.fail(of)
        value = float(self.here.text)
        if not math.isfinite(value):
            self.fail(of, what="the number is too large")
        self.advance()
        return -value if negative else value

    def count(self, of: str, least: int) -> int:
        """Takes a whole number of at least so much."""
        first = self.here
        expected = f"{of}, a whole number from {least} to {LARGEST_COUNT}"
        value = self.number(expected)
        if not value.is_integer() or not least <= value <= LARGEST_COUNT:
            self.note(first, f"{self.since(first)} is out of range", expected)
            return least
        return int(value)

    def duration(self, of: str) -> float:
        """Takes a number and its unit [s]."""
        first = self.here
        value = self.number(f"{of}, a number and its unit as in 5 s")
        if self.here.text not in SECONDS:
            units = listed(tuple(SECONDS))
            self.fail(f"the unit of {of}: {units}")
        unit = self.advance().text
        seconds = value / 1000 if unit == "ms" else value * SECONDS[unit]
        if not 0 < seconds < math.inf:
            self.note(first, f"{self.since(first)} is no duration", f"{of}, more than 0 s")
            return 1.0
        return seconds

    def unit(self, of: str, units: Collection[str]) -> str:
        """Takes a unit, as in kg or m/s."""
        written = self.here.text
        if self._tokens[min(self._index + 1, len(self._tokens) - 1)].text == "/":
            written += "".join(token.text for token in self._tokens[self._index + 1 :][:2])
        if written not in units:
            self.fail(f"the unit of {of}: {listed(tuple(units))}")
        for _ in range(3 if "/" in written else 1):
            self.advance()
        return written

    def since(self, first: Token) -> str:
        """What was written from a token up to here."""
        start = self._tokens.index(first)
        text = ""
        for token in self._tokens[start : self._index]:
            text += token.text if text in {"", "-"} else f" {token.text}"
        return repr(text)

    def note(self, token: Token, what: str, expected: str = "", exists: str = "") -> None:
        """Notes a problem; reading goes on."""
        self.problems.append(Problem(token.place, what, expected, exists))

    def fail(self, expected: str, exists: str = "", what: str = "") -> NoReturn:
        """Notes that the next token is not what was expected, and gives the line up.

        Raises:
            UnreadableError: always.
        """
        token = self.here
        if not what and token.kind is Kind.STRAY:
            what = f"{token.text!r} has no meaning in a task file"
        elif not what and self.at_end:
            what = "the declaration ends too early"
        self.note(token, what or f"unexpected {token.text!r}", expected, exists)
        raise UnreadableError
