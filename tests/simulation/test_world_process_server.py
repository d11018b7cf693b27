"""The world's server: what comes over the line, in which order, and who is gone."""

import asyncio
import json
import os
import stat
import struct
from dataclasses import replace
from pathlib import Path

import msgspec
import pytest
from served_worlds import PACE, Side, controller, far, paced, serving, side_of
from simulated_layouts import PARKED, delivery, layout, point_to_point, radians

from depal.drivers.remote import RemoteWorld, connect, start_world
from depal.drivers.remote.finding import CARD, card_of
from depal.drivers.remote.line import Line
from depal.errors import DeviceError
from depal.executive.clock import LoopClock, Pace
from depal.ports import Question, Watch
from depal.ports.wire import messages as m
from depal.ports.wire.codec import HEAD, encoded
from depal.ports.wire.values import Path as Way
from depal.simulation.process import server as serving_module
from depal.simulation.process.beside import socket_in
from depal.simulation.process.server import WorldServer

AWAY = radians(-15, -102, 125, 60, 80, 30)
CELL = layout()
NOTE = delivery(((0.4, 0.2, 0.0), (0.3, 0.3, 0.3), 5.0), ((0.8, 0.4, 0.0), (0.2, 0.2, 0.2), 3.0))
SWING = point_to_point(PARKED, AWAY, 3.0)
EXCHANGE = Question("q1", "Exchange trolley_1?", ("done", "not now"), "trolley_1")

BUILD = m.Build(CELL, NOTE, 0, "normal", 1)
HELLO = m.Hello(m.VERSION, 4711)


class Raw:
    """A controller that says what it likes."""

    def __init__(self, reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
        """Connected."""
        self.reader, self.writer = reader, writer

    @classmethod
    async def to(cls, folder: Path) -> "Raw":
        """A world's server."""
        return cls(*await asyncio.open_unix_connection(socket_in(folder)))

    def say(self, *calls: m.Call, first: int = 1) -> None:
        """In one write, so that they come at once."""
        requests = (m.Request(first + k, call) for k, call in enumerate(calls))
        self.writer.write(b"".join(encoded(request) for request in requests))

    async def hears(self, number: int) -> m.Reply:
        """The reply to a call."""
        while True:
            (length,) = HEAD.unpack(await self.reader.readexactly(HEAD.size))
            body = await self.reader.readexactly(length)
            reply = msgspec.msgpack.decode(body, type=m.Reply)
            if reply.number == number:
                return reply

    async def ready(self) -> None:
        """It commands a world with a pallet."""
        self.say(HELLO, BUILD)
        assert (await self.hears(2)).error is None

    async def close(self) -> None:
        """As a process does that is killed."""
        self.writer.transport.abort()
        await asyncio.sleep(0.0)


def rests(server: WorldServer) -> bool:
    """Whether the arm stands still, not at the end of its way."""
    world = server.stage.cell.world
    world.advance(LoopClock().now())
    away = abs(world.joints()[3] - AWAY[3])
    return not world.wanted()[1].any() and away > 0.1


def test_a_halt_right_behind_a_motion_is_for_that_motion() -> None:
    """Both in one packet: the arm does not go all the way."""

    async def work() -> None:
        async with serving() as (server, folder):
            raw = await Raw.to(folder)
            await raw.ready()
            raw.say(m.Follow(Way.of(SWING), Watch()), m.Halt("no"), first=3)
            assert msgspec.msgpack.decode((await raw.hears(3)).value) == "no"
            await asyncio.sleep(4.0)
            assert rests(server)
            await raw.close()

    paced(work)


def test_a_motion_that_follows_a_halt_waits_until_the_arm_rests_and_does_not_lift_the_halt() -> (
    None
):
    """The second motion begins where the first was to begin: by then that is elsewhere."""

    async def work() -> None:
        async with serving() as (server, folder):
            raw = await Raw.to(folder)
            await raw.ready()
            follow = m.Follow(Way.of(SWING), Watch())
            raw.say(follow, first=3)
            await asyncio.sleep(1.2)
            raw.say(m.Halt("first"), follow, first=4)
            assert msgspec.msgpack.decode((await raw.hears(3)).value) == "first"
            assert "the trajectory begins" in str((await raw.hears(5)).error)
            await asyncio.sleep(3.0)
            assert rests(server)
            await raw.close()

    paced(work)


@pytest.mark.parametrize("before", [0.0, 1.0])
def test_a_controller_that_goes_leaves_the_arm_at_rest_even_in_the_moment_of_its_command(
    before: float,
) -> None:
    """Killed right behind the command, or half-way; the valves stay as they are."""

    async def work() -> None:
        async with serving() as (server, folder):
            raw = await Raw.to(folder)
            await raw.ready()
            raw.say(m.Suck((("front", 0),)), m.Follow(Way.of(SWING), Watch()), first=3)
            await raw.writer.drain()
            await asyncio.sleep(before)
            await raw.close()
            await asyncio.sleep(4.0)
            assert rests(server)
            assert server.stage.cell.world.suction.open["front"] == (0,)

    paced(work)


def test_a_controller_that_hangs_brings_the_arm_to_rest_and_one_that_beats_does_not() -> None:
    """Its line is open, but it says nothing."""

    async def motion(server: WorldServer, folder: Path, *, beats: bool) -> bool:
        raw = await Raw.to(folder)
        await raw.ready()
        slow = point_to_point(PARKED, AWAY, 12.0)
        raw.say(m.Follow(Way.of(slow), Watch()), first=3)
        for _ in range(24):  # 0.6 s of wall time in all
            await asyncio.sleep(0.5)
            if beats:
                raw.say(m.Beat(), first=0)
        await asyncio.sleep(1.0)
        still = rests(server)
        await raw.close()
        return still

    async def work(*, beats: bool) -> bool:
        async with serving(patience=0.2) as (server, folder):
            return await motion(server, folder, beats=beats)

    assert paced(lambda: work(beats=False))
    assert not paced(lambda: work(beats=True))


def test_a_world_that_was_busy_does_not_take_that_for_silence() -> None:
    """It could not hear anybody; a picture of a slow machine takes seconds."""

    async def work() -> None:
        async with serving(patience=0.2) as (server, folder):
            raw = await Raw.to(folder)
            await raw.ready()
            link = server._link  # noqa: SLF001 - nobody else knows how long it was silent
            assert link is not None
            server._go_on(min(30.0, serving_module.HEARD))  # noqa: SLF001 - one long round
            assert link.silence <= 0.2
            await raw.close()

    paced(work)


def test_a_reply_goes_to_who_has_called_and_not_to_who_comes_after() -> None:
    """A trolley's exchange outlives the controller; the next one has the same numbers."""

    async def work() -> None:
        async with serving() as (server, folder):
            first = await Raw.to(folder)
            await first.ready()
            first.say(m.Do(EXCHANGE, "done"), first=3)
            await asyncio.sleep(1.0)
            await first.close()
            await asyncio.sleep(0.1)
            second = await Raw.to(folder)
            second.say(HELLO)
            assert (await second.hears(1)).error is None
            second.say(m.Do(Question("q", "Wait?", ("no", "yes"), "trolley_2"), "no"), first=3)
            reply = asyncio.create_task(second.hears(3))
            await asyncio.sleep(29.5)  # the first exchange has ended
            assert server.stage.cell.bays.trolley("trolley_1") == "trolley_1#2"
            assert not reply.done()
            await reply
            await second.close()

    paced(work, 60.0)


def test_one_controller_at_a_time_and_the_next_finds_what_stands_there() -> None:
    """The second is told who commands the world; time has risen for the third."""

    async def work() -> None:
        async with serving() as (_server, folder):
            world = await controller(folder)
            assert world.built is None
            await world.build(CELL, NOTE, seed=0, severity="normal", number=3)
            with pytest.raises(DeviceError, match=f"another controller .* process {os.getpid()}"):
                await controller(folder)
            at = world._line.state.at  # noqa: SLF001 - the port has no time
            await world.close()
            await asyncio.sleep(0.5)
            other = await controller(folder)
            assert other.built == m.Built("test", 3)
            assert other._line.state.at > at  # noqa: SLF001 - the port has no time
            await other.close()

    paced(work)


def test_sensors_are_told_without_being_asked_and_who_does_not_read_fills_no_memory() -> None:
    """What a person has done shows at once; a line that is full carries no more news."""

    async def work() -> None:
        async with serving() as (server, folder):
            world = await controller(folder)
            await world.build(CELL, NOTE, seed=0, severity="normal", number=1)
            server.stage.cell.world.show_storage("trolley_1", trolley="other")
            await asyncio.sleep(1.0)
            assert world.bays.trolley("trolley_1") == "other"
            await world.close()
            raw = await Raw.to(folder)
            raw.say(HELLO)
            await raw.hears(1)
            raw.reader._transport.pause_reading()  # type: ignore[attr-defined] # noqa: SLF001
            link = server._link  # noqa: SLF001
            assert link is not None
            sent = link._writer.transport  # noqa: SLF001
            for _ in range(3000):
                link._told = (None, 0.0)  # noqa: SLF001 - as if it were news every time
                link.tell(*server.stage.sensed())
            assert 0 < sent.get_write_buffer_size() < 2**19
            await raw.close()

    paced(work)


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (m.Take(9), "there is no camera 9; there are 1"),
        (m.Build(CELL, NOTE, 0, "awful", 1), "there is no severity 'awful'; expected one of"),
        (HELLO, "Hello is no call"),
        (m.Do(replace(EXCHANGE, choices=()), "done"), "the simulated world has failed: IndexError"),
        (m.Follow(Way.of(point_to_point(PARKED[:5], AWAY[:5], 1.0)), Watch()), "of shapes"),  # type: ignore[arg-type]
    ],
)
def test_what_cannot_be_done_is_told_and_the_world_goes_on(call: m.Call, message: str) -> None:
    """Whatever it is; even a fault of the world's own leaves nobody waiting."""

    async def work(side: Side) -> None:
        assert side.world is not None
        with pytest.raises(DeviceError, match=message):
            await side.world._line.call(call, type(None))  # noqa: SLF001 - no port says this
        assert await side.arm.follow(SWING) is None

    far(work, CELL, NOTE)


def test_nothing_can_be_done_before_something_is_built() -> None:
    """Readings and commands say so."""

    async def work() -> None:
        async with serving() as (_server, folder):
            world = await controller(folder)
            with pytest.raises(DeviceError, match="nothing is built in this world"):
                world.arm.joints()
            with pytest.raises(DeviceError, match="nothing is built in this world"):
                await world.arm.follow(SWING)
            with pytest.raises(DeviceError, match="nothing is built in this world"):
                await world.referee.judge()
            await world.close()

    paced(work)


def test_a_pallet_is_not_exchanged_while_the_arm_moves_and_stands_anew_when_it_rests() -> None:
    """Another delivery replaces the cell as a whole."""

    async def work(side: Side) -> None:
        world = side.world
        assert world is not None
        motion = asyncio.create_task(side.arm.follow(SWING))
        await asyncio.sleep(0.2)
        with pytest.raises(DeviceError, match="the arm moves"):
            await world.build(CELL, NOTE, seed=0, severity="normal", number=2)
        await motion
        await world.build(CELL, NOTE, seed=0, severity="normal", number=2)
        assert world.built == m.Built("test", 2)
        assert world.arm.joints() == pytest.approx(PARKED, abs=1e-3)

    far(work, CELL, NOTE)


def test_the_referee_knows_which_box_a_name_means() -> None:
    """For reports: where each box is, and what has happened."""

    async def work(side: Side) -> m.Truth:
        world = side.world
        assert world is not None
        side.cell.world.place_box(1, side.cell.world.flange())
        side.cell.witness.means = lambda name, index: side.cell.witness._indices.update(  # type: ignore[method-assign] # noqa: SLF001
            {name: index}
        )
        await side.do(Question("q", "Take it.", ("taken", "no"), "b1"), "taken")
        world.witness_lifted("mine")  # type: ignore[arg-type] # nothing hangs: nothing is meant
        await asyncio.sleep(0.2)
        return await world.referee.judge()

    truth = far(work, CELL, NOTE)
    assert truth.where[0] == "removed"
    assert truth.names == {"b1": 0}
    assert truth.lost == 0


def test_an_end_is_told_to_whoever_is_connected_and_takes_the_files_along() -> None:
    """Commands that wait fail, and so do readings; a shutdown has ended the world when it ends."""

    async def work() -> None:
        async with serving() as (_server, folder):
            assert stat.S_IMODE(socket_in(folder).stat().st_mode) == 0o600
            card = json.loads((folder / CARD).read_text())
            assert card["pid"] == os.getpid()
            world = await controller(folder)
            await world.build(CELL, NOTE, seed=0, severity="normal", number=1)
            idle = await Raw.to(folder)
            motion = asyncio.create_task(world.arm.follow(SWING))
            await asyncio.sleep(0.3)
            await world.shutdown()
            assert list(folder.iterdir()) == []
            with pytest.raises(DeviceError, match="the world's process has gone"):
                await motion
            with pytest.raises(DeviceError, match="the world's process has gone"):
                world.arm.joints()
            assert await idle.reader.read() == b""
            idle.writer.close()
            await world.shutdown()

    paced(work)


def test_beside_a_folder_one_world_runs() -> None:
    """A second one leaves the first one's files alone, and neither is it started."""

    async def work() -> None:
        async with serving() as (_server, folder):
            with pytest.raises(DeviceError, match="another world runs beside"):
                await WorldServer(folder, Pace.from_now(PACE)).serve()
            with pytest.raises(DeviceError, match=f"already, process {os.getpid()}"):
                start_world(folder, PACE)
            world = await connect(folder, 1)
            await world.close()

    paced(work)


def test_a_card_whose_number_another_process_has_by_now_is_none(tmp_path: Path) -> None:
    """After a power cut the numbers begin anew: nobody listens, so no world runs there."""
    body = {"pid": os.getpid(), "socket": str(tmp_path / "world.sock")}
    body |= {"pace": 1.0, "start": 0.0, "origin": 0.0}
    (tmp_path / CARD).write_text(json.dumps(body), encoding="utf-8")
    assert card_of(tmp_path) is None


def test_what_ends_the_line_is_told_to_whoever_waits() -> None:
    """The world's word, where it has said one."""

    async def work(side: Side) -> str:
        world = side.world
        assert isinstance(world, RemoteWorld)
        waiting = asyncio.create_task(side.arm.follow(SWING))
        await asyncio.sleep(0.1)
        line: Line = world._line  # noqa: SLF001 - to say what no port says
        line._writer.write(struct.pack(">I", 1) + b"\xc1")  # noqa: SLF001
        with pytest.raises(DeviceError) as caught:
            await waiting
        return str(caught.value)

    assert "what came is no message" in far(work, CELL, NOTE)


def test_a_motion_that_is_broken_off_on_a_dead_line_is_broken_off_all_the_same() -> None:
    """No other error takes the place of the cancellation."""

    async def work() -> None:
        async with serving() as (server, folder):
            world = await controller(folder)
            await world.build(CELL, NOTE, seed=0, severity="normal", number=1)
            side = side_of(world, server)
            motion = asyncio.create_task(side.arm.follow(SWING))
            await asyncio.sleep(0.2)
            motion.cancel()
            world._line._closed = "gone"  # noqa: SLF001 - as when it breaks at the same time
            with pytest.raises(asyncio.CancelledError):
                await motion
            await world.close()

    paced(work)
