"""Trade item numbers as people and spreadsheets write them."""

import re

from biip.checksums import gs1_standard_check_digit

DIGITS = "8, 12, 13 or 14 digits"
"""The lengths that a GTIN can have (GS1 General Specifications, section 7.9.1)."""

GTIN_PATTERN = "^([0-9]{8}|[0-9]{12,14})$"
"""The same as a regular expression."""

_LENGTHS = (8, 12, 13, 14)
_MOST_LOST = 3
_ROUNDED = re.compile(r"[0-9]+([.,][0-9]+)?[eE]\+?[0-9]+")


def gtin_fault(text: str) -> tuple[str, str] | None:
    """What is wrong with a text that should be a GTIN.

    Args:
        text: any text.

    Returns:
        What is wrong and what was expected; None when the text is a GTIN.
    """
    if _ROUNDED.fullmatch(text):
        return "was rounded by a spreadsheet", f"{DIGITS}, from a column formatted as text"
    if not (text.isascii() and text.isdigit()):
        return "is not made of digits alone", DIGITS
    if len(text) not in _LENGTHS:
        return f"has {len(text)} digit{'s' * (len(text) != 1)}", DIGITS + _lost_zeros(text)
    right = str(gs1_standard_check_digit(text[:-1]))
    if text[-1] != right:
        return f"ends in the wrong check digit {text[-1]}", f"{right}, as in {text[:-1]}{right}"
    return None


def same_article(gtin: str) -> str:
    """The 14 digits that a GTIN of any length stands for."""
    return gtin.zfill(_LENGTHS[-1])


def _lost_zeros(text: str) -> str:
    """Spreadsheets drop leading zeros; the check digit tells when that is what happened."""
    longer = [length for length in _LENGTHS if length > len(text)]
    if (
        not longer
        or longer[0] - len(text) > _MOST_LOST
        or gtin_fault(text.zfill(longer[0])) is not None
    ):
        return ""
    return f"; with its leading zeros it would be {text.zfill(longer[0])}"
