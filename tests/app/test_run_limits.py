"""Limits of tasks in physics: the referee measures how far boxes lean, and what is in a zone."""

import asyncio
import math
from dataclasses import dataclass, field, replace

import numpy as np
import pytest
from tiny_runs import THREE, tiny

from depal.app.run.job import run_job, seeing_of
from depal.app.run.summary import Outcome
from depal.app.run.values import Job
from depal.cell.files import shipped_cell
from depal.cell.tasks import read_shipped_tasks
from depal.cell.workplace import Settings
from depal.domain import Zone
from depal.executive.clock import Clock
from depal.executive.language import format_repository, parse
from depal.executive.schema import Repository
from depal.geometry import OrientedBox, Pose
from depal.motion.collision import Body, Checker, Hand, Margins, Scene
from depal.ports import Sight
from depal.simulation.cell import SimulatedCell
from depal.simulation.faults import Injection
from depal.simulation.truth_sight import SightSettings

LAYOUT = shipped_cell("default")
PERIOD = 0.02

COMPLIANCE = 1.0
"""Servos lag, and a box gives on its cups: it may lean so much more than was planned [deg]."""

WALL = Zone("wall", OrientedBox(Pose((1.1, 0.6, 1.1)), (0.7, 0.1, 2.2)))
"""Between the pallet and the trolleys on the left."""


def tasks_with(clauses: str) -> Repository:
    """The shipped tasks; whatever moves a box is bound by some clauses more."""
    text = format_repository(read_shipped_tasks())
    return parse(text.replace("limit speed cell.speed", f"limit speed cell.speed{clauses}"))


@dataclass
class Onlooker:
    """Stands beside the world and looks at it again and again.

    Attributes:
        leans: how far the box that leans most does, look by look [deg].
        entered: how often arm or tool were in the zone.
    """

    leans: list[float] = field(default_factory=list)
    entered: int = 0
    watching: asyncio.Task[None] | None = None

    def seeing(self, job: Job, cell: SimulatedCell, clock: Clock, faults: Injection) -> Sight:
        """What the cell sees with."""
        self.watching = asyncio.get_running_loop().create_task(self.watch(cell, clock))
        return seeing_of(job, cell, clock, faults)

    async def watch(self, cell: SimulatedCell, clock: Clock) -> None:
        """From the world's own bodies and joints."""
        world, body = cell.world, Body.of(LAYOUT)
        scene, bare = Scene.of([], []).with_zones([WALL]), Margins(0.0, 0.0, 0.0, 0.0, 0.0)
        while True:
            world.advance(clock.now())
            rise = [world.box(index).rotation[2][2] for index in range(len(THREE))]
            self.leans.append(math.degrees(math.acos(min(1.0, *rise))))
            hand = Hand.of(LAYOUT.tool, folded=world.suction.folded)
            checker = Checker(body, hand, scene, bare)
            self.entered += not checker.free(np.array(world.joints()))
            await asyncio.sleep(PERIOD)


def limited(clauses: str, zones: tuple[Zone, ...] = ()) -> tuple[Outcome, Onlooker]:
    """Three boxes that the camera does not know: each is turned before the reader."""
    onlooker = Onlooker()
    sight = SightSettings(sigma=0.001, unrecognised=1.0)
    job = Job(replace(LAYOUT, zones=zones), tiny(*THREE), (), Settings(), 0, sight)
    job = replace(job, tasks=tasks_with(clauses))
    return run_job(job, seeing=onlooker.seeing), onlooker


@pytest.mark.slow
def test_boxes_lean_no_further_than_their_tasks_allow() -> None:
    """With the shipped tasks they lean further."""
    outcome, onlooker = limited(", tilt 5 deg")
    assert outcome.stored == len(THREE)
    assert max(onlooker.leans) <= 5.0 + COMPLIANCE
    assert max(limited("")[1].leans) > 10.0


@pytest.mark.slow
def test_arm_and_tool_keep_out_of_a_zone() -> None:
    """With the shipped tasks they pass through."""
    outcome, onlooker = limited(" avoids wall", (WALL,))
    assert outcome.stored == len(THREE)
    assert not onlooker.entered
    assert limited("", (WALL,))[1].entered
