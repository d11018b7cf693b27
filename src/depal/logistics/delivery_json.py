"""Delivery files as JSON: one delivery or a list of them."""

from depal.domain import Delivery
from depal.errors import DeliveryError, Problem
from depal.logistics.checking import checked_delivery
from depal.logistics.findings import Finding, place, shown
from depal.logistics.json_text import json_value

_MOST_DELIVERIES = 10_000
"""No file holds more."""

_SHORT = 60
"""Longer ids are not repeated in front of every problem."""


def deliveries_of_json(text: str, source: str) -> tuple[Delivery, ...]:
    """The deliveries of a JSON text.

    Args:
        text: one delivery or a list of them.
        source: where the text comes from, for the error.

    Returns:
        The deliveries in the order of the text, at least one.

    Raises:
        DeliveryError: with everything that is wrong with any of them.
    """
    value = json_value(text, source)
    if not isinstance(value, list):
        return (_single(value, source),)
    if not 0 < len(value) <= _MOST_DELIVERIES:
        what = f"the list has {len(value) or 'no'} deliveries"
        raise DeliveryError(source, [Problem("", what, f"1 to {_MOST_DELIVERIES} of them")])
    deliveries: list[Delivery] = []
    problems: list[Problem] = []
    first: dict[str, int] = {}
    for index, raw in enumerate(value):
        name = _name(raw)
        earlier = first.setdefault(name, index) if name is not None else index
        if earlier != index:
            finding = Finding(("id",), f"[{earlier}] has this id too", "every id once in a file")
            problems.append(_in_list(index, name, finding))
        outcome = checked_delivery(raw)
        if isinstance(outcome, Delivery):
            deliveries.append(outcome)
        else:
            problems += [_in_list(index, name, finding) for finding in outcome]
    if problems:
        raise DeliveryError(source, problems)
    return tuple(deliveries)


def _single(value: object, source: str) -> Delivery:
    if not isinstance(value, dict):
        problem = Problem("", f"{shown(value)} is no delivery", "an object, or a list of them")
        raise DeliveryError(source, [problem])
    outcome = checked_delivery(value)
    if isinstance(outcome, Delivery):
        return outcome
    raise DeliveryError(source, [finding.at(place(finding.loc)) for finding in outcome])


def _name(raw: object) -> str | None:
    """The delivery's id, where it has one that can be named in a message."""
    name = raw.get("id") if isinstance(raw, dict) else None
    return name if isinstance(name, str) and name.strip() else None


def _in_list(index: int, name: str | None, finding: Finding) -> Problem:
    if name is None or not name.isprintable() or len(name) > _SHORT:
        return finding.at(place((index, *finding.loc)))
    return finding.at(f"[{index}] {name}: {place(finding.loc)}".removesuffix(": "))
