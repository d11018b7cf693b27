"""The line to the world's process: calls with numbers, replies, and the newest state."""

import asyncio
import itertools
import os
import time
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path
from typing import TypeVar

import msgspec

from depal.errors import DeviceError
from depal.executive.clock import PacedLoop
from depal.ports.wire import messages as m
from depal.ports.wire.codec import decoded, encoded, received

T = TypeVar("T")

BEATING = 0.5
"""The world hears so often that the controller is alive [s of wall time]."""

SILENT = 5.0
"""A world that has said nothing for this long is silent [s of wall time]."""

GONE = "the world's process has gone"


class Line:
    """One connection. Used on the event loop that opened it."""

    def __init__(self, reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
        """An open connection over which nothing was said."""
        self._reader, self._writer = reader, writer
        self._numbers = itertools.count(1)
        self._waiting: dict[int, asyncio.Future[bytes]] = {}
        self._heard: list[Callable[[m.State], None]] = []
        self._state: m.State | None = None
        self._tasks: list[asyncio.Task[None]] = []
        self._closed: str | None = None
        self._trouble: str | None = None
        self._last_word = time.monotonic()

    @classmethod
    async def open(cls, socket: Path) -> tuple["Line", m.Welcome]:
        """Connects and says hello.

        Raises:
            DeviceError: nobody listens there, or the world refuses.
        """
        try:
            line = cls(*await asyncio.open_unix_connection(socket))
        except OSError as error:
            raise DeviceError(f"no world listens at {socket}: {error}") from error
        line._tasks.append(asyncio.create_task(line._listen()))
        try:
            welcome = await line.call(m.Hello(m.VERSION, os.getpid()), m.Welcome)
            keep_step(welcome.lag)
        except BaseException:
            await line.close()
            raise
        return line, welcome

    def beat(self, rate: float) -> None:
        """From now on the world hears that the controller is alive."""
        self._tasks.append(asyncio.create_task(self._beat(BEATING * rate)))

    @property
    def state(self) -> m.State:
        """The newest state of the sensors.

        Raises:
            DeviceError: there is none: nothing is built, nothing can be read, or the world has
                gone.
        """
        trouble = self._closed or self._trouble
        if trouble is not None:
            raise DeviceError(trouble)
        if self._state is None:
            raise DeviceError("nothing is built in this world")
        return self._state

    @property
    def heard_at(self) -> float | None:
        """When the world was last heard, in the running loop's time [s]; None for just now.

        A world that draws a picture says nothing meanwhile, and nothing moves in it.
        """
        silent = time.monotonic() - self._last_word
        return None if silent < SILENT else asyncio.get_running_loop().time() - silent

    def listen(self, heard: Callable[[m.State], None]) -> Callable[[], None]:
        """Calls a function with every new state; returns what ends that."""
        self._heard.append(heard)
        return lambda: self._heard.remove(heard)

    async def call(self, call: m.Call, kind: type[T]) -> T:
        """Has the world do something, and waits for what comes of it.

        Args:
            call: what.
            kind: of its result.

        Raises:
            DeviceError: the world cannot do it, or has gone.
        """
        number = next(self._numbers)
        future: asyncio.Future[bytes] = asyncio.get_running_loop().create_future()
        self._waiting[number] = future
        try:
            self._send(m.Request(number, call))
            value = await future
        finally:
            self._waiting.pop(number, None)
        return decoded(value, msgspec.msgpack.Decoder(kind))

    def say(self, call: m.Call) -> None:
        """Tells the world something that it does not reply to.

        Raises:
            DeviceError: the world has gone.
        """
        self._send(m.Request(0, call))

    def _send(self, request: m.Request) -> None:
        if self._closed is not None:
            raise DeviceError(self._closed)
        self._writer.write(encoded(request))

    async def _listen(self) -> None:
        decoder = msgspec.msgpack.Decoder(m.Reply)
        reason = GONE
        try:
            while True:
                self._take(await received(self._reader, decoder))
        except (EOFError, ConnectionError):
            pass
        except DeviceError as error:
            reason = str(error)
        finally:
            self._end(self._trouble or reason)

    def _take(self, reply: m.Reply) -> None:
        self._last_word = time.monotonic()
        if reply.number == 0:
            self._trouble = reply.error
        if reply.state is not None:
            self._state = reply.state
            keep_step(reply.state.lag)
            for heard in tuple(self._heard):
                heard(reply.state)
        future = self._waiting.get(reply.number)
        if future is None or future.done():
            return
        if reply.error is not None:
            future.set_exception(DeviceError(reply.error))
        else:
            future.set_result(reply.value)

    async def _beat(self, every: float) -> None:
        while self._closed is None:
            self.say(m.Beat())
            await asyncio.sleep(every)

    def _end(self, reason: str) -> None:
        self._closed = self._closed or reason
        for future in self._waiting.values():
            if not future.done():
                future.set_exception(DeviceError(reason))

    async def ends(self, seconds: float) -> None:
        """Waits until the world has hung up, but not for longer [s]."""
        await asyncio.wait(self._tasks[:1], timeout=seconds)

    async def close(self) -> None:
        """Hangs up."""
        self._end("the line to the world is closed")
        for task in self._tasks:
            task.cancel()
        await asyncio.gather(*self._tasks, return_exceptions=True)
        self._writer.close()
        with suppress(ConnectionError):
            await self._writer.wait_closed()


def keep_step(lag: float) -> None:
    """The running loop is as late as the world's."""
    loop = asyncio.get_running_loop()
    if isinstance(loop, PacedLoop):
        loop.lag = lag
