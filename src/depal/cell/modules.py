"""Which suction modules work: one that gives no vacuum at box after box is used last."""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field

from depal.domain import BoxId

SILENT = 1.0
"""With less vacuum than this a module gives none [Pa]."""

BESIDE = BoxId("beside its neighbour")
"""Stands for the box at which another module has sealed."""

TRIES = 2
"""After so many tries at a box its next one is without the modules that were silent."""

BOXES = 2
"""A module is dead that gave no vacuum at so many boxes in a row."""


@dataclass(slots=True)
class Modules:
    """What is known of the modules.

    Attributes:
        silent: boxes in a row at which a module gave no vacuum, by its name.
    """

    silent: dict[str, set[BoxId]] = field(default_factory=dict)

    def tried(self, box: BoxId, used: Iterable[str], vacuum: Mapping[str, float]) -> None:
        """Suction was on at a box, wherever a face was felt for.

        Args:
            box: which.
            used: the modules whose valves were open.
            vacuum: what each sensor reads [Pa].
        """
        names = set(used)
        felt = any(vacuum.get(name, 0.0) > SILENT for name in names)
        for name in names:
            if vacuum.get(name, 0.0) > SILENT:
                self.silent.pop(name, None)
            else:
                self.silent.setdefault(name, set()).add(box)
        if felt:  # another module seals on the same box: nothing else can be wrong
            for name, boxes in self.silent.items():
                if box in boxes:
                    self.silent[name] = boxes | {BESIDE}

    @property
    def dead(self) -> frozenset[str]:
        """The modules that are not used any more."""
        return frozenset(name for name, boxes in self.silent.items() if len(boxes) >= BOXES)

    def suspects(self, box: BoxId, tries: int) -> frozenset[str]:
        """Modules that have been silent at a box for too often: another one may tell why.

        Args:
            box: which.
            tries: how often it was tried in vain.
        """
        if tries < TRIES:
            return frozenset()
        return frozenset(name for name, boxes in self.silent.items() if box in boxes)
