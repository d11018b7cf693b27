"""From a raw value to a delivery, or to everything that is wrong with it."""

import functools
from collections.abc import Iterator

from pydantic import ValidationError

from depal.domain import Delivery
from depal.logistics.expectations import Expectations
from depal.logistics.findings import Finding
from depal.logistics.json_text import repeated_keys
from depal.logistics.models import DeliveryEntry
from depal.logistics.note import (
    counts_that_differ,
    products_not_on_the_note,
    products_on_two_lines,
    sizes_that_are_no_turn,
)
from depal.logistics.parts import SoundParts
from depal.logistics.sentences import findings_of
from depal.logistics.stack import (
    cases_beyond_the_pallet,
    cases_that_float,
    cases_that_overlap,
)


def checked_delivery(raw: object) -> Delivery | list[Finding]:
    """One delivery from what a file has for it.

    The shape comes first: types, limits, keys. What is sound of it is then checked for
    contradictions, so that one mistake does not hide another.

    Args:
        raw: the value in the file.

    Returns:
        The delivery; or everything that is wrong, in the order of the format.
    """
    findings = list(repeated_keys(raw))
    entry = None
    try:
        entry = DeliveryEntry.model_validate(raw)
    except ValidationError as error:
        findings += findings_of(error, _expectations())
    findings += _contradictions(SoundParts(raw, findings))
    if entry is None or findings:
        order = _expectations().order
        return sorted(findings, key=lambda finding: order(finding.loc))
    return entry.as_delivery()


@functools.cache
def _expectations() -> Expectations:
    return Expectations(DeliveryEntry.model_json_schema())


def _contradictions(parts: SoundParts) -> Iterator[Finding]:
    note, stack, pallet_size = parts.note, parts.stack, parts.pallet_size
    if note is not None:
        yield from products_on_two_lines(note)
    if note is not None and stack is not None:
        yield from counts_that_differ(note, stack)
        yield from products_not_on_the_note(note, stack)
        yield from sizes_that_are_no_turn(note, stack)
    if stack is not None:
        if pallet_size is not None:
            yield from cases_beyond_the_pallet(stack, pallet_size)
        yield from cases_that_overlap(stack)
        yield from cases_that_float(stack)
