"""Delivery notes as CSV: one line per product."""

import csv
import io
import re
from collections.abc import Iterator

from depal.domain import EURO_PALLET, Delivery
from depal.errors import DeliveryError, Problem
from depal.logistics.checking import checked_delivery
from depal.logistics.findings import Finding, shown
from depal.logistics.json_text import whole_number
from depal.logistics.quantities import MOST_CASES

COLUMNS = ("gtin", "name", "length_m", "width_m", "height_m", "mass_kg", "count")
"""The header, exactly."""

_MOST_ROWS = 2 * MOST_CASES
"""With blank lines and lines that cannot be read."""

_HEADER = ",".join(COLUMNS)
_COLUMN_OF = {"gtin": "gtin", "name": "name", "mass": "mass_kg", "count": "count"}
_WHOLE = re.compile(r"[+-]?[0-9]+")
_NUMBER = re.compile(r"[+-]?([0-9]+\.?[0-9]*|\.[0-9]+)([eE][+-]?[0-9]+)?")


def delivery_of_csv(text: str, name: str, source: str) -> Delivery:
    """The delivery of a note; it comes on a pallet of the default size, stacked unknown how.

    Args:
        text: the note, with its header.
        name: the delivery's id.
        source: where the text comes from, for the error.

    Returns:
        The delivery, without a stack.

    Raises:
        DeliveryError: with everything that is wrong with the note.
    """
    problems: list[tuple[int, Problem]] = []
    numbers: list[int] = []
    lines: list[dict[str, object]] = []
    rows = _rows(text, source, problems)
    _check_header(rows, problems, source)
    for number, cells in rows:
        if len(cells) == len(COLUMNS):
            numbers.append(number)
            lines.append(_line(cells))
        else:
            problems.append((number, _wrong_cells(number, cells)))
    if not lines and not problems:
        raise DeliveryError(source, [Problem("", "the note has no lines", "one line per product")])
    raw = {"id": name, "pallet": {"size": list(EURO_PALLET)}, "lines": lines}
    outcome = checked_delivery(raw)
    if isinstance(outcome, Delivery) and not problems:
        return outcome
    if not isinstance(outcome, Delivery):
        problems += [_placed(finding, numbers) for finding in outcome if lines or finding.loc[1:]]
    problems.sort(key=lambda placed: placed[0])
    raise DeliveryError(source, [problem for _, problem in problems])


def _rows(
    text: str, source: str, problems: list[tuple[int, Problem]]
) -> Iterator[tuple[int, list[str]]]:
    """The rows that are not blank, with the number of the line on which each begins."""
    reader = csv.reader(io.StringIO(text, newline=""), strict=True)
    for _ in range(_MOST_ROWS):
        number = reader.line_num + 1
        try:
            cells = next(reader)
        except StopIteration:
            return
        except csv.Error:
            what = "its quotes do not match, or a cell is endless"
            expected = 'a quote inside a quoted cell is doubled: "12"" tray"'
            problems.append((number, Problem(f"line {number}", what, expected)))
            continue
        if any(cell.strip() for cell in cells):
            yield number, cells
    what = f"has more than {_MOST_ROWS} lines"
    raise DeliveryError(source, [Problem("", what, f"a note of up to {MOST_CASES} lines")])


def _check_header(
    rows: Iterator[tuple[int, list[str]]], problems: list[tuple[int, Problem]], source: str
) -> None:
    number, cells = next(rows, (1, []))
    if problems:
        raise DeliveryError(source, [problems[0][1]])
    if tuple(cells) == COLUMNS:
        return
    line = ",".join(cells)
    separators = {";": "semicolons", "\t": "tabs"}
    found = next((name for mark, name in separators.items() if mark in line), "")
    if not cells:
        problem = Problem("", "no header", _HEADER)
    elif found:
        what = f"the cells are separated by {found}"
        problem = Problem(f"line {number}", what, f"commas, and points in numbers: {_HEADER}")
    else:
        problem = Problem(f"line {number}", f"the header is {shown(line)}", f"exactly {_HEADER}")
    raise DeliveryError(source, [problem])


def _wrong_cells(number: int, cells: list[str]) -> Problem:
    hint = ""
    if len(cells) > len(COLUMNS):
        hint = "numbers take a decimal point, and a name with a comma takes quotes"
    elif len(cells) == 1 and ";" in cells[0]:
        hint = "the cells are separated by semicolons"
    have = f"{len(cells)} cell{'s' * (len(cells) != 1)}"
    return Problem(f"line {number}", have, f"{len(COLUMNS)}: {_HEADER}", hint)


def _line(cells: list[str]) -> dict[str, object]:
    """A row as the line of a JSON file; what is no number stays text and is refused as such."""
    gtin, name, length, width, height, mass, count = cells
    return {
        "gtin": gtin,
        "name": name,
        "size": [_number(length), _number(width), _number(height)],
        "mass": _number(mass),
        "count": _number(count),
    }


def _number(cell: str) -> object:
    text = cell.strip()
    if _WHOLE.fullmatch(text):
        return whole_number(text)
    return float(text) if _NUMBER.fullmatch(text) else text


def _placed(finding: Finding, numbers: list[int]) -> tuple[int, Problem]:
    match finding.loc:
        case ("lines", int(row), "size", int(edge)):
            column = COLUMNS[2 + edge]
        case ("lines", int(row), str(field)):
            column = _COLUMN_OF[field]
        case ("id",):
            return 0, finding.at("the file's name")
        case _:
            return 0, finding.at("")
    twin = f"line {numbers[int(finding.twin[1])]}" if finding.twin else ""
    return numbers[row], finding.at(f"line {numbers[row]}, {column}", twin)
