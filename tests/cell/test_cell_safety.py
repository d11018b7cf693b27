"""Safety inputs: read, judged, told; and what a task's limits do to the arm."""

import asyncio
import math
from dataclasses import replace

import cells_at_work
import numpy as np
import pytest
from cells_at_work import PERSON, STORED, Cell
from hypothesis import given
from hypothesis import strategies as st

from depal.cell.bounds import Bounds
from depal.cell.safety import CautiousArm, Judgement, facts_under, judged, speed_under
from depal.cell.safety.judging import SPEED, STALE, SUSPENDED
from depal.cell.tasks import read_shipped_tasks
from depal.errors import DeviceError, TaskError
from depal.executive.clock import LoopClock, run_simulated
from depal.executive.language import format_repository, parse
from depal.executive.schema import Repository
from depal.motion.kinematics import Kinematics
from depal.ports import SafetyState, Trajectory
from depal.ports.fakes import FakeArm, FakeGripper, FakeOverride, FakeSafety

STATES = st.none() | st.builds(
    SafetyState,
    *[st.booleans()] * 4,
    st.none() | st.floats(0.0, 20.0),
)
NOW = 10.0


@given(STATES, st.none() | st.builds(Judgement, *[st.booleans()] * 4))
def test_nothing_may_move_unless_all_inputs_say_so_and_lately(
    state: SafetyState | None, before: Judgement | None
) -> None:
    """Absent, stale, or of a time that has not come: none of them is good."""
    fresh = state is not None and (state.read is None or 0.0 <= NOW - state.read <= STALE)
    now = judged(state, NOW, before)
    assert now.good == fresh
    if state is not None and fresh:
        assert now.may_move == (not (state.stopped or state.gate_open or state.inside))
        assert now.tripped == state.tripped
    else:
        assert not now.may_move
        assert now.tripped == (before is not None and before.tripped)
    assert (now.reason == "") == now.may_move
    assert not (now.tripped and now.suspended)


@given(STATES, st.floats(0.05, 0.3))
def test_what_is_told_is_what_is_meant(state: SafetyState | None, near: float) -> None:
    """The rule of the tasks, their limit, and the arm's pace say the same."""
    now = judged(state, NOW)
    facts = dict(facts_under(now, near))
    assert facts[SUSPENDED] == now.suspended
    speed = speed_under(now, near)
    assert (speed == 0.0) == now.suspended
    if not now.suspended:
        assert facts[SPEED] == (None if math.isinf(speed) else speed)


STILL = Trajectory(np.array([0.0, 0.2]), np.zeros((2, 6)), np.zeros((2, 6)))


def begun(safety: FakeSafety, *changes: tuple[float, str, object], reason: str = "") -> object:
    """A motion is commanded: when it begins [s], or what came of it instead."""

    async def work() -> object:
        arm, clock = FakeArm((0.0,) * 6), LoopClock()
        cautious = CautiousArm(arm, safety, clock, cells_at_work.Timekeeper(clock))
        for at, what, value in changes:
            asyncio.get_running_loop().call_later(at, setattr, safety, what, value)
        try:
            said = await cautious.follow(
                STILL, lambda: (reason or None) if clock.now() > 1.0 else None
            )
        except DeviceError as error:
            return str(error)
        return said or clock.now() - STILL.duration

    return run_simulated(work())


def test_a_motion_waits_for_whoever_is_before_the_arm() -> None:
    """It begins within a tenth of a second after they have left."""
    assert begun(FakeSafety()) == pytest.approx(0.0)
    assert begun(FakeSafety(inside=True), (3.0, "inside", False)) == pytest.approx(3.05, abs=0.06)


def test_a_motion_waits_for_inputs_that_are_silent() -> None:
    """What was heard long ago is worth nothing."""
    assert begun(FakeSafety(read=0.0), (0.3, "read", None)) == pytest.approx(0.0)
    assert begun(FakeSafety(read=-1.0), (2.0, "read", None)) == pytest.approx(2.05, abs=0.06)


def test_a_motion_that_waits_can_be_called_off() -> None:
    """By its guard: the executive's wish, or a vacuum that breaks meanwhile."""
    assert begun(FakeSafety(inside=True), reason="not wanted any more") == "not wanted any more"


@pytest.mark.parametrize("what", ["stopped", "gate_open"])
def test_a_stop_and_an_open_gate_are_errors(what: str) -> None:
    """They do not end by themselves."""
    said = begun(FakeSafety(**{what: True}))
    assert said == "the arm cannot move: a safety stop is active, or the gate is open"


# A whole cell


def limited(monkeypatch: pytest.MonkeyPatch, limit: str) -> None:
    """The shipped tasks, with another limit of store."""

    def tasks() -> Repository:
        text = format_repository(read_shipped_tasks())
        first, rest = text.split("task store(Box)")
        return parse(first + "task store(Box)" + rest.replace("limit speed cell.speed", limit, 1))

    monkeypatch.setattr(cells_at_work, "read_shipped_tasks", tasks)


def test_a_box_that_is_too_heavy_for_its_task_is_never_touched(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """A person is told why, and takes it."""
    limited(monkeypatch, "limit payload 3 kg")
    cell = Cell(2).works()
    cell.assert_whole()
    assert set(cell.fates.values()) == {PERSON}
    assert not cell.gripper.grips
    why = "it weighs 4.0 kg, and the task lets at most 3.0 kg be lifted"
    assert all(why in question.text for question in cell.person.asked)


def test_a_box_that_proves_too_heavy_is_put_back_and_not_lifted_again(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """The note says 4.0 kg, the flange feels 4.8 kg."""
    limited(monkeypatch, "limit payload 4.5 kg")
    cell = Cell(1, gripper=FakeGripper(weight=4.8)).works()
    cell.assert_whole()
    assert cell.fates == {"b1": PERSON}
    assert len(cell.gripper.grips) == 1
    assert "it weighs 4.8 kg" in cell.person.asked[0].text


def test_motions_are_planned_within_the_speed_of_their_task(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """And the override holds what was planned otherwise to it, as long as the task is at work."""
    limited(monkeypatch, "limit speed 0.2 m/s")
    cell = Cell(1).works()
    cell.assert_whole()
    override = cell.work.ports.override
    assert isinstance(override, FakeOverride)
    assert set(override.told) == {math.inf, 0.2}
    assert override.told[-1] == math.inf
    assert fastest(cell.arm.followed[1:-1]) <= 0.2 * 1.02
    usual = Cell(1)
    monkeypatch.undo()
    assert fastest(usual.works().arm.followed) > 1.0


def fastest(motions: list[Trajectory]) -> float:
    """The flange's greatest speed [m/s]."""
    kinematics = Kinematics(cells_at_work.shipped_cell("default").robot)
    speeds = [0.0]
    for motion in motions:
        times = np.arange(0.0, motion.duration, 0.005)
        points = [kinematics.frames(motion.at(time)[0])[6, :, 3] for time in times]
        if len(points) > 1:
            speeds.append(np.linalg.norm(np.diff(points, axis=0), axis=1).max() / 0.005)
    return float(max(speeds))


def test_while_somebody_stands_before_the_arm_no_work_on_it_begins() -> None:
    """The tree waits and says why; afterwards everything is stored."""
    cell, safety = Cell(2), FakeSafety(near=True, inside=True)
    cell.work.ports = replace(cell.work.ports, safety=safety)
    started_at: list[float] = []

    async def work() -> None:
        loop = asyncio.get_running_loop()
        loop.call_later(60.0, setattr, safety, "inside", False)  # noqa: FBT003 - a value
        loop.call_later(90.0, setattr, safety, "near", False)  # noqa: FBT003 - a value
        await cell._run(())  # noqa: SLF001 - the run, beside a person

    run_simulated(work())
    cell.assert_whole()
    assert set(cell.fates.values()) == {STORED}
    started_at = [e.at for e in cell.events if type(e).__name__ == "Started"]
    moves = [at for at, label in zip(started_at, cell.started, strict=True) if "kr60" in label]
    assert 60.0 <= min(moves) < 60.2
    override = cell.work.ports.override
    assert isinstance(override, FakeOverride)
    assert override.told == [0.0, 0.25, math.inf]


@pytest.mark.parametrize("limit", ["limit sped 1 m/s", "limit payload 1 m/s"])
def test_a_cell_refuses_limits_that_it_does_not_keep(
    monkeypatch: pytest.MonkeyPatch, limit: str
) -> None:
    """Before anything moves."""
    limited(monkeypatch, limit)
    with pytest.raises(TaskError, match="store"):
        Cell(1).works()


@given(st.lists(st.floats(0.01, 3.0)), st.floats(0.0, 3.0))
def test_the_override_is_told_the_tightest_bound(limits: list[float], most: float) -> None:
    """Of everything that runs on the arm, and of who is near; and each change once."""
    override = FakeOverride()
    bounds = Bounds(override)
    bounds._running = {n: lambda x=x: {"speed": x} for n, x in enumerate(limits)}  # type: ignore[misc]  # noqa: SLF001
    bounds.hold_below(most)
    bounds.hold_below(most)
    assert override.told == [min([most, *limits])]
