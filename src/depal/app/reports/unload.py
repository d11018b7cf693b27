"""Real deliveries, unloaded on geometry alone."""

from collections.abc import Sequence

from depal.app.files import Json
from depal.app.reports.report import Report, plain_table
from depal.studies.real import Unloading


def unload_report(results: Sequence[Unloading], w: float, seconds: float) -> Report:
    """The report of `depal study unload`.

    Args:
        results: one per delivery.
        w: the weight of Eq. (3).
        seconds: the wall time of the study.

    Returns:
        The report; it holds when every box was taken, and none with a box on it.
    """
    table = plain_table(
        f"Unloaded on geometry alone, w = {w}: {len(results)}",
        "delivery",
        "boxes",
        "taken",
        "taken with a box on it",
        "boxes before each request",
        "ends",
    )
    fields: list[Json] = []
    for result in results:
        table.row(
            result.delivery,
            str(result.boxes),
            str(len(result.sequence)),
            str(len(result.burdened)),
            ", ".join("never" if at is None else str(at) for at in result.served) or "-",
            "empty" if result.complete else result.outcome.value,
        )
        fields.append(
            {
                "delivery": result.delivery,
                "boxes": result.boxes,
                "taken": len(result.sequence),
                "burdened": [*result.burdened],
                "sequence": [*result.sequence],
                "requests": [
                    {
                        "gtin": request.gtin,
                        "box": request.box,
                        "priority": request.priority,
                        "boxes_before": at,
                    }
                    for request, at in zip(result.requests, result.served, strict=True)
                ],
                "cycle": [*result.cycle],
            }
        )
    return Report(
        fields={"w": w, "seconds": seconds, "deliveries": fields},
        shown=[table],
        holds=all(result.complete for result in results),
    )
