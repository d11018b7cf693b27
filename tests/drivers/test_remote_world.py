"""The world in a process of its own: it outlives its controllers, and obeys one at a time."""

import asyncio
import json
import os
import signal
import struct
import subprocess
import sys
import time
from collections.abc import Callable, Coroutine, Iterator
from pathlib import Path
from typing import Any, TypeVar

import msgspec
import numpy as np
import pytest

from depal.cell.files import shipped_cell
from depal.drivers.remote import RemoteWorld, connect, start_world
from depal.drivers.remote.finding import CARD, Card, card_of
from depal.errors import DeviceError
from depal.executive.clock import LoopClock, run_paced
from depal.logistics import read_delivery
from depal.ports import Trajectory
from depal.ports.wire import messages as m
from depal.ports.wire.codec import HEAD, LARGEST, encoded, packed, unpacked
from depal.ports.wire.values import Photo

T = TypeVar("T")

LAYOUT = shipped_cell("default")

DELIVERY = read_delivery("dev-035")

PACE = 20.0


@pytest.fixture
def card(tmp_path: Path) -> Iterator[Card]:
    """A world that runs, and ends with the test."""
    found = start_world(tmp_path, PACE)
    yield found
    if found.lives:
        os.kill(found.pid, signal.SIGKILL)
        os.waitpid(found.pid, 0)


def ended(card: Card) -> bool:
    """Whether the process ends within some seconds."""
    for _ in range(200):
        done, _status = os.waitpid(card.pid, os.WNOHANG)
        if done:
            return True
        time.sleep(0.05)
    return False


def within(card: Card, work: Callable[[], Coroutine[Any, Any, T]]) -> T:
    """Runs in the world's time."""
    return run_paced(work(), card.pace)


async def built(folder: Path) -> RemoteWorld:
    """A line to a world with a pallet."""
    world = await connect(folder, len(LAYOUT.cameras))
    await world.build(LAYOUT, DELIVERY, seed=0, severity="normal", number=7)
    return world


def swing(world: RemoteWorld, turn: float, seconds: float = 2.0) -> Trajectory:
    """The first axis turns from where it stands."""
    start = np.array(world.arm.joints())
    share = np.linspace(0.0, 1.0, 41)
    smooth = 3 * share**2 - 2 * share**3
    positions = start + np.outer(smooth, [turn, 0, 0, 0, 0, 0])
    rates = np.outer((6 * share - 6 * share**2) / seconds, [turn, 0, 0, 0, 0, 0])
    return Trajectory(share * seconds, positions, rates)


@pytest.mark.slow
def test_a_pallet_is_built_seen_and_remembered(card: Card, tmp_path: Path) -> None:
    """Another controller that comes later finds what stands there, and time risen."""

    async def first() -> float:
        world = await built(tmp_path)
        view = await world.truth_sight.look()
        assert len(view.boxes) > 5
        frame = await world.cameras[0].take()
        assert frame.colour.shape == (1920, 1080, 3)
        assert (await world.referee.judge()).where.count("pallet") == len(DELIVERY.boxes)
        at = LoopClock().now()
        await world.close()
        return at

    async def second() -> tuple[m.Built | None, float]:
        world = await connect(tmp_path, 2)
        found = world.built, LoopClock().now()
        await world.close()
        return found

    before = within(card, first)
    found, now = within(card, second)
    assert found == m.Built("dev-035", 7)
    assert now > before


@pytest.mark.slow
def test_a_motion_ends_at_its_end_and_a_guard_stops_it_before(card: Card, tmp_path: Path) -> None:
    """As in process: None at the end, else the reason; cancelled, the arm comes to rest."""

    async def moves() -> None:
        world = await built(tmp_path)
        motion = swing(world, 0.8)
        assert await world.arm.follow(motion) is None
        assert world.arm.joints() == pytest.approx(motion.end, abs=1e-3)
        calls = []

        def guard() -> str | None:
            calls.append(1)
            return "enough" if len(calls) > 2 else None

        back = swing(world, -0.8)
        assert await world.arm.follow(back, guard) == "enough"
        assert abs(world.arm.joints()[0] - back.end[0]) > 0.05
        task = asyncio.create_task(world.arm.follow(swing(world, -0.4)))
        await asyncio.sleep(0.5)
        task.cancel()
        await asyncio.gather(task, return_exceptions=True)
        await asyncio.sleep(1.0)
        rest = world.arm.joints()
        await asyncio.sleep(1.0)
        assert world.arm.joints() == rest
        far = swing(world, 1.0)
        away = Trajectory(far.times, far.positions + 0.5, far.velocities)
        with pytest.raises(DeviceError, match=r"begins 0\.500 rad from"):
            await world.arm.follow(away)
        await world.close()

    within(card, moves)


KILLED = """
import asyncio, sys
sys.path.insert(0, {tests!r})
from test_remote_world import *
folder = Path({folder!r})
async def work():
    world = await built(folder)
    asyncio.create_task(world.arm.follow(swing(world, 1.2, 4.0)))
    await world.gripper.suck((("front", 0),))
    print("moving", flush=True)
    await asyncio.sleep(60)
within(card_of(folder), work)
"""


@pytest.mark.slow
def test_a_controller_that_is_killed_leaves_the_arm_at_rest_and_the_valves_as_they_were(
    card: Card, tmp_path: Path
) -> None:
    """The world lives on and waits; while it is commanded nobody else commands it."""
    code = KILLED.format(tests=str(Path(__file__).parent), folder=str(tmp_path))
    with subprocess.Popen(  # noqa: S603 - our own code
        [sys.executable, "-c", code], stdout=subprocess.PIPE, text=True
    ) as controller:
        assert controller.stdout is not None
        assert controller.stdout.readline() == "moving\n"
        with pytest.raises(DeviceError, match=f"another controller .* process {controller.pid}"):
            within(card, lambda: connect(tmp_path, 2))
        controller.send_signal(signal.SIGKILL)
        controller.wait()

    async def look() -> None:
        world = await connect(tmp_path, 2)
        await asyncio.sleep(2.0)
        rest = world.arm.joints()
        await asyncio.sleep(2.0)
        assert world.arm.joints() == rest
        await world.close()

    within(card, look)
    assert card.lives


@pytest.mark.slow
@pytest.mark.parametrize("way", ["SIGTERM", "SIGINT", "shutdown"])
def test_an_ordered_end_takes_its_files_with_it(card: Card, tmp_path: Path, way: str) -> None:
    """By a signal, or by the controller's word."""
    if way == "shutdown":

        async def end() -> None:
            await (await connect(tmp_path, 2)).shutdown()

        within(card, end)
    else:
        os.kill(card.pid, getattr(signal, way))
    assert ended(card)
    assert sorted(path.name for path in tmp_path.iterdir()) == ["world.log"]
    assert card_of(tmp_path) is None
    with pytest.raises(DeviceError, match="no world runs beside"):
        asyncio.run(connect(tmp_path, 2))


def frames(*bodies: bytes) -> bytes:
    """Bodies with their lengths."""
    return b"".join(HEAD.pack(len(body)) + body for body in bodies)


HELLO = encoded(m.Request(1, m.Hello(m.VERSION, 4711)))

BAD = {
    "garbled": frames(b"\xc1\x00what is this"),
    "oversize": struct.pack(">I", LARGEST + 1) + b"x",
    "another version": encoded(m.Request(1, m.Hello(99, 4711))),
    "no hello": encoded(m.Request(1, m.Read())),
    "garbled later": HELLO + frames(b"\xc1"),
}


@pytest.mark.slow
def test_what_is_no_message_ends_the_connection_and_nothing_else(
    card: Card, tmp_path: Path
) -> None:
    """With a reason, where there is somebody to tell; the next controller is welcome."""

    async def say(data: bytes) -> list[m.Reply]:
        reader, writer = await asyncio.open_unix_connection(card.socket)
        writer.write(data)
        replies = []
        while head := await reader.read(HEAD.size):
            (length,) = HEAD.unpack(head)
            body = await reader.readexactly(length)
            replies.append(msgspec.msgpack.decode(body, type=m.Reply))
        writer.close()
        await writer.wait_closed()
        return replies

    for what, data in BAD.items():
        replies = asyncio.run(say(data))
        assert replies[-1].error, what

    async def welcome() -> None:
        world = await built(tmp_path)
        with pytest.raises(DeviceError, match="there is no camera 9"):
            await world._line.call(m.Take(9), Photo)  # noqa: SLF001 - no port says this
        await world.close()

    within(card, welcome)


def test_a_card_of_a_world_that_has_gone_is_no_card(tmp_path: Path) -> None:
    """Nor is one that cannot be read."""
    assert card_of(tmp_path) is None
    path = tmp_path / CARD
    path.write_text("{", encoding="utf-8")
    assert card_of(tmp_path) is None
    body = {"pid": 2**22 - 1, "socket": "x", "pace": 1.0, "start": 0.0, "origin": 0.0}
    path.write_text(json.dumps(body), encoding="utf-8")
    assert card_of(tmp_path) is None


@pytest.mark.parametrize("kind", [np.uint8, np.float32, np.float64])
def test_an_array_comes_as_it_went(kind: type) -> None:
    """Type, shape and bytes."""
    array = np.arange(24, dtype=kind).reshape(2, 3, 4)
    table = msgspec.msgpack.decode(msgspec.msgpack.encode(packed(array)), type=type(packed(array)))
    found = unpacked(table)
    assert found.dtype == array.dtype
    assert (found == array).all()


def test_an_array_that_is_none_is_refused() -> None:
    """A kind that is not sent, and bytes that do not fill its shape."""
    good = packed(np.zeros(3))
    with pytest.raises(DeviceError, match="'O8' came"):
        unpacked(msgspec.structs.replace(good, kind="O8"))
    with pytest.raises(DeviceError, match="that is none"):
        unpacked(msgspec.structs.replace(good, shape=(2, 2)))


def test_paced_time_runs_as_fast_as_it_is_told(card: Card) -> None:
    """Sleeping takes its share of real time, and time is the same in every loop."""

    async def sleep() -> tuple[float, float]:
        loop = asyncio.get_running_loop()
        before, began = loop.time(), time.monotonic()
        await asyncio.sleep(PACE)  # a second of real time
        return loop.time() - before, time.monotonic() - began

    simulated, real = run_paced(sleep(), card.pace)
    assert simulated >= PACE
    assert real == pytest.approx(simulated / PACE, rel=0.2)
