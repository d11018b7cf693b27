"""One picture of a cell: from above, and in perspective."""

from matplotlib.figure import Figure

from depal.app.cell.plan import draw_plan
from depal.app.cell.space import draw_space
from depal.cell.checking import CellReport
from depal.domain import CellLayout
from depal.studies.drawing.sheet import MARGIN, WIDTH, Area, sheet

_HEIGHT = 4.7
_DOTS = 200
_PLAN: Area = (MARGIN - 0.1, 0.0, 4.5, _HEIGHT)
_SPACE: Area = (MARGIN + 4.55, 0.0, WIDTH - 2 * MARGIN - 4.45, _HEIGHT)
_RIM = 0.06


def cell_picture(layout: CellLayout, checked: CellReport) -> Figure:
    """Draws a cell and what of it is reached.

    Args:
        layout: the cell.
        checked: what it can do.
    """
    shares = [round(100 * reach.usual) for reach in checked.pallet]
    least, most = min(shares), max(shares)
    reached = f"{most} %" if least == most else f"{least} to {most} %"
    seen = checked.sights[-1].seen
    zones = "; hatched, and in red lines: zones that tasks may avoid" if layout.zones else ""
    drawn = sheet(
        _HEIGHT,
        f"{layout.name}: {reached} of the load reached, {100 * seen:.0f} % of its front seen",
        "Left from above, right in space, the arm parked. Green places are reached, red ones are "
        f"not; the dashed block is the room for the load, 1.75 m high{zones}.",
        f"{layout.robot.name} · {len(layout.places)} places · shares: mean over "
        f"{', '.join(load.name for load in checked.sizes)} box of what the better grasp reaches",
    )
    (x_low, y_low), (x_high, y_high) = layout.floor
    window = (-y_high - _RIM, -y_low + _RIM, x_low - _RIM, x_high + _RIM)
    plan, scale = drawn.picture(_PLAN, window)
    draw_plan(plan, layout, scale, checked.reached)
    pixels = (round(_SPACE[2] * _DOTS), round(_SPACE[3] * _DOTS))
    space, _ = drawn.picture(_SPACE, (0.0, float(pixels[0]), 0.0, float(pixels[1])))
    draw_space(space, layout, pixels, checked.reached)
    return drawn.figure
