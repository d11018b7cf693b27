"""The cameras' pictures with the markers that were found in them."""

from collections.abc import Mapping

import numpy as np
import numpy.typing as npt
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Polygon

from depal.domain import CellLayout
from depal.perception.calibration import Calibration, MarkerCheck, checked
from depal.ports import Frame
from depal.studies.drawing.sheet import MARGIN, WIDTH, sheet

FOUND, HIDDEN = "#2e9e5b", "#d1663a"
"""Outlines of markers that are found, and of those that should be seen and are not."""

_HIGHEST = 5.2
_GAP = 0.15


def calibration_picture(
    layout: CellLayout,
    frames: Mapping[str, tuple[Frame, ...]],
    found: Mapping[str, Calibration],
) -> Figure:
    """Draws the first frame of each camera, the markers outlined.

    Args:
        layout: the cell.
        frames: of each camera.
        found: the calibrations.
    """
    worst = max(one.residual for one in found.values())
    shapes = {name: these[0].colour.shape[:2] for name, these in frames.items()}
    room = WIDTH - 2 * MARGIN - _GAP * (len(shapes) - 1)
    tall = min(_HIGHEST, room / sum(width / height for height, width in shapes.values()))
    drawn = sheet(
        tall,
        f"{layout.name}: markers are where the cell file has them to {1000 * worst:.1f} mm",
        "Green outlines: markers found in the first picture of each camera. Orange: markers in its "
        "view that something hides.",
        " · ".join(
            f"{name}: {one.markers} markers, depth scale {one.depth.scale:.4f}"
            for name, one in found.items()
        ),
    )
    left = MARGIN
    for name, (height, width) in shapes.items():
        across = tall * width / height
        area = (left, 0.0, across, tall)
        axes, _ = drawn.picture(area, (0.0, float(width), 0.0, float(height)))
        frame, one = frames[name][0], found[name]
        _draw(axes, frame.colour, checked(frame, layout.fiducials, one))
        left += across + _GAP
    return drawn.figure


def _draw(axes: Axes, colour: npt.NDArray[np.uint8], seen: MarkerCheck) -> None:
    """A picture with its outlines; rows count down from the axes' top."""
    height, width = colour.shape[:2]
    axes.imshow(colour, extent=(0.0, width, 0.0, height), interpolation="antialiased")
    hidden = {name: at for name, at in seen.expected.items() if name not in seen.seen}
    for outlines, ink in ((seen.seen, FOUND), (hidden, HIDDEN)):
        for pattern, corners in outlines.items():
            at = np.column_stack((corners[:, 0] + 0.5, height - corners[:, 1] - 0.5))
            axes.add_patch(Polygon(at, fill=False, edgecolor=ink, linewidth=1.4))
            x, y = at.mean(axis=0)[0], at[:, 1].max()
            axes.text(x, y + 4, str(pattern), color=ink, fontsize=8, ha="center", va="bottom")
