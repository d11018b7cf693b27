"""JSON as the standard has it: no NaN that passes for a number, no key that stands twice."""

import json
import math
from collections.abc import Iterator

from depal.errors import DeliveryError, Problem
from depal.logistics.findings import Finding, Loc, shown

_LONGEST_NUMBER = 300
"""Digits; a longer whole number is infinite for a 64-bit float."""

_MOST_KEYS = 100
"""No object of the format has more than five."""


class _EndlessObjectError(Exception):
    """An object so large that naming each of its keys helps nobody."""


class RepeatedKeys(dict[str, object]):
    """An object of the file in which keys stand more than once; it keeps the last values."""

    def __init__(self, pairs: list[tuple[str, object]]) -> None:
        """Keeps the last value of every key, and which keys came twice."""
        super().__init__(pairs)
        seen: set[str] = set()
        self.repeated: list[str] = []
        for key, _ in pairs:
            if key in seen and key not in self.repeated:
                self.repeated.append(key)
            seen.add(key)


def json_value(text: str, source: str) -> object:
    """The value that a JSON text stands for.

    Args:
        text: the text.
        source: where it comes from, for the error.

    Returns:
        The value; an object with repeated keys is a `RepeatedKeys`. NaN and infinities stay
        floats: no field takes them.

    Raises:
        DeliveryError: the text is not JSON; with the line and the column where it breaks off.
    """
    try:
        return json.loads(text, object_pairs_hook=_object, parse_int=whole_number)
    except json.JSONDecodeError as error:
        where = f"line {error.lineno}, column {error.colno}"
        problem = Problem(where, _syntax(error), "JSON", _csv_hint(text))
        raise DeliveryError(source, [problem]) from None
    except _EndlessObjectError as error:
        problem = Problem("", f"an object has {error} keys", "a delivery, whose objects have few")
        raise DeliveryError(source, [problem]) from None
    except RecursionError:
        problem = Problem("", "lists within lists, too deep to be a delivery")
        raise DeliveryError(source, [problem]) from None


def repeated_keys(value: object) -> Iterator[Finding]:
    """Every key that stands twice in its object, wherever that object is.

    Args:
        value: what `json_value` gave.

    Yields:
        One finding per key, at the key.
    """
    waiting: list[Iterator[tuple[Loc, object]]] = [iter([((), value)])]
    while waiting:
        for loc, node in waiting[-1]:
            if isinstance(node, RepeatedKeys):
                for key in node.repeated:
                    yield Finding((*loc, key), "the key stands here twice", "every key once")
            if isinstance(node, dict | list):
                waiting.append(_inside(loc, node))
                break
        else:
            waiting.pop()


def _inside(loc: Loc, node: dict[str, object] | list[object]) -> Iterator[tuple[Loc, object]]:
    steps = node.items() if isinstance(node, dict) else enumerate(node)
    for step, inner in steps:
        yield (*loc, step), inner


def whole_number(digits: str) -> int | float:
    """A whole number as it is written; infinite where no float could hold it."""
    if len(digits) > _LONGEST_NUMBER:
        return -math.inf if digits.startswith("-") else math.inf
    return int(digits)


def _object(pairs: list[tuple[str, object]]) -> dict[str, object]:
    if len(pairs) > _MOST_KEYS:
        raise _EndlessObjectError(len(pairs))
    printable = [(_printable(key), value) for key, value in pairs]
    plain = dict(printable)
    return plain if len(plain) == len(pairs) else RepeatedKeys(printable)


def _printable(key: str) -> str:
    """Half of a surrogate pair is no character, and pydantic takes no key with one."""
    return key.encode("utf-8", "backslashreplace").decode()


def _syntax(error: json.JSONDecodeError) -> str:
    rest = error.doc[error.pos :]
    if not rest.strip():
        return "is empty" if not error.doc.strip() else "the file ends too early"
    if error.msg == "Extra data":
        return f"more text after the end: {shown(_word(rest))}"
    if error.msg.startswith("Unterminated string"):
        return f"a text that never ends: {shown(_word(rest))}"
    return f"unexpected {shown(_word(rest))}"


def _word(rest: str) -> str:
    return rest[:20].split("\n", maxsplit=1)[0].split(" ", maxsplit=1)[0] or rest[:1]


def _csv_hint(text: str) -> str:
    is_note = text.lstrip().startswith(("gtin,", "gtin;"))
    return "a note as CSV is told by the file's ending .csv" if is_note else ""
