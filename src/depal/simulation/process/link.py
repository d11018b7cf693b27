"""The line to the controller that commands the world, as the world sees it."""

import asyncio
import time

from depal.errors import DeviceError
from depal.ports.wire import messages as m
from depal.ports.wire.codec import encoded

REST = 0.5
"""While nothing changes the sensors are told so often [s of wall time]."""

BEHIND = 2**18
"""Who has not read so much yet is not told what the sensors say now [byte]."""


class Link:
    """One controller.

    Attributes:
        pid: of its process.
        silence: how long it has said nothing, of the time in which it could be heard [s].
    """

    def __init__(self, pid: int, writer: asyncio.StreamWriter) -> None:
        """Nothing was said yet."""
        self.pid, self.silence = pid, 0.0
        self._writer = writer
        self._told: tuple[m.Reply | None, float] = (None, 0.0)

    def say(self, reply: m.Reply) -> None:
        """A reply; one that is too long is told as an error, and to nobody once it has gone."""
        if self._writer.is_closing():
            return
        try:
            data = encoded(reply)
        except DeviceError as error:
            data = encoded(m.Reply(reply.number, error=str(error)))
        self._writer.write(data)

    def tell(self, state: m.State | None, trouble: str | None) -> None:
        """What the sensors say, where that has changed or was told long ago.

        Args:
            state: of the sensors; None while nothing is built.
            trouble: why there is no state, where there should be one.
        """
        news, (told, at), now = m.Reply(0, error=trouble, state=state), self._told, time.monotonic()
        if state is None and trouble is None:
            return
        if told is not None and now - at < REST and not _differ(news, told):
            return
        if self._writer.transport.get_write_buffer_size() < BEHIND:
            self._told = (news, now)
            self.say(news)


def _differ(news: m.Reply, told: m.Reply) -> bool:
    """Whether anything but the time has changed."""
    one, other = news.state, told.state
    if one is None or other is None:
        return news != told
    names = (name for name in one.__struct_fields__ if name != "at")
    return any(getattr(one, name) != getattr(other, name) for name in names)
