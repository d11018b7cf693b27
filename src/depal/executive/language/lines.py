"""Tokens into logical lines: one declaration or one step each, with its comment.

A line that is indented, or that begins with a sign, continues the one before it; a term of the
paper goes on until its parentheses are closed. A word that begins declarations begins one wherever
it stands first, and `-` begins a step.
"""

from dataclasses import dataclass, field

from depal.executive.language.tokens import Kind, Token, tokens_of
from depal.executive.language.words import DECLARATIONS


@dataclass(slots=True)
class Line:
    """A logical line.

    Attributes:
        tokens: at least one.
        comments: what stands directly above it, inside it and behind it, without the hashes.
        depth: how many parentheses are open behind it.
    """

    tokens: list[Token]
    comments: list[str] = field(default_factory=list)
    depth: int = 0

    def add(self, tokens: list[Token]) -> None:
        """Lets the line go on."""
        self.tokens += tokens
        self.depth += _depth(tokens)

    @property
    def is_open_term(self) -> bool:
        """Whether it is a term of the paper whose parentheses are not closed yet."""
        return self.tokens[0].text == "schema" and self.depth > 0

    @property
    def is_step(self) -> bool:
        """Whether it is one step of a task."""
        return self.tokens[0].text == "-"

    @property
    def end(self) -> Token:
        """An empty token right behind the last one."""
        last = self.tokens[-1]
        return Token(Kind.END, "", last.line, last.next_column)


def logical_lines(text: str) -> list[Line]:
    """The logical lines of a text; comments that stand alone are dropped."""
    lines: list[Line] = []
    above: list[str] = []
    rows = text.removeprefix("\ufeff").replace("\r\n", "\n").replace("\r", "\n").split("\n")
    for number, row in enumerate(rows, start=1):
        tokens = list(tokens_of(row, number))
        if not tokens:
            above = []
            continue
        comment = []
        if tokens[-1].kind is Kind.COMMENT:
            comment = [tokens.pop().text.removeprefix("#")]
        if not tokens:
            above += comment
            continue
        if lines and _continues(lines[-1], tokens[0]):
            lines[-1].add(tokens)
            lines[-1].comments += above + comment
        else:
            lines.append(Line(tokens, above + comment, _depth(tokens)))
        above = []
    return lines


def joined(comments: list[str]) -> str:
    """Comments as one paragraph."""
    return " ".join(" ".join(comments).split())


def _continues(line: Line, first: Token) -> bool:
    if first.text == "-" or first.text in DECLARATIONS:
        return False
    return first.column > 1 or first.kind is Kind.SIGN or line.is_open_term


def _depth(tokens: list[Token]) -> int:
    return sum((token.text == "(") - (token.text == ")") for token in tokens)
