"""Fig. 5: the graph G over a group of boxes, and T of the requested one."""

from depal.app.reports.report import Report, plain_table
from depal.studies.drawing import SeenBox, blocking_graph
from depal.studies.fig5 import PRIORITY, REQUESTED, WEIGHT, fig5


def fig5_report() -> Report:
    """The report of `depal study fig5`."""
    group = fig5()
    names = [box.id for box in group.boxes]
    table = plain_table(
        f"Fig. 5: {REQUESTED} is requested; p = {PRIORITY}, w = {WEIGHT}",
        "box",
        "blocked by",
        "h",
        "l",
        "s before",
        "s after",
    )
    for verdict in sorted(group.verdicts, key=lambda verdict: names.index(verdict.box.id)):
        table.row(
            verdict.box.id,
            ", ".join(sorted(blocker.box for blocker in verdict.blockers)) or "-",
            f"{verdict.h:.3f}",
            f"{verdict.l:.2f}",
            f"{(1 - WEIGHT) * verdict.h:.3f}",
            f"{verdict.s:.3f}",
        )
    scores = {verdict.box.id: verdict for verdict in group.verdicts}
    seen = [
        SeenBox(
            box.id,
            box.shape.centre,
            box.shape.size,
            (1 - WEIGHT) * scores[box.id].h,
            scores[box.id].s,
        )
        for box in group.boxes
    ]
    edges = [
        (names.index(verdict.box.id), names.index(blocker.box))
        for verdict in group.verdicts
        for blocker in verdict.blockers
    ]
    return Report(
        fields={
            "requested": REQUESTED,
            "reachable": [*sorted(group.reachable)],
            "edges": [[names[b1], names[b2]] for b1, b2 in sorted(edges)],
        },
        shown=[table],
        draw=lambda: blocking_graph(
            seen,
            edges,
            names.index(REQUESTED),
            [names.index(name) for name in group.reachable],
            note=f"p = {PRIORITY}, w = {WEIGHT}",
        ),
    )
