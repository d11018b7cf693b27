"""What the faces of a pile may measure."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Self

from depal.domain import Product
from depal.geometry import Vector3
from depal.perception.faces import Facing


@dataclass(frozen=True, slots=True)
class Expected:
    """Sizes of the boxes that may be there.

    Attributes:
        sizes: length, width, height of boxes [m]; none where nobody knows.
        standing: whether they all stand upright, so that their height is upright.
    """

    sizes: tuple[Vector3, ...] = ()
    standing: bool = True

    @classmethod
    def of(cls, products: Sequence[Product]) -> Self:
        """The sizes of products, each once."""
        return cls(tuple(sorted({product.size for product in products})))

    def faces(self, facing: Facing) -> tuple[tuple[float, float], ...]:
        """Widths and heights of the faces that may look this way [m], each once."""
        found = set[tuple[float, float]]()
        for length, width, height in self.sizes:
            if not self.standing:
                edges = ((length, width), (length, height), (width, height))
                found |= {*edges, *((b, a) for a, b in edges)}
            elif facing is Facing.FRONT:
                found |= {(length, height), (width, height)}
            else:
                found |= {(length, width), (width, length)}
        return tuple(sorted(found))
