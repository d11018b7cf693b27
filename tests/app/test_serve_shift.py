"""A shift that does not go well: nobody waits for ever, and nothing is forgotten."""

import asyncio
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import pytest
from served_runs import Notes, WorldHere
from tiny_runs import THREE, tiny

from depal.app.serve.means import Means
from depal.app.serve.pictures import Picture
from depal.app.serve.seeing import Seen
from depal.app.serve.session import Session, Stage, Surroundings
from depal.app.serve.shift import Shift
from depal.cell.bookkeeping import GO_ON, HOPELESS
from depal.cell.departures import Departure, Fate
from depal.cell.files import shipped_cell
from depal.cell.ledger import Found, KeptBox, Ledger, LeftBox, Page
from depal.cell.tasks import read_shipped_tasks
from depal.domain import Approach, BoxId
from depal.errors import DepalError, DeviceError, JournalError
from depal.executive.clock import LoopClock, run_simulated
from depal.executive.journal import SqliteJournal
from depal.executive.language import format_repository, parse
from depal.geometry import OrientedBox
from depal.logistics.placing import Spot
from depal.logistics.store import LocalStore, by_storage
from depal.server.cell import Order, Refusal, Settings
from depal.server.cellstate import CellState, Mode
from depal.simulation.cell import build
from depal.simulation.truth_sight import SightSettings

LAYOUT, DELIVERY = shipped_cell("default"), tiny(*THREE)

SHARP = SightSettings(sigma=0.001, unrecognised=0.0)


def around(folder: Path) -> tuple[Means, WorldHere, Notes, LoopClock, LocalStore]:
    """What a shift works with, in simulated time."""
    clock, store = LoopClock(), LocalStore()
    store.seed_places([DELIVERY], by_storage(LAYOUT.places, without=LAYOUT.aside))
    world = WorldHere(build(LAYOUT, DELIVERY, clock=clock, sight=SHARP), clock)

    async def connect(_: object) -> WorldHere:
        return world

    notes = Notes()
    means = Means(
        LAYOUT, folder, connect, lambda _: store, lambda: notes, lambda _: None, perception="truth"
    )
    return means, world, notes, clock, store


def test_a_run_follows_the_task_files_that_the_cell_was_given(tmp_path: Path) -> None:
    """In place of the shipped ones; its record holds them."""
    text = format_repository(read_shipped_tasks())
    own = parse(text.replace("limit speed cell.speed", "limit tilt 5 deg", 1))

    async def shift() -> None:
        means, world, notes, clock, _ = around(tmp_path)
        means = replace(means, tasks=own)
        day = Shift(means, world, notes, clock, Settings(), Picture(), lambda _: None)
        await day.start(Order(1, DELIVERY))
        await asyncio.sleep(2.0)
        await day.end()

    run_simulated(shift())
    written = (tmp_path / "runs" / "1" / "tasks.task").read_text(encoding="utf-8")
    assert parse(written).digest == own.digest


def test_a_run_that_fails_is_over_and_the_next_one_may_be_started(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Whatever it fails with: stopped, with an alarm that says so, and nothing of it left."""

    async def fails(_: Session) -> None:
        await asyncio.sleep(1.0)
        raise ValueError("a bug")

    async def shift() -> list[CellState]:
        means, world, notes, clock, _ = around(tmp_path)
        told: list[CellState] = []
        day = Shift(means, world, notes, clock, Settings(), Picture(), told.append)
        with monkeypatch.context() as patched:
            patched.setattr(Session, "run", fails)
            await day.start(Order(1, DELIVERY))
            with pytest.raises(Refusal, match="is being started"):
                await day.start(Order(2, DELIVERY))
            await asyncio.sleep(5.0)
        failed = told[-1]
        assert (failed.mode, failed.run, failed.queue) == (Mode.STOPPED, None, ())
        assert [alarm.text for alarm in failed.alarms] == ["Run 1 has failed: a bug"]
        assert [state for _, state, _ in notes.runs] == ["aborted"]
        await day.start(Order(2, DELIVERY))
        await asyncio.sleep(2.0)
        assert (told[-1].mode, told[-1].run, told[-1].alarms) == (Mode.EXECUTE, 2, ())
        await day.end()
        return told

    versions = [state.version for state in run_simulated(shift())]
    assert versions == sorted(versions)


class Full:
    """A disk that takes no journal, no ledger and no data of the store while it is full."""

    def __init__(self, patched: pytest.MonkeyPatch) -> None:
        """Not full."""
        self.full = False
        for kind, name, error in (
            (SqliteJournal, "append", JournalError),
            (Ledger, "write", JournalError),
            (LocalStore, "note", DeviceError),
            (Notes, "asked", DeviceError),
            (Notes, "answered", DeviceError),
            (Notes, "request_ended", DeviceError),
            (Notes, "run_ended", DeviceError),
        ):
            patched.setattr(kind, name, self._on_it(getattr(kind, name), error))

    def _on_it(self, write: Callable[..., object], error: type[DepalError]) -> object:
        def written(*args: object, **named: object) -> object:
            if self.full:
                message = "the disk is full"
                raise error(message)
            return write(*args, **named)

        return written


@pytest.mark.slow
@pytest.mark.parametrize("after", [1.0, 4.3, 6.1, 7.7, 9.5, 11.2, 14.0, 18.0])
@pytest.mark.parametrize("answer", [GO_ON, HOPELESS], ids=["goes on", "is started anew"])
def test_a_full_disk_holds_the_cell_and_with_room_again_it_goes_on(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, after: float, answer: str
) -> None:
    """At any moment, answered on the screen or by Start: nothing lost, nothing doubled."""

    async def shift() -> None:
        means, world, notes, clock, store = around(tmp_path)
        disk, told = Full(monkeypatch), list[CellState]()
        day = Shift(means, world, notes, clock, Settings(), Picture(), told.append)
        await day.start(Order(1, DELIVERY))
        await asyncio.sleep(after)
        disk.full = True
        await asyncio.sleep(30.0)
        state = told[-1]
        assert state.mode is Mode.HELD
        (question,) = state.questions
        assert "cannot be written" in question.text
        assert [alarm.id for alarm in state.alarms if alarm.urgent] == [question.id]
        still = world.arm.joints()
        disk.full = answer != GO_ON
        day.answer(question.id, answer, "somebody")
        await asyncio.sleep(1.0)
        if answer == HOPELESS:
            assert world.arm.joints() == pytest.approx(still, abs=1e-6)
            assert (told[-1].mode, [a.id for a in told[-1].alarms]) == (Mode.HELD, ["unwritten"])
            disk.full = False
            await day.start(None)
        await asyncio.sleep(200.0)
        assert told[-1].mode is Mode.COMPLETE
        assert (told[-1].stored, told[-1].lost, told[-1].aside) == (3, 0, 0)
        movements = store.movements()
        assert len({movement.box for movement in movements}) == len(movements) == len(THREE)
        indices, referee = world.cell.witness.indices, world.cell.referee
        assert all(referee.where(indices[each.box]) == each.place for each in movements)
        assert referee.summary().collisions == ()
        assert [state for _, state, _ in notes.runs] == ["done"]
        await day.end()

    run_simulated(shift())


@pytest.mark.slow
@pytest.mark.parametrize("by_safety", [True, False], ids=["emergency stop", "error of the arm"])
def test_after_a_stop_nothing_moves_until_somebody_says_start(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, *, by_safety: bool
) -> None:
    """Aborted after the one, Held after the other: the mode follows from the facts."""

    async def shift() -> None:
        means, world, notes, clock, _ = around(tmp_path)
        told = list[CellState]()
        day = Shift(means, world, notes, clock, Settings(), Picture(), told.append)
        await day.start(Order(1, DELIVERY))
        await asyncio.sleep(6.0)
        with monkeypatch.context() as patched:
            if by_safety:
                world.safety.stopped = True
            else:
                patched.setattr("depal.simulation.devices.SimulatedArm.follow", refuses)
            await asyncio.sleep(20.0)
            day.tell()
            assert told[-1].mode is (Mode.ABORTED if by_safety else Mode.HELD)
        stands = world.arm.joints()
        world.safety.stopped = False
        await asyncio.sleep(60.0)
        day.tell()
        assert told[-1].mode is (Mode.ABORTED if by_safety else Mode.HELD)
        assert world.arm.joints() == pytest.approx(stands, abs=1e-6)
        (question,) = told[-1].questions
        day.answer(question.id, "start", "somebody")
        await asyncio.sleep(200.0)
        assert (told[-1].mode, told[-1].stored) == (Mode.COMPLETE, 3)
        await day.end()

    async def refuses(*_: object) -> str | None:
        raise DeviceError("the arm met something")

    run_simulated(shift())


@pytest.mark.slow
@pytest.mark.parametrize("after", [3.0, 6.0, 7.2, 9.0])
def test_a_controller_that_ends_while_the_arm_is_stopped_is_taken_up(
    tmp_path: Path, after: float
) -> None:
    """Start does for both: the stop is over as well, and everything is stored once."""

    async def shift() -> None:
        means, world, notes, clock, store = around(tmp_path)
        told = list[CellState]()
        day = Shift(means, world, notes, clock, Settings(), Picture(), told.append)
        await day.start(Order(1, DELIVERY))
        await asyncio.sleep(after)
        world.safety.stopped = True
        await asyncio.sleep(20.0)
        assert told[-1].questions
        await day.end()
        world.safety.stopped = False
        later = Shift(means, world, notes, clock, Settings(), Picture(), told.append)
        await later.take_up(Order(1, DELIVERY))
        await later.start(None)
        await asyncio.sleep(200.0)
        assert (told[-1].mode, told[-1].stored, told[-1].lost) == (Mode.COMPLETE, 3, 0)
        assert sorted(each.box for each in store.movements()) == ["b1", "b2", "b3"]
        await later.end()

    run_simulated(shift())


def session_over(folder: Path) -> tuple[Session, WorldHere]:
    """A run that is taken up where there is a record, else a new one."""
    means, world, notes, clock, store = around(folder)
    there = Surroundings(LAYOUT, world, store, notes, clock, Seen(world.truth_sight))
    del means
    return Session(Order(1, DELIVERY), there, Settings(), folder / "run", lambda: None), world


def begun(folder: Path, page: Page) -> None:
    """The record of a run whose controller has ended, with this last page in its ledger."""

    async def begin() -> None:
        session, _ = session_over(folder)
        session.wired.controller.begin()
        await asyncio.sleep(0.1)
        await session.close()

    run_simulated(begin())
    with Ledger(folder / "run" / "ledger.db") as ledger:
        ledger.write(page)


def test_what_hangs_on_the_arm_unknown_to_all_is_taken_out_by_a_person(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Nothing moves before that; then the run goes on."""
    begun(tmp_path, Page())

    async def restart() -> None:
        monkeypatch.setattr("depal.simulation.devices.SimulatedArm.load", lambda _: 3.0)
        session, world = session_over(tmp_path)
        assert session.found is Found.UNKNOWN
        resuming = asyncio.create_task(session.resume("somebody"))
        before = world.arm.joints()
        await asyncio.sleep(5.0)
        (question,) = session.person.open
        assert "take it out of the gripper" in question.text
        assert world.arm.joints() == pytest.approx(before, abs=1e-9)
        session.person.answer(question.id, "taken", "somebody")
        await resuming
        assert session.stage is Stage.WORKING
        await session.close()

    run_simulated(restart())


def test_a_restart_that_does_not_get_clear_is_reconciled_anew_at_the_next_start(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """It is not simply gone on with: the ledger still counts."""
    begun(tmp_path, Page())

    async def refuses(*_: object) -> str | None:
        raise DeviceError("the arm does not move")

    async def restart() -> None:
        session, _ = session_over(tmp_path)
        with monkeypatch.context() as patched:
            patched.setattr("depal.cell.recovery.get_clear", refuses)
            with pytest.raises(DeviceError, match="does not move"):
                await session.resume("somebody")
        assert session.stage is Stage.RECOVERED
        await session.resume("somebody")
        assert session.stage is Stage.WORKING
        await session.close()

    run_simulated(restart())


@pytest.mark.parametrize("fetched", [False, True])
def test_what_was_set_aside_and_not_fetched_is_asked_about_again(
    tmp_path: Path, *, fetched: bool
) -> None:
    """After a restart: a box that nobody has taken away still stands there."""
    place = LAYOUT.storage(LAYOUT.aside).places[0]
    size = (0.25, 0.28, 0.22)
    spot = Spot(place.id, (0.05, -0.1, 0.0), size)
    solid = OrientedBox(place.cell_from_place @ spot.place_from_box, size)
    kept = () if fetched else (KeptBox(place.id, spot.standing(BoxId("b1"), 4.0), solid),)
    aside = Departure(
        BoxId("b1"), None, Approach.VERTICAL, place.id, Fate.SET_ASIDE, "nobody knows it", 3.0
    )
    left = (LeftBox(BoxId("b1"), 3.0, None),)
    begun(tmp_path, Page(left=left, departures=(aside,), kept=kept))

    async def restart() -> list[str]:
        session, _ = session_over(tmp_path)
        await session.resume("somebody")
        await asyncio.sleep(3.0)
        asked = [question.text for question in session.person.open if not question.blocks]
        await session.close()
        return asked

    told = ["Box b1 was set aside: nobody knows it. Please take it away."]
    assert run_simulated(restart()) == ([] if fetched else told)
