"""The parts of a delivery that can be judged although others cannot."""

from collections.abc import Iterable
from dataclasses import dataclass

from depal.domain import STACK_TOLERANCE
from depal.geometry import Vector3
from depal.logistics.findings import Finding

TOLERANCE = STACK_TOLERANCE
"""Sizes and places that differ by no more are the same [m]."""

ROUNDING = 1e-9
"""What binary floating point may add to the tolerance [m]."""


@dataclass(frozen=True, slots=True)
class NotePart:
    """What is sound of one line of the note; None for the rest.

    Attributes:
        index: the line's index in the note.
        gtin: its product.
        size: length, width, height of a case [m].
        count: the number of cases.
    """

    index: int
    gtin: str | None
    size: Vector3 | None
    count: int | None


@dataclass(frozen=True, slots=True)
class StackPart:
    """What is sound of one stacked case; None for the rest.

    Attributes:
        index: the case's index in the stack.
        gtin: its product.
        corner: its corner with the smallest coordinates, in the pallet's frame [m].
        size: its edges along x, y, z of the pallet's frame [m].
    """

    index: int
    gtin: str | None
    corner: Vector3 | None
    size: Vector3 | None


class SoundParts:
    """A raw delivery without the places that are already known to be wrong."""

    def __init__(self, raw: object, findings: Iterable[Finding]) -> None:
        """Remembers what is wrong.

        Args:
            raw: the delivery as the file has it.
            findings: everything that its shape has wrong.
        """
        self._raw = raw
        self._wrong = {finding.loc for finding in findings}
        self._touched = {loc[:end] for loc in self._wrong for end in range(len(loc) + 1)}

    @property
    def pallet_size(self) -> Vector3 | None:
        """Length, width and deck height of the pallet [m]."""
        return self._vector("pallet", "size")

    @property
    def note(self) -> list[NotePart] | None:
        """The lines of the note; None where there is no list of them."""
        lines = self._value("lines")
        if not isinstance(lines, list):
            return None
        return [
            NotePart(
                index,
                self._text("lines", index, "gtin"),
                self._vector("lines", index, "size"),
                self._whole("lines", index, "count"),
            )
            for index in range(len(lines))
        ]

    @property
    def stack(self) -> list[StackPart] | None:
        """The stacked cases; None where there is no list of them."""
        cases = self._value("stack")
        if not isinstance(cases, list):
            return None
        return [
            StackPart(
                index,
                self._text("stack", index, "gtin"),
                self._vector("stack", index, "corner"),
                self._vector("stack", index, "size"),
            )
            for index in range(len(cases))
        ]

    def _text(self, *loc: str | int) -> str | None:
        value = self._value(*loc)
        return value if isinstance(value, str) else None

    def _whole(self, *loc: str | int) -> int | None:
        value = self._value(*loc)
        return value if isinstance(value, int) else None

    def _vector(self, *loc: str | int) -> Vector3 | None:
        value = None if loc in self._touched else self._value(*loc)
        if not isinstance(value, list):
            return None
        return (float(value[0]), float(value[1]), float(value[2]))

    def _value(self, *loc: str | int) -> object:
        """The value at a place; None where the place, or what holds it, is wrong."""
        if any(loc[:depth] in self._wrong for depth in range(len(loc) + 1)):
            return None
        value = self._raw
        for step in loc:
            if isinstance(value, dict):
                value = value.get(step)
            elif isinstance(value, list):
                value = value[int(step)]
        return value
