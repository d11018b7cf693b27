"""Pydantic's list of errors in our own words."""

from collections.abc import Iterator

from pydantic import ValidationError
from pydantic_core import ErrorDetails

from depal.errors import did_you_mean
from depal.logistics.expectations import Expectations
from depal.logistics.findings import Finding, shown
from depal.logistics.quantities import OWN_WORDS

_WANTED = {
    "string_type": "text",
    "float_type": "a number",
    "int_type": "a whole number",
    "bool_type": "true or false",
    "tuple_type": "a list",
    "model_type": "an object",
    "finite_number": "a finite number",
}


def findings_of(error: ValidationError, expectations: Expectations) -> Iterator[Finding]:
    """Everything that pydantic found wrong, each with what the format expects there.

    Args:
        error: what pydantic raised.
        expectations: what the format's schema says about each place.

    Yields:
        One finding per error, at pydantic's path.
    """
    for detail in error.errors(include_url=False):
        yield _finding(detail, expectations)


def _finding(detail: ErrorDetails, expectations: Expectations) -> Finding:
    loc, value = detail["loc"], detail["input"]
    if detail["type"] == "extra_forbidden":
        known = expectations.keys(loc[:-1])
        return Finding(loc, "unknown key", exists=did_you_mean(str(loc[-1])[:100], known))
    expected = expectations.expected(loc)
    if detail["type"] == "missing":
        return Finding(loc, "is missing", expected)
    if detail["type"] == OWN_WORDS:
        own = detail["ctx"]
        return Finding(loc, own["what"], own["expected"] or expected)
    return Finding(loc, _wrong_type(value, _WANTED[detail["type"]]), expected)


def _wrong_type(value: object, wanted: str) -> str:
    if value == "":
        return "is empty"
    if isinstance(value, str):
        return f"{shown(value)} is text, not {wanted}"
    if wanted == "text" and isinstance(value, int | float) and not isinstance(value, bool):
        return f"{shown(value)} is a number, which loses leading zeros: put it in quotes"
    return f"{shown(value)} is not {wanted}"
