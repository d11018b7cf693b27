"""How full places become before they are declared full, without arm and physics."""

from depal.cell.files import shipped_cell
from depal.logistics import shipped_deliveries
from depal.logistics.placing import arrivals, measure_fill
from depal.logistics.store import by_storage
from depal.studies.bench.figure import Figure
from depal.studies.real import unload_delivery

CELL = "small_trolleys"
"""Its trolleys must be exchanged."""


def placing_figures(w: float = 0.5) -> list[Figure]:
    """The shipped deliveries, in the order of Algorithm 1, into small trolleys.

    Args:
        w: the weight of Eq. (3).
    """
    layout = shipped_cell(CELL)
    places = by_storage(layout.places, without=layout.aside)
    filling = measure_fill(
        [
            arrivals(delivery, unload_delivery(delivery, (), w).sequence)
            for delivery in shipped_deliveries()
        ],
        places,
    )
    full = len(filling.fills)
    return [
        Figure(
            "small trolleys declared full, by volume, mean",
            100 * filling.mean,
            "%",
            50.0,
            "higher",
            full,
        ),
        Figure(
            "boxes that no empty small trolley takes",
            float(filling.refused),
            "",
            0.0,
            "lower",
            filling.stored + filling.refused,
        ),
    ]
