"""Time at a pace: the machine's monotonic clock, faster or slower, the same in every loop."""

import asyncio
import time

import pytest
from hypothesis import given
from hypothesis import strategies as st

from depal.executive.clock import LoopClock, Pace, PacedLoop, run_paced

rates = st.floats(0.01, 1000.0)


@given(rate=rates, start=st.floats(0.0, 1e6))
def test_the_time_begins_at_its_start_and_rises_at_its_rate(rate: float, start: float) -> None:
    """Between two readings of the machine's clock."""
    pace = Pace.from_now(rate, start)
    before = time.monotonic()
    now = pace.now()
    after = time.monotonic()
    slack = 1e-6 * max(start, 1.0)
    assert start + (before - pace.origin) * rate - slack <= now
    assert now <= start + (after - pace.origin) * rate + slack


@given(rate=rates, start=st.floats(0.0, 1e6))
def test_whoever_knows_the_pace_has_the_same_time(rate: float, start: float) -> None:
    """Another loop, another process: a controller that is started anew finds time risen."""
    pace = Pace.from_now(rate, start)
    one = run_paced(told(), pace)
    between = pace.now()
    other = run_paced(told(), Pace(pace.rate, pace.start, pace.origin))
    assert start <= one <= between <= other


async def told() -> float:
    """The loop's time."""
    return LoopClock().now()


@pytest.mark.parametrize("rate", [0.5, 1.0, 50.0, 1000.0])
def test_whoever_sleeps_wakes_no_earlier_and_the_machine_has_waited_its_share(rate: float) -> None:
    """20 ms of the machine's time, whatever they are called."""

    async def sleep() -> tuple[float, float]:
        loop = asyncio.get_running_loop()
        before, began = loop.time(), time.monotonic()
        await asyncio.sleep(0.02 * rate)
        return loop.time() - before, time.monotonic() - began

    paced, real = run_paced(sleep(), Pace.from_now(rate))
    assert paced >= 0.02 * rate * (1 - 1e-6)
    assert real >= 0.02 * (1 - 1e-6)


def test_who_is_to_wake_first_wakes_first() -> None:
    """At a pace at which all of it is over at once."""

    async def work() -> list[int]:
        woken: list[int] = []
        loop = asyncio.get_running_loop()
        for k in (3, 1, 2):
            loop.call_later(float(k), woken.append, k)
        await asyncio.sleep(4.0)
        return woken

    assert run_paced(work(), Pace.from_now(1000.0)) == [1, 2, 3]


def test_what_the_world_outside_does_is_not_waited_for_at_a_pace() -> None:
    """With nothing scheduled a loop waits for its sockets; what comes, comes at once."""
    pace = Pace.from_now(1e-3)  # a second of this loop takes a quarter of an hour

    async def work() -> bool:
        loop = asyncio.get_running_loop()
        assert isinstance(loop, PacedLoop)
        return await loop.run_in_executor(None, lambda: True)

    began = time.monotonic()
    assert run_paced(work(), pace)
    assert time.monotonic() - began < 5.0


def test_an_error_of_the_work_is_the_error_of_the_run() -> None:
    """As `asyncio.run` has it."""

    async def work() -> None:
        raise ValueError("mine")

    with pytest.raises(ValueError, match="mine"):
        run_paced(work(), Pace.from_now(10.0))
