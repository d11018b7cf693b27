"""How messages become bytes: their length in four bytes and then MessagePack.

Nothing that is received is run: what does not fit a message's types closes the connection.
"""

import asyncio
import struct
from typing import Any, TypeVar

import msgspec
import numpy as np

from depal.errors import DepalError, DeviceError

LARGEST = 64 * 2**20
"""A longer message is refused [byte]."""

HEAD = struct.Struct(">I")

M = TypeVar("M")


class Table(msgspec.Struct, frozen=True):
    """An array of numbers: little-endian, row-major."""

    kind: str
    shape: tuple[int, ...]
    body: bytes


KINDS = {"u1", "f4", "f8"}
"""Of numbers that are sent."""


def packed(array: Any) -> Table:  # noqa: ANN401 - arrays of several kinds
    """An array as it is sent."""
    little = np.ascontiguousarray(array)
    return Table(little.dtype.str[1:], little.shape, little.tobytes())


def unpacked(table: Table) -> Any:  # noqa: ANN401 - arrays of several kinds
    """An array as it was sent.

    Raises:
        DeviceError: it is none.
    """
    if table.kind not in KINDS:
        raise DeviceError(f"an array of {table.kind!r} came; expected one of {sorted(KINDS)}")
    try:
        flat = np.frombuffer(table.body, dtype=np.dtype("<" + table.kind))
        return flat.reshape(table.shape).copy()
    except ValueError as error:
        raise DeviceError(f"an array came that is none: {error}") from error


def encoded(message: object) -> bytes:
    """A message as it goes over the wire.

    Raises:
        DeviceError: it is too long.
    """
    body = msgspec.msgpack.encode(message)
    if len(body) > LARGEST:
        raise DeviceError(f"a message of {len(body)} bytes; expected at most {LARGEST}")
    return HEAD.pack(len(body)) + body


async def received(reader: asyncio.StreamReader, decoder: "msgspec.msgpack.Decoder[M]") -> M:
    """The next message.

    Raises:
        DeviceError: what came is none.
        EOFError: the other side has gone.
    """
    try:
        (length,) = HEAD.unpack(await reader.readexactly(HEAD.size))
        if length > LARGEST:
            raise DeviceError(f"a message of {length} bytes; expected at most {LARGEST}")
        body = await reader.readexactly(length)
    except (asyncio.IncompleteReadError, ConnectionError) as error:
        raise EOFError("the other side has gone") from error
    return decoded(body, decoder)


def decoded(body: bytes, decoder: "msgspec.msgpack.Decoder[M]") -> M:
    """The message that these bytes are.

    Raises:
        DeviceError: they are none: other types, text that is none, values that nothing can have.
    """
    try:
        return decoder.decode(body)
    except (msgspec.MsgspecError, DepalError, ValueError, RecursionError) as error:
        raise DeviceError(f"what came is no message: {error}") from error
