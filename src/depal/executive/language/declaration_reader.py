"""Declarations of facts and resources."""

import difflib
from typing import Final

from depal.errors import Problem
from depal.executive.language.cursor import Cursor
from depal.executive.language.lines import Line, joined
from depal.executive.language.tokens import Kind, Token
from depal.executive.language.words import KEYWORDS
from depal.executive.schema import BASIC_KINDS, FLAG, FactDeclaration, FactType, Resource

_OTHER_WORDS: Final = {
    **dict.fromkeys(("bool", "boolean"), "flag"),
    **dict.fromkeys(("int", "integer", "float", "double", "real"), "number"),
    **dict.fromkeys(("str", "string", "char"), "text"),
}
"""What other languages call the basic kinds."""

_ALIKE = 0.8


def read_fact_declaration(line: Line, problems: list[Problem]) -> FactDeclaration:
    """`fact SUBJECT.ATTR : KIND [| KIND ...] [?]`.

    Args:
        line: it begins with `fact`.
        problems: what is wrong is added here.

    Returns:
        The declaration.

    Raises:
        UnreadableError: when it cannot be read.
    """
    cursor = Cursor(line, problems)
    cursor.advance()
    subject = cursor.name("a sort or a thing").text
    cursor.expect(".", f"{subject!r}: a fact is SUBJECT.ATTR, as in Box.taken")
    attribute = cursor.name("an attribute").text
    cursor.expect(":", f"{subject}.{attribute} and then what it may hold")
    kinds = [_kind(cursor)]
    while cursor.accept("|"):
        token = cursor.here
        kind = _kind(cursor)
        if kind in kinds:
            cursor.note(token, f"{kind!r} stands twice among the kinds", "it once")
        kinds.append(kind)
    mark = cursor.here
    optional = cursor.accept("?")
    if optional and kinds == [FLAG]:
        cursor.note(mark, "a flag is never empty: what is not set is false", "flag without '?'")
    if not cursor.at_end:
        after = "" if optional else "'|' and another kind, '?' or "
        cursor.fail(f"{after}the end of the line")
    kind_of_fact = FactType(tuple(dict.fromkeys(kinds)), optional)
    return FactDeclaration(subject, attribute, kind_of_fact, joined(line.comments))


def _kind(cursor: Cursor) -> str:
    token = cursor.here
    if token.kind is not Kind.WORD or token.text in KEYWORDS:
        cursor.fail("what the fact may hold: flag, number, text, place or a sort as in Box")
    basic = _meant_kind(token)
    if basic:
        what = f"{token.text!r} is no kind of value"
        expected = "flag, number, text, place or a sort as in Box"
        cursor.note(token, what, expected, f"did you mean {basic!r}?")
    return cursor.advance().text


def _meant_kind(token: Token) -> str:
    """The basic kind that a word is a slip of, or nothing."""
    if token.text in BASIC_KINDS:
        return ""
    word = token.text.lower()
    if word in BASIC_KINDS:
        return word
    if word in _OTHER_WORDS:
        return _OTHER_WORDS[word]
    for kind in BASIC_KINDS:
        swapped = sorted(kind) == sorted(word)
        if swapped or difflib.SequenceMatcher(None, kind, word).ratio() >= _ALIKE:
            return kind
    return ""


def read_resource(line: Line, problems: list[Problem]) -> Resource:
    """`resource NAME capacity N`.

    Args:
        line: it begins with `resource`.
        problems: what is wrong is added here.

    Returns:
        The resource.

    Raises:
        UnreadableError: when it cannot be read.
    """
    cursor = Cursor(line, problems)
    cursor.advance()
    name = cursor.name("a resource").text
    cursor.expect("capacity", f"the resource {name!r}, and how many may use it at a time")
    capacity = cursor.count("a capacity", least=1)
    if not cursor.at_end:
        cursor.fail("the end of the line")
    return Resource(name, capacity, joined(line.comments))
