"""Recorded choices: at each step which boxes could be taken, and which one was."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

Array = npt.NDArray[np.float64]
Indices = npt.NDArray[np.intp]

PARTS = ("requests", "side", "depth", "height")
"""What a score is made of, in the order of the columns: l, |y|, x_max - x, z."""


@dataclass(frozen=True, slots=True, eq=False)
class Choice:
    """One step of one unloading.

    Attributes:
        features: (k, 4) per box that could be taken l, and |y|, x_max - x, z [m]; k >= 2.
        chosen: the row of the box that was taken.
    """

    features: Array
    chosen: int


@dataclass(frozen=True, slots=True, eq=False)
class Choices:
    """Choices of many pallets, as arrays.

    Attributes:
        features: (n, 4) the boxes of all choices, one below the other.
        starts: (m,) the row at which each choice begins.
        chosen: (m,) the row of the box that was taken.
        pallets: (m,) the number of the pallet that each choice was made at.
    """

    features: Array
    starts: Indices
    chosen: Indices
    pallets: Indices

    @classmethod
    def of(cls, pallets: Iterable[Sequence[Choice]]) -> "Choices":
        """The choices of pallets, one sequence each."""
        rows: list[Array] = []
        starts: list[int] = []
        chosen: list[int] = []
        numbers: list[int] = []
        count = 0
        for number, choices in enumerate(pallets):
            for choice in choices:
                rows.append(choice.features)
                starts.append(count)
                chosen.append(count + choice.chosen)
                numbers.append(number)
                count += len(choice.features)
        features = np.concatenate(rows) if rows else np.empty((0, len(PARTS)))
        return cls(features, *(np.array(part, np.intp) for part in (starts, chosen, numbers)))

    def __len__(self) -> int:
        """How many choices there are."""
        return len(self.starts)

    @property
    def counts(self) -> Indices:
        """(m,) how many boxes could be taken."""
        return np.diff(self.starts, append=len(self.features))

    @property
    def losses(self) -> Array:
        """(n, 4) by how much the box that was taken exceeds each; zero for itself."""
        return np.repeat(self.features[self.chosen], self.counts, axis=0) - self.features

    def seen_as(self, mix: Array) -> "Choices":
        """The same choices with mixed features.

        Args:
            mix: (columns, 4); each new feature is a sum of the old ones.
        """
        return Choices(self.features @ mix.T, self.starts, self.chosen, self.pallets)

    def kept(self, rows: npt.NDArray[np.bool_]) -> "Choices":
        """Without some of the boxes; choices with one box left are no choices.

        Args:
            rows: (n,) which boxes stay; those that were taken always do.
        """
        left = np.add.reduceat(rows, self.starts, dtype=np.intp) if len(self) else self.starts
        lasting = left > 1
        rows = rows & np.repeat(lasting, self.counts)
        place = np.cumsum(rows) - 1
        ends = np.cumsum(left[lasting])
        return Choices(
            self.features[rows],
            ends - left[lasting],
            place[self.chosen[lasting]],
            self.pallets[lasting],
        )

    def at(self, pallets: Iterable[int]) -> "Choices":
        """The choices of some pallets; one that is named twice counts twice, as two."""
        where: dict[int, list[int]] = {}
        for choice, pallet in enumerate(self.pallets.tolist()):
            where.setdefault(pallet, []).append(choice)
        ends = self.starts + self.counts
        return Choices.of(
            [
                Choice(
                    self.features[self.starts[c] : ends[c]], int(self.chosen[c] - self.starts[c])
                )
                for c in where.get(pallet, [])
            ]
            for pallet in pallets
        )
