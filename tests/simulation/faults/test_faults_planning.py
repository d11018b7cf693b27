"""A planner that gives up does so whatever a task allows."""

import math

import numpy as np
import pytest

from depal.cell.files import shipped_cell
from depal.geometry import OrientedBox
from depal.motion.collision import Scene, fixed_solids
from depal.motion.grasping import grasps
from depal.motion.moves import NoMotion, Pick
from depal.motion.planning.free import Effort
from depal.simulation.faults import FaultPlan
from depal.simulation.faults.chances import Chances
from depal.simulation.faults.planning import AGAIN, GAVE_UP, FaultyMover

CELL = shipped_cell("default")
BOX = OrientedBox.upright((1.55, 0.0, 0.144 + 0.11), (0.25, 0.28, 0.22))


@pytest.mark.parametrize("limits", [(math.inf,), (0.05,), (math.inf, 0.05, 0.1, 0.05)])
def test_a_planner_gives_up_so_often_whatever_the_tilt(limits: tuple[float, ...]) -> None:
    """Movers for other limits share its trouble, so none forgets it and none begins anew."""
    mover = FaultyMover(CELL, Chances(FaultPlan.of("M4"), 0, lambda: 0.0))
    scene = Scene.of(fixed_solids(CELL), [("b", BOX)])
    ways = grasps(BOX, 4.0, CELL.tool, (-1.0, 0.0, 0.0))
    found: list[Pick | NoMotion] = []
    for number in range(AGAIN + 2):
        one = mover.leaning(limits[number % len(limits)])
        start = np.array(CELL.robot.parked)
        found.append(one.pick(start, BOX, ways, scene, "b", Effort()))
    assert found[:AGAIN] == [NoMotion((GAVE_UP,))] * AGAIN
    assert all(isinstance(each, Pick) for each in found[AGAIN:])
