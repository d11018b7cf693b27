"""What the study runs: one fault, or a pair of them, with a seed; written as G3:7 or G3+M7:7."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from depal.errors import SettingError, did_you_mean
from depal.simulation.faults import CATALOGUE

AND, AT = "+", ":"


@dataclass(frozen=True, slots=True)
class Piece:
    """One run.

    Attributes:
        ids: the faults that are to strike.
        seed: of the run.
    """

    ids: tuple[str, ...]
    seed: int

    @property
    def name(self) -> str:
        """The faults in a word."""
        return AND.join(self.ids)

    def __str__(self) -> str:
        """As `--replay` takes it."""
        return f"{self.name}{AT}{self.seed}"

    @classmethod
    def of(cls, text: str) -> "Piece":
        """Reads what `str` has written.

        Raises:
            SettingError: it is no such text, or names no fault of the catalogue.
        """
        names, _, seed = text.partition(AT)
        if not seed.isdecimal():
            expected = f"FAULT{AT}SEED or FAULT{AND}FAULT{AT}SEED, such as G3{AND}M7{AT}12"
            raise SettingError("--replay", f"{text!r} names no run", expected)
        return cls(known(names.split(AND), "--replay"), int(seed))


def known(names: Sequence[str], option: str) -> tuple[str, ...]:
    """The names, each of which is in the catalogue.

    Raises:
        SettingError: one is not.
    """
    stripped = [name.strip() for name in names if name.strip()]
    for name in stripped:
        if name not in CATALOGUE:
            exists = did_you_mean(name, CATALOGUE)
            raise SettingError(option, f"unknown fault {name!r}", exists=exists)
    return tuple(stripped)


def pairs_of(ids: Sequence[str], count: int, seed: int) -> list[Piece]:
    """So many random pairs of different faults, each with a seed of its own."""
    random = np.random.default_rng([seed, 21])
    found = []
    for number in range(count):
        one, other = random.choice(len(ids), size=2, replace=False).tolist()
        found.append(Piece((ids[one], ids[other]), seed + number))
    return found
