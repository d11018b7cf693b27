"""The world's server and a line to it in one process: a cell behind two sets of ports."""

import asyncio
import tempfile
from collections.abc import AsyncIterator, Callable, Coroutine, Sequence
from contextlib import asynccontextmanager, suppress
from dataclasses import dataclass
from pathlib import Path
from typing import Any, TypeVar

from depal.domain import CellLayout, Delivery
from depal.drivers.remote import RemoteWorld
from depal.drivers.remote.line import Line
from depal.executive.clock import Pace, run_paced, run_simulated
from depal.ports import Arm, BarcodeReader, Bays, Camera, Gripper, Question, Safety, Sight
from depal.simulation import SimulatedCell, build
from depal.simulation.process.beside import socket_in
from depal.simulation.process.server import HUNG, WorldServer

T = TypeVar("T")

PACE = 20.0


@dataclass
class Side:
    """A cell behind its ports, and the simulated one that truly is there."""

    arm: Arm
    gripper: Gripper
    bays: Bays
    safety: Safety
    reader: BarcodeReader
    sight: Sight
    cameras: Sequence[Camera]
    do: Callable[[Question, str], Coroutine[Any, Any, None]]
    what_is_so: Callable[[Question], Coroutine[Any, Any, str]]
    cell: SimulatedCell
    world: RemoteWorld | None = None


Work = Callable[[Side], Coroutine[Any, Any, T]]


def near(work: Work[T], layout: CellLayout, delivery: Delivery) -> T:
    """Works in a cell of this process, in simulated time."""

    async def everything() -> T:
        cell = build(layout, delivery)
        person = cell.person

        async def what_is_so(question: Question) -> str:
            return person.what_is_so(question)

        return await work(
            Side(
                cell.arm, cell.gripper, cell.bays, cell.safety, cell.reader, cell.sight,
                cell.cameras, person.does, what_is_so, cell,
            )
        )  # fmt: skip

    return run_simulated(everything())


def far(work: Work[T], layout: CellLayout, delivery: Delivery) -> T:
    """Works in a cell behind a socket, in time at a pace."""

    async def everything() -> T:
        async with serving() as (server, folder):
            world = await controller(folder)
            await world.build(layout, delivery, seed=0, severity="normal", number=1)
            result = await work(side_of(world, server))
            await world.close()
            return result

    return paced(everything)


def side_of(world: RemoteWorld, server: WorldServer) -> Side:
    """The ports of a remote world, and the cell behind them."""
    deeds = world.deeds
    return Side(
        world.arm, world.gripper, world.bays, world.safety, world.reader, world.truth_sight,
        world.cameras, deeds.do, deeds.what_is_so, server.stage.cell, world,
    )  # fmt: skip


def paced(work: Callable[[], Coroutine[Any, Any, T]], rate: float = PACE) -> T:
    """Runs in time at a pace."""
    return run_paced(work(), Pace.from_now(rate))


@asynccontextmanager
async def serving(
    rate: float = PACE, patience: float = HUNG
) -> AsyncIterator[tuple[WorldServer, Path]]:
    """A world's server on this loop, in a folder of its own."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        server = WorldServer(folder, Pace.from_now(rate), patience)
        task = asyncio.create_task(server.serve())
        while not (folder / "world.json").exists():  # noqa: ASYNC110 - it tells nobody
            await asyncio.sleep(0.01)
        try:
            yield server, folder
        finally:
            server.end()
            with suppress(asyncio.CancelledError):
                await task


async def controller(folder: Path, cameras: int = 1) -> RemoteWorld:
    """A line to the server of a folder."""
    line, welcome = await Line.open(socket_in(folder))
    return RemoteWorld(line, welcome, cameras)
