"""Where a world is found: one beside each data folder, with a card that says who it is."""

import fcntl
import hashlib
import json
import os
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from depal.errors import DeviceError
from depal.executive.clock import Pace
from depal.ports.wire import messages as m

SOCKET, CARD = "world.sock", "world.json"
"""In the data folder: where the world listens, and who it is."""

LONGEST = 100
"""The system takes no longer name for a socket [byte]."""


def socket_in(folder: Path) -> Path:
    """Where the world of a data folder listens; beside other temporary files for a deep one."""
    socket = (folder / SOCKET).resolve()
    if len(os.fsencode(socket)) <= LONGEST:
        return socket
    digest = hashlib.sha256(os.fsencode(socket)).hexdigest()[:24]
    return Path(tempfile.gettempdir()) / f"depal-{digest}.sock"


@contextmanager
def alone(folder: Path) -> Iterator[None]:
    """The only world beside a folder; the kernel lets go of it with the process.

    Raises:
        DeviceError: another world runs there.
    """
    handle = os.open(folder, os.O_RDONLY | os.O_CLOEXEC)
    try:
        fcntl.flock(handle, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError:
        os.close(handle)
        raise DeviceError(f"another world runs beside {folder}; expected none") from None
    try:
        yield
    finally:
        os.close(handle)


@contextmanager
def card(folder: Path, socket: Path, pace: Pace) -> Iterator[None]:
    """While this is open the folder says who the world is; written at once or not at all."""
    body = {
        "pid": os.getpid(),
        "socket": str(socket),
        "version": m.VERSION,
        "pace": pace.rate,
        "start": pace.start,
        "origin": pace.origin,
    }
    path = folder / CARD
    fresh = path.with_suffix(".new")
    fresh.write_text(json.dumps(body), encoding="utf-8")
    fresh.replace(path)
    try:
        yield
    finally:
        path.unlink(missing_ok=True)
