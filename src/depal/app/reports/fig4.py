"""Fig. 4: Eq. (1) over the pallet."""

from depal.app.reports.report import Report, plain_table
from depal.selection import position_priority
from depal.studies.drawing import grid_centres, priority_field
from depal.studies.pallets import SIZE, X_MAX, X_NEAR

CELLS = (8, 16, 10)
"""How many cells along x, y, z: cubes of 10 cm."""


def fig4_report() -> Report:
    """The report of `depal study fig4`."""
    low, high = (X_NEAR, -SIZE[1] / 2, 0.0), (X_MAX, SIZE[1] / 2, SIZE[2])
    centres = grid_centres(low, high, CELLS)
    h = position_priority(centres, X_MAX)
    cell = tuple(side / count for side, count in zip(SIZE, CELLS, strict=True))
    table = plain_table("Fig. 4: h(b) over the pallet [m]", "where", "x", "y", "z", "h")
    for name, index in (("first", int(h.argmax())), ("last", int(h.argmin()))):
        x, y, z = centres[index]
        table.row(name, f"{x:.2f}", f"{y:.2f}", f"{z:.2f}", f"{h[index]:.3f}")
    return Report(
        fields={"x_max": X_MAX, "highest": float(h.max()), "lowest": float(h.min())},
        shown=[table],
        draw=lambda: priority_field(centres, h, (cell[0], cell[1], cell[2]), note="cells of 10 cm"),
    )
