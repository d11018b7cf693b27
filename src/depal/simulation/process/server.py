"""One controller at a time works in the world, over a socket that only this user may open."""

import asyncio
import time
from collections.abc import Awaitable
from contextlib import suppress
from pathlib import Path

import msgspec

from depal.errors import DepalError, DeviceError
from depal.executive.clock import Pace
from depal.ports.wire import messages as m
from depal.ports.wire.codec import encoded, received
from depal.simulation.process.beside import alone, card, socket_in
from depal.simulation.process.late import lag_of_this_loop
from depal.simulation.process.link import Link
from depal.simulation.process.world import SILENT, Stage, done

SENSED = 0.02
"""The sensors are told so often [s of the world's time] ..."""

OFTEN, SELDOM = 0.004, 0.02
"""... but not oftener and not more seldom than this [s of wall time]."""

HUNG = 5.0
"""A controller that has said nothing for this long is gone [s of wall time]."""

HEARD = 0.1
"""A round of the loop that takes longer than this, the world was too busy to listen [s]."""


class WorldServer:
    """The process's only object.

    Attributes:
        stage: where the simulated cell stands.
    """

    def __init__(self, folder: Path, pace: Pace, patience: float = HUNG) -> None:
        """Not listening yet.

        Args:
            folder: the data folder.
            pace: of the world's time.
            patience: a controller that has said nothing for so long is gone [s of wall time].
        """
        self.stage = Stage()
        self._folder, self._pace, self._patience = folder, pace, patience
        self._link: Link | None = None
        self._working: set[asyncio.Task[None]] = set()
        self._meetings: dict[asyncio.Task[None], asyncio.StreamWriter] = {}
        self._over = asyncio.Event()

    def end(self) -> None:
        """The world is to end."""
        self._over.set()

    async def serve(self) -> None:
        """Until somebody ends it; its files go with it.

        Raises:
            DeviceError: another world runs beside this folder.
        """
        socket = socket_in(self._folder)
        with alone(self._folder):
            socket.unlink(missing_ok=True)
            server = await asyncio.start_unix_server(self._comes, socket)
            try:
                socket.chmod(0o600)
                with card(self._folder, socket, self._pace):
                    await self._until_over()
            finally:
                server.close()
                socket.unlink(missing_ok=True)
                await self._hang_up()

    async def _until_over(self) -> None:
        ticking = asyncio.create_task(self._tick())
        over = asyncio.create_task(self._over.wait())
        await asyncio.wait((ticking, over), return_when=asyncio.FIRST_COMPLETED)
        if ticking.done():
            ticking.result()  # a world that does not go on is none
        for task in (ticking, over):
            task.cancel()

    async def _hang_up(self) -> None:
        """Whoever is connected hears that the world has ended."""
        for writer in self._meetings.values():
            writer.close()
        if self._meetings:
            await asyncio.wait(tuple(self._meetings))

    async def _tick(self) -> None:
        """The world goes on whether or not somebody works in it."""
        rate, last = self._pace.rate, time.monotonic()
        while True:
            await asyncio.sleep(rate * min(max(SENSED / rate, OFTEN), SELDOM))
            now = time.monotonic()
            self._go_on(min(now - last, HEARD))
            last = now

    def _go_on(self, listened: float) -> None:
        state, trouble = self.stage.sensed()
        link = self._link
        if link is None:
            return
        link.silence += listened
        if link.silence > self._patience:
            self.stage.halt(SILENT)
        link.tell(state, trouble)

    def _comes(self, reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
        task = asyncio.create_task(self._meet(reader, writer))
        self._meetings[task] = writer
        task.add_done_callback(self._meetings.pop)

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
        if self._link is not None:
            return f"another controller commands this world, process {self._link.pid}"
        return None

    async def _work_for(
        self,
        reader: asyncio.StreamReader,
        writer: asyncio.StreamWriter,
        first: m.Request,
        decoder: "msgspec.msgpack.Decoder[m.Request]",
    ) -> None:
        pid = first.call.pid if isinstance(first.call, m.Hello) else 0
        link = self._link = Link(pid, writer)
        pace, (state, _) = self._pace, self.stage.sensed()
        welcome = m.Welcome(
            pace.rate, pace.start, pace.origin, self.stage.built, lag_of_this_loop()
        )
        link.say(m.Reply(first.number, msgspec.msgpack.encode(welcome), state=state))
        try:
            while True:  # until it goes, or the world hangs up, when its files are gone
                request = await received(reader, decoder)
                link.silence = 0.0
                self._take(link, request)
        finally:
            self._let_go()

    def _take(self, link: Link, request: m.Request) -> None:
        match request.call:
            case m.Beat():
                return
            case m.Halt(reason):
                self.stage.halt(reason)
            case m.Limit(speed):
                self.stage.limit(speed)
            case m.Shutdown():
                self.end()
            case call:
                # Taken on at once: a halt that comes right behind a motion is for it.
                doing = self.stage.takes_on(call)
                task = asyncio.create_task(self._reply(link, request.number, doing))
                self._working.add(task)
                task.add_done_callback(self._working.discard)

    async def _reply(self, link: Link, number: int, doing: Awaitable[object]) -> None:
        """To the controller that has called; if it has gone by then, to nobody."""
        with suppress(DepalError, ConnectionError):
            link.say(await done(self.stage, number, doing))

    def _let_go(self) -> None:
        """The arm comes to rest where it is; what people do, and the valves, are not touched."""
        self._link = None
        self.stage.halt(SILENT)
