"""A record is replayed: its states, its decisions, and what a damaged one says."""

import asyncio
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st
from test_engine_laws import REPOSITORIES, Driver
from worlds import STORE, World, runtime_of, store_all

from depal.errors import JournalError
from depal.executive import events as ev
from depal.executive.clock import run_simulated
from depal.executive.language import parse
from depal.executive.record import Recording, open_record
from depal.executive.snapshot import freeze


@pytest.fixture(name="folder")
def _folder(tmp_path: Path) -> Path:
    """A record of two stores, with failures."""
    folder = tmp_path / "record"
    world = World(fail=0.2, seed=4)

    async def work() -> None:
        with open_record(folder, STORE) as journal:
            runtime = runtime_of(world, journal)
            await asyncio.wait_for(store_all(runtime, ["b1", "b2"]), 1e6)

    run_simulated(work())
    return folder


def test_a_record_holds_the_tasks_and_every_event(folder: Path) -> None:
    """And goes back to any moment."""
    recording = Recording.read(folder)
    assert recording.repository == STORE
    assert recording.state_at(0).trees == {}
    first = recording.state_at(3)
    assert list(first.trees) == [1, 2]
    last = recording.state_at(len(recording.events))
    assert last.trees == {}
    assert last.facts["b1.stored"] is last.facts["b2.stored"] is True


def test_a_recorded_run_is_decided_again_as_it_was(folder: Path) -> None:
    """Decision by decision."""
    assert list(Recording.read(folder).deviations()) == []


@given(st.sampled_from(["store", "pack"]), st.integers(0, 2**32 - 1))
def test_any_run_is_decided_again_as_it_was(name: str, seed: int) -> None:
    """Random runs of random tasks."""
    driver = Driver(REPOSITORIES[name], seed)
    for _ in driver.steps(40):
        pass
    recording = Recording(REPOSITORIES[name], tuple(driver.events))
    assert list(recording.deviations()) == []
    assert freeze(recording.state_at(len(driver.events))) == freeze(driver.engine.state)


def test_a_decision_that_was_not_the_engines_is_noticed(folder: Path) -> None:
    """By the number of its event."""
    recording = Recording.read(folder)
    position = next(i for i, e in enumerate(recording.events) if isinstance(e, ev.Started))
    started = recording.events[position]
    assert isinstance(started, ev.Started)
    forged = ev.Started(started.at, started.attempt, 2, started.node)
    events = (*recording.events[:position], forged, *recording.events[position + 1 :])
    assert list(Recording(STORE, events).deviations()) == [position + 1]


def test_what_is_no_record_is_said_to_be_none(folder: Path, tmp_path: Path) -> None:
    """With what is there instead."""
    (tmp_path / "empty").mkdir()
    with pytest.raises(JournalError, match=r"no record here; expected tasks.task in it; there is"):
        Recording.read(tmp_path / "empty")
    with pytest.raises(JournalError, match="no such folder"):
        Recording.read(tmp_path / "nowhere")
    with pytest.raises(JournalError, match=r"there is no event 9999; the record has 1 \.\."):
        Recording.read(folder).state_at(9999)


def test_a_record_is_not_gone_on_with_under_other_tasks(folder: Path) -> None:
    """The digest of the task file says so."""
    other = parse("fact lamp.on : flag\naction press() until lamp.on sets lamp.on\n", "other")
    with pytest.raises(JournalError, match="was made with other tasks"):
        open_record(folder, other)
    with open_record(folder, STORE) as journal:
        assert journal.last > 0
