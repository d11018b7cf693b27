"""People come near while a pallet is emptied; the referee measures the tool."""

import asyncio
from dataclasses import dataclass, field, replace
from pathlib import Path

import numpy as np
import pytest
from tiny_runs import THREE, tiny

from depal.app.faults.verdicts import broken_in
from depal.app.run.job import run_job, seeing_of
from depal.app.run.summary import Outcome
from depal.app.run.values import Job
from depal.cell.files import shipped_cell
from depal.cell.safety.judging import SUSPENDED
from depal.cell.workplace import Settings
from depal.executive import events as ev
from depal.executive.clock import Clock
from depal.executive.record import Recording
from depal.executive.schema import Cancel
from depal.ports import Sight
from depal.simulation.cell import SimulatedCell
from depal.simulation.devices.safety import Visit
from depal.simulation.faults import Injection
from depal.simulation.truth_sight import SightSettings

LAYOUT = shipped_cell("default")
PERIOD = 0.01
REACTION = 0.8
"""Inputs are read every 0.1 s, and the arm slows down within its accelerations [s]."""


@dataclass
class Onlooker:
    """Stands beside the world with a stopwatch: where the tool is, and who is near."""

    visits: tuple[Visit, ...]
    at: list[float] = field(default_factory=list)
    tips: list[list[tuple[float, float, float]]] = field(default_factory=list)
    cell: SimulatedCell | None = None
    watching: asyncio.Task[None] | None = None

    def seeing(self, job: Job, cell: SimulatedCell, clock: Clock, faults: Injection) -> Sight:
        """What the cell sees with; and the visitors are on their way."""
        self.cell = cell
        cell.safety.visits.extend(self.visits)
        self.watching = asyncio.get_running_loop().create_task(self.watch(cell, clock))
        return seeing_of(job, cell, clock, faults)

    async def watch(self, cell: SimulatedCell, clock: Clock) -> None:
        """From the world's own bodies."""
        world, tool = cell.world, LAYOUT.tool
        while True:
            world.advance(clock.now())
            folded, flange = world.suction.folded, world.flange()
            faces = [
                tool.module(each.name, folded=folded).flange_from_face for each in tool.modules
            ]
            points = [flange.translation, *((flange @ face).translation for face in faces)]
            self.at.append(world.now)
            self.tips.append(points)
            await asyncio.sleep(PERIOD)

    def speeds(self, *, inside: bool) -> np.ndarray:
        """The tool's speeds with somebody in a field, once the arm has had time to react [m/s]."""
        at, tips = np.array(self.at), np.array(self.tips)
        steps = np.diff(at)
        ways = np.linalg.norm(np.diff(tips, axis=0), axis=2)
        ways = np.where(ways < 0.05, ways, 0.0).max(axis=1)  # a hinge that folds is no motion
        there = np.zeros(len(steps), bool)
        for visit in self.visits:
            third = visit.lasts / 3
            first = visit.came + (third if inside else 0.0) + REACTION
            last = visit.came + (2 * third if inside else visit.lasts)
            there |= (at[:-1] >= first) & (at[1:] <= last)
        there &= steps > 0.5 * PERIOD
        return ways[there] / steps[there]


def visited(seed: int, record: Path, *, inside: bool = True) -> tuple[Outcome, Onlooker]:
    """Three boxes; every few seconds somebody comes, and a run meets them in all its phases."""
    visits = tuple(Visit(1.0 + 0.7 * seed + 9.3 * n, 6.0, inside) for n in range(200))
    onlooker = Onlooker(visits)
    sight = SightSettings(sigma=0.001, unrecognised=0.4)
    job = Job(LAYOUT, tiny(*THREE), (), Settings(), seed, sight)
    outcome = run_job(replace(job, horizon=2000.0), record=record, seeing=onlooker.seeing)
    return outcome, onlooker


@pytest.mark.slow
@pytest.mark.parametrize("seed", [0])
def test_with_somebody_near_the_arm_is_slow_and_in_the_field_nothing_moves(
    seed: int, tmp_path: Path
) -> None:
    """By the referee; and everything is stored without a question."""
    outcome, onlooker = visited(seed, tmp_path)
    assert outcome.stored == len(THREE)
    assert not outcome.questions
    assert list(broken_in(outcome)) == []
    near, inside = onlooker.speeds(inside=False), onlooker.speeds(inside=True)
    assert len(near) > 500
    assert near.max() <= LAYOUT.speeds.near
    assert inside.max() < 0.005
    assert_the_rule_holds(Recording.read(tmp_path))


def assert_the_rule_holds(recording: Recording) -> None:
    """Nothing on the arm starts while nothing may move, and what may be asked to stop is asked."""
    suspended, asked = False, 0
    state = recording.state_at(0)
    for event in recording.events:
        if isinstance(event, ev.Changed):
            suspended = dict(event.facts).get(SUSPENDED, suspended) is True
        state.apply(event)
        if isinstance(event, ev.Started):
            action = state.attempts[event.attempt].node.action
            assert not (suspended and action.uses and action.uses[0] == "kr60"), action.name
        if isinstance(event, ev.CancelAsked):
            assert state.attempts[event.attempt].node.action.cancel is not Cancel.NEVER
            asked += 1
    assert asked, "nobody was ever asked to stop: these visits have met no motion"
