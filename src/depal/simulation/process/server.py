"""One controller at a time works in the world, over a socket that only this user may open."""

import asyncio
import hashlib
import json
import os
import signal
import tempfile
import time
from contextlib import suppress
from pathlib import Path

import msgspec

from depal.errors import DepalError, DeviceError
from depal.executive.clock import Pace
from depal.ports.wire import messages as m
from depal.ports.wire.codec import encoded, received
from depal.simulation.process.late import lag_of_this_loop
from depal.simulation.process.world import SILENT, Stage, done

SOCKET, CARD = "world.sock", "world.json"
"""In the data folder: where the world listens, and who it is."""

TICK = 0.02
"""The world goes on, and its sensors are told, so often [s of wall time]."""

REST = 0.5
"""While nothing changes they are told so often [s of wall time]."""

HUNG = 5.0
"""A controller that has said nothing for this long is gone [s of wall time]."""


LONGEST = 100
"""The system takes no longer name for a socket [byte]."""


def socket_in(folder: Path) -> Path:
    """Where the world of a data folder listens; beside other temporary files for a deep one."""
    socket = (folder / SOCKET).resolve()
    if len(os.fsencode(socket)) <= LONGEST:
        return socket
    digest = hashlib.sha256(os.fsencode(socket)).hexdigest()[:24]
    return Path(tempfile.gettempdir()) / f"depal-{digest}.sock"


class WorldServer:
    """The process's only object."""

    def __init__(self, folder: Path, pace: Pace) -> None:
        """Not listening yet.

        Args:
            folder: the data folder.
            pace: of the world's time.
        """
        self._folder, self._pace = folder, pace
        self._stage = Stage()
        self._controller: tuple[int, asyncio.StreamWriter] | None = None
        self._working: set[asyncio.Task[None]] = set()
        self._heard = time.monotonic()
        self._over = asyncio.Event()
        self._told: tuple[m.State | None, float] = (None, 0.0)

    async def serve(self) -> None:
        """Until somebody ends it; its files go with it."""
        loop = asyncio.get_running_loop()
        for number in (signal.SIGTERM, signal.SIGINT):
            loop.add_signal_handler(number, self._over.set)
        socket, card = socket_in(self._folder), self._folder / CARD
        socket.unlink(missing_ok=True)
        server = await asyncio.start_unix_server(self._meet, socket)
        socket.chmod(0o600)
        self._write_card(card, socket)
        ticking = asyncio.create_task(self._tick())
        try:
            await self._over.wait()
        finally:
            ticking.cancel()
            server.close()
            socket.unlink(missing_ok=True)
            card.unlink(missing_ok=True)

    def _write_card(self, card: Path, socket: Path) -> None:
        pace = self._pace
        body = {
            "pid": os.getpid(),
            "socket": str(socket),
            "version": m.VERSION,
            "pace": pace.rate,
            "start": pace.start,
            "origin": pace.origin,
        }
        fresh = card.with_suffix(".new")
        fresh.write_text(json.dumps(body), encoding="utf-8")
        fresh.replace(card)

    async def _tick(self) -> None:
        """The world goes on whether or not somebody works in it."""
        while True:
            await asyncio.sleep(TICK * self._pace.rate)
            self._stage.advance()
            if self._controller is None:
                continue
            now = time.monotonic()
            if now - self._heard > HUNG:
                self._stage.halt(SILENT)
            state, (told, at) = self._stage.state(), self._told
            if state is not None and (_differs(state, told) or now - at > REST):
                self._told = (state, now)
                self._say(m.Reply(0, state=state))

    def _say(self, reply: m.Reply) -> None:
        if self._controller is not None:
            self._controller[1].write(encoded(reply))

    async def _meet(self, reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
        decoder = msgspec.msgpack.Decoder(m.Request)
        try:
            first = await received(reader, decoder)
            refusal = self._refusal(first.call)
            if refusal is not None:
                writer.write(encoded(m.Reply(first.number, error=refusal)))
                await writer.drain()
                return
            await self._work_for(reader, writer, first, decoder)
        except DeviceError as error:
            with suppress(ConnectionError):
                writer.write(encoded(m.Reply(0, error=str(error))))
                await writer.drain()
        except (EOFError, ConnectionError):
            pass
        finally:
            writer.close()

    def _refusal(self, hello: m.Call) -> str | None:
        if not isinstance(hello, m.Hello):
            return f"{type(hello).__name__} came first; expected Hello"
        if hello.version != m.VERSION:
            return f"the controller speaks version {hello.version}; expected {m.VERSION}"
        if self._controller is not None:
            return f"another controller commands this world, process {self._controller[0]}"
        return None

    async def _work_for(
        self,
        reader: asyncio.StreamReader,
        writer: asyncio.StreamWriter,
        first: m.Request,
        decoder: "msgspec.msgpack.Decoder[m.Request]",
    ) -> None:
        pid = first.call.pid if isinstance(first.call, m.Hello) else 0
        self._controller = (pid, writer)
        self._heard = time.monotonic()
        pace = self._pace
        welcome = m.Welcome(
            pace.rate, pace.start, pace.origin, self._stage.built, lag_of_this_loop()
        )
        value = msgspec.msgpack.encode(welcome)
        self._say(m.Reply(first.number, value, state=self._stage.state()))
        try:
            while not self._over.is_set():
                request = await received(reader, decoder)
                self._heard = time.monotonic()
                self._take(request)
        finally:
            self._let_go()

    def _take(self, request: m.Request) -> None:
        match request.call:
            case m.Beat():
                return
            case m.Halt(reason):
                self._stage.halt(reason)
            case m.Shutdown():
                self._over.set()
            case _:
                task = asyncio.get_running_loop().create_task(self._reply(request))
                self._working.add(task)
                task.add_done_callback(self._working.discard)

    async def _reply(self, request: m.Request) -> None:
        reply = await done(self._stage, request)
        with suppress(DepalError, ConnectionError):
            self._say(reply)

    def _let_go(self) -> None:
        """The arm comes to rest where it is; what people do, and the valves, are not touched."""
        self._controller = None
        self._stage.halt(SILENT)


def _differs(state: m.State, told: m.State | None) -> bool:
    """Whether anything but the time has changed."""
    return told is None or any(
        getattr(state, name) != getattr(told, name)
        for name in state.__struct_fields__
        if name != "at"
    )
