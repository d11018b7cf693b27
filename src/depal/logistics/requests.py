"""Requests from files, and whether a delivery can serve them."""

import functools
from collections.abc import Iterable, Iterator, Sequence
from pathlib import Path

from pydantic import ValidationError

from depal.domain import Delivery, Request
from depal.errors import Problem, RequestError
from depal.logistics.expectations import Expectations
from depal.logistics.findings import Finding, choices, place
from depal.logistics.request_model import RequestEntry
from depal.logistics.request_yaml import YamlItem, items_of_yaml
from depal.logistics.sentences import findings_of
from depal.logistics.source_text import read_text

ENDINGS = (".yaml", ".yml")
"""How files of requests end."""

LIMIT = 1
"""No file of requests is larger [MiB]."""


def read_requests(path: Path, delivery: Delivery | None = None) -> tuple[Request, ...]:
    """All requests of a file.

    Args:
        path: a YAML file with a list of requests.
        delivery: the delivery that has to serve them; None where it is not known yet.

    Returns:
        The requests in the order of the file.

    Raises:
        RequestError: the file cannot be used; with everything that is wrong with it.
    """
    source = str(path)
    items = items_of_yaml(read_text(path, RequestError, ENDINGS, LIMIT), source)
    on_note = None if delivery is None else list(delivery.products)
    requests: list[Request] = []
    problems: list[Problem] = []
    for index, item in enumerate(items):
        outcome = _checked(item, on_note)
        if isinstance(outcome, Request):
            requests.append(outcome)
        else:
            problems += [finding.at(_where(index, item, finding)) for finding in outcome]
    if problems:
        raise RequestError(source, problems)
    return tuple(requests)


def check_requests(requests: Iterable[Request], delivery: Delivery) -> None:
    """Refuses requests for products that are not on the note.

    Requests for perceived boxes pass: which boxes there are shows when they are seen.

    Args:
        requests: the requests.
        delivery: the delivery that has to serve them.

    Raises:
        RequestError: with every request that no case of the delivery can serve.
    """
    on_note = list(delivery.products)
    problems = [
        _stranger(request.gtin, on_note).at(f"requests[{index}].gtin")
        for index, request in enumerate(requests)
        if request.gtin is not None and request.gtin not in on_note
    ]
    if problems:
        raise RequestError("", problems)


def _checked(item: YamlItem, on_note: Sequence[str] | None) -> Request | list[Finding]:
    findings = list(item.findings)
    known = {finding.loc for finding in findings}
    entry = None
    try:
        entry = RequestEntry.model_validate(item.value)
    except ValidationError as error:
        shape = findings_of(error, _expectations())
        findings += [finding for finding in shape if finding.loc not in known]
    findings += _contradictions(item, entry)
    gtin = item.value.get("gtin") if isinstance(item.value, dict) else None
    if on_note is not None and isinstance(gtin, str) and gtin not in on_note:
        sound = all(finding.loc != ("gtin",) for finding in findings)
        findings += [_stranger(gtin, on_note)] * sound
    if entry is None or findings:
        order = _expectations().order
        return sorted(findings, key=lambda finding: order(finding.loc))
    return entry.as_request()


@functools.cache
def _expectations() -> Expectations:
    return Expectations(RequestEntry.model_json_schema())


def _contradictions(item: YamlItem, entry: RequestEntry | None) -> Iterator[Finding]:
    if isinstance(item.value, dict) and ("gtin" in item.value) == ("box" in item.value):
        what = "both gtin and box" if "gtin" in item.value else "neither gtin nor box"
        yield Finding((), what, "one of them")
    if entry is not None and entry.due < entry.at:
        what = f"{entry.due:g} s is before the request comes"
        yield Finding(("due",), what, f"{entry.at:g} s or later")


def _stranger(gtin: str, on_note: Sequence[str]) -> Finding:
    what = f"'{gtin}' is not on the note of the delivery"
    return Finding(("gtin",), what, "a product of the note", choices(gtin, on_note))


def _where(index: int, item: YamlItem, finding: Finding) -> str:
    line = item.lines.get(str(finding.loc[0]), item.line) if finding.loc else item.line
    return f"line {line}, {place((index, *finding.loc))}"
