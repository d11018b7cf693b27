"""Zones in the pictures of a cell: hatched from above, as lines in space."""

from dataclasses import replace

import numpy as np
from matplotlib.figure import Figure

from depal.app.cell.plan import draw_plan
from depal.app.cell.space import draw_space
from depal.cell.files import shipped_cell
from depal.domain import Zone
from depal.geometry import OrientedBox, Pose

BARE = shipped_cell()
AISLE = Zone("aisle", OrientedBox(Pose.from_yaw((1.1, 0.65, 1.2), 0.3), (0.6, 0.1, 2.4)))
ZONED = replace(BARE, zones=(AISLE,))


def test_a_zone_is_hatched_from_above_with_its_name() -> None:
    """Where it is: the picture's right is -y, up is x."""
    axes = Figure().subplots()
    draw_plan(axes, BARE, 1.0, {})
    assert not [patch for patch in axes.patches if patch.get_hatch()]
    axes = Figure().subplots()
    draw_plan(axes, ZONED, 1.0, {})
    (patch,) = [patch for patch in axes.patches if patch.get_hatch()]
    corners = np.unique(np.round(np.array(patch.get_path().vertices, float), 6), axis=0)
    wanted = np.unique(np.round([(-y, x) for x, y, _ in AISLE.solid.corners], 6), axis=0)
    assert np.allclose(corners, wanted)
    assert "zone aisle" in [text.get_text() for text in axes.texts]


def test_a_zone_has_its_twelve_edges_in_space() -> None:
    """And hides nothing."""
    lines = []
    for layout in (BARE, ZONED):
        axes = Figure().subplots()
        draw_space(axes, layout, (120, 90), {})
        lines.append(len(axes.lines))
    assert lines[1] - lines[0] == 12
