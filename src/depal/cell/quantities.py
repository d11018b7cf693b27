"""What tasks may limit in this cell, and the zones that they may avoid."""

from collections.abc import Collection, Mapping
from typing import Final

from depal.errors import Problem, TaskError
from depal.executive.checking import check_quantities, check_zones
from depal.executive.schema import Repository
from depal.executive.units import Quantity

SPEED, PAYLOAD, TILT, MARGIN = "speed", "payload", "tilt", "margin"

QUANTITIES: Final[Mapping[str, Quantity]] = {
    SPEED: Quantity("m/s"),
    PAYLOAD: Quantity("kg"),
    TILT: Quantity("rad"),
    MARGIN: Quantity("g", at_least=True),
}
"""The speed of flange and tool; the mass of a box that is lifted; how far a held box leans from
upright; and the margin of stability of the pile that a box leaves, which is bounded from below."""


def refuse_unknown(tasks: Repository, zones: Collection[str]) -> None:
    """Tasks may limit only what is kept, and avoid only what is there.

    Args:
        tasks: of the cell.
        zones: the names of the cell's zones.

    Raises:
        TaskError: another quantity, one from the wrong side, a unit of another one, or a zone that
            the cell does not have.
    """
    found = [*check_quantities(tasks, QUANTITIES), *check_zones(tasks, zones)]
    if found:
        raise TaskError(
            "limits", [Problem(one.where, one.what, exists=one.exists) for one in found]
        )
