"""The numbers and texts that a file may hold, each with its unit and its limits.

Every refusal is in our own words; pydantic only carries it to the right place.
"""

import re
import unicodedata
from collections.abc import Callable
from typing import Annotated

from pydantic import AfterValidator, BeforeValidator, WithJsonSchema
from pydantic_core import PydanticCustomError

from depal.logistics.findings import shown
from depal.logistics.gtin import GTIN_PATTERN, gtin_fault

OWN_WORDS = "depal"
"""The type of a pydantic error whose context is already worded for people."""

LONGEST_SIDE = 2.5
"""No case and no pallet has a longer edge [m]."""

SHORTEST_SIDE = 0.001
"""Nor a shorter one; it is also the tolerance of the checks of the stack [m]."""

FARTHEST_CORNER = 10.0
"""No case stands farther from the pallet's origin along one axis [m]."""

HEAVIEST_CASE = 1000.0
"""No case weighs more [kg]."""

MOST_CASES = 10_000
"""No line promises more cases, and no stack holds more."""

LONGEST_RUN = 7 * 24 * 3600.0
"""No request comes later in a run [s]."""

_UNITS = {"s": 1.0, "min": 60.0, "h": 3600.0}
_DURATION = r"([0-9]+(?:\.[0-9]+)?) *(s|min|h)"


def refused(what: str, expected: str = "") -> PydanticCustomError:
    """A refusal in our own words; without `expected` the field's description stands in."""
    return PydanticCustomError(OWN_WORDS, "{what}", {"what": what, "expected": expected})


def of_length(least: int, most: int, one: str, many: str) -> Callable[[object], object]:
    """A check of a list's length, made before its items are looked at.

    Args:
        least: the smallest number of items.
        most: the largest number of items.
        one: what an item is called.
        many: what several of them are called.

    Returns:
        The check; what is not a list passes, for its type is judged elsewhere.
    """
    exactly = f"{least}" if least == most else f"{least} to {most}"

    def checked(value: object) -> object:
        if isinstance(value, list) and not least <= len(value) <= most:
            count = len(value) or "no"
            raise refused(f"has {count} {one if count == 1 else many}", f"{exactly} of them")
        return value

    return checked


def _said(value: float) -> str:
    return f"{value:.9g}"


def _side(value: float) -> float:
    if value <= 0:
        raise refused(f"{_said(value)} is not positive")
    if value < SHORTEST_SIDE:
        raise refused(f"{_said(value)} m is less than a millimetre")
    if value > LONGEST_SIDE:
        raise refused(f"{_said(value)} is above {LONGEST_SIDE} m: {_smaller_unit(value)}?")
    return value


def _coordinate(value: float) -> float:
    if abs(value) > FARTHEST_CORNER:
        raise refused(f"{_said(value)} is beyond {FARTHEST_CORNER:g} m: {_smaller_unit(value)}?")
    return value


def _smaller_unit(metres: float) -> str:
    return "millimetres" if abs(metres) >= 100 * LONGEST_SIDE else "centimetres or millimetres"


def _mass(value: float) -> float:
    if value <= 0:
        raise refused(f"{_said(value)} is not positive")
    if value > HEAVIEST_CASE:
        raise refused(f"{_said(value)} is above {HEAVIEST_CASE:g} kg: grams?")
    return value


def _count(value: int) -> int:
    if value <= 0:
        raise refused(f"{_said(value)} is not positive")
    if value > MOST_CASES:
        raise refused(f"{_said(value)} is above {MOST_CASES}")
    return value


def _gtin(value: str) -> str:
    fault = gtin_fault(value)
    if fault is not None:
        what, expected = fault
        raise refused("is empty" if value == "" else f"{shown(value)} {what}", expected)
    return value


def _text(value: str) -> str:
    if not value.strip():
        raise refused("is empty")
    if any(unicodedata.category(letter) in {"Cc", "Cs"} for letter in value):
        raise refused(f"{shown(value)} holds a line break or a control character")
    return value


def _share(value: float) -> float:
    if not 0 <= value <= 1:
        percent = ": per cent?" if 1 < value <= 100 else ""  # noqa: PLR2004 - what per cent means
        raise refused(f"{_said(value)} is {'above 1' if value > 1 else 'below 0'}{percent}")
    return value


def _seconds(value: object) -> object:
    """A duration with its unit, in seconds; anything else is left to the check of its type."""
    if not isinstance(value, str):
        return value
    match = re.fullmatch(_DURATION, value)
    if match is None:
        raise refused(f"{shown(value)} is no time", "a time such as 95 s, 1.5 min or 1 h")
    return float(match[1]) * _UNITS[match[2]]


def _moment(value: float) -> float:
    if value < 0:
        raise refused(f"{_said(value)} s is before the start of the run", "0 s or later")
    if value > LONGEST_RUN:
        expected = "a time since the start of the run, such as 95 s"
        raise refused(f"{_said(value)} s is more than a week", expected)
    return value


Side = Annotated[
    float,
    AfterValidator(_side),
    WithJsonSchema(
        {
            "type": "number",
            "minimum": SHORTEST_SIDE,
            "maximum": LONGEST_SIDE,
            "description": f"metres, from {SHORTEST_SIDE} to {LONGEST_SIDE}",
        }
    ),
]
"""An edge [m]."""

Coordinate = Annotated[
    float,
    AfterValidator(_coordinate),
    WithJsonSchema(
        {
            "type": "number",
            "minimum": -FARTHEST_CORNER,
            "maximum": FARTHEST_CORNER,
            "description": "metres",
        }
    ),
]
"""A coordinate in the pallet's frame [m]."""

Mass = Annotated[
    float,
    AfterValidator(_mass),
    WithJsonSchema({"type": "number", "exclusiveMinimum": 0, "maximum": HEAVIEST_CASE}),
]
"""A mass [kg]."""

Count = Annotated[
    int,
    AfterValidator(_count),
    WithJsonSchema({"type": "integer", "minimum": 1, "maximum": MOST_CASES}),
]
"""A number of cases."""

GtinText = Annotated[
    str, AfterValidator(_gtin), WithJsonSchema({"type": "string", "pattern": GTIN_PATTERN})
]
"""A GTIN with its check digit."""

Text = Annotated[str, AfterValidator(_text), WithJsonSchema({"type": "string", "pattern": "\\S"})]
"""A name: one line, not blank."""

Share = Annotated[
    float,
    AfterValidator(_share),
    WithJsonSchema({"type": "number", "minimum": 0, "maximum": 1}),
]
"""A number in [0, 1]."""

Moment = Annotated[
    float,
    BeforeValidator(_seconds),
    AfterValidator(_moment),
    WithJsonSchema(
        {
            "anyOf": [
                {"type": "number", "minimum": 0, "maximum": LONGEST_RUN},
                {"type": "string", "pattern": f"^{_DURATION}$"},
            ]
        }
    ),
]
"""A time since the start of the run [s]."""
