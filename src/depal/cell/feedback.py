"""What the work tells the sight: boxes are not always what they look like."""

from collections.abc import Callable
from dataclasses import dataclass

from depal.domain import BoxId, Product
from depal.geometry import OrientedBox


def nothing_learned(_box: BoxId, _product: Product) -> None:
    """A sight that keeps no pictures."""


def nothing_doubted() -> None:
    """A sight that relies on nothing."""


def nothing_denied(_box: BoxId) -> None:
    """A sight that makes nothing up."""


def nothing_parted(_span: OrientedBox) -> None:
    """A sight that takes no two boxes for one."""


@dataclass(frozen=True, slots=True)
class Feedback:
    """Who is told what the work has found out.

    Attributes:
        learn: the product of a box that was shown to the reader.
        doubt: the next look must not rely on those before.
        deny: a box is none.
        part: no one box reaches over all of a flat place, in the cell frame.
    """

    learn: Callable[[BoxId, Product], None] = nothing_learned
    doubt: Callable[[], None] = nothing_doubted
    deny: Callable[[BoxId], None] = nothing_denied
    part: Callable[[OrientedBox], None] = nothing_parted
