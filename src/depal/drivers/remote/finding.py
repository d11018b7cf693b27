"""The world that runs beside a data folder, or a new one."""

import json
import os
import socket
import sys
import time
from dataclasses import dataclass
from pathlib import Path

from depal.drivers.remote.line import Line
from depal.drivers.remote.world import RemoteWorld
from depal.errors import DeviceError
from depal.executive.clock import Pace

CARD, LOG = "world.json", "world.log"

PATIENCE = 60.0
"""A world that does not listen by then has failed to start [s]."""


@dataclass(frozen=True, slots=True)
class Card:
    """Who a world is.

    Attributes:
        pid: of its process.
        socket: where it listens.
        pace: of its time.
    """

    pid: int
    socket: Path
    pace: Pace

    @property
    def lives(self) -> bool:
        """Whether that process is there."""
        try:
            os.kill(self.pid, 0)
        except ProcessLookupError:
            return False
        except PermissionError:
            return True
        return True


def card_of(folder: Path) -> Card | None:
    """The world that runs beside a data folder; None where none does.

    A card outlives a world that was killed, and another process may have its number by now.
    """
    try:
        body = json.loads((folder / CARD).read_text(encoding="utf-8"))
        pace = Pace(float(body["pace"]), float(body["start"]), float(body["origin"]))
        card = Card(int(body["pid"]), Path(body["socket"]), pace)
    except (OSError, ValueError, KeyError, TypeError):
        return None
    return card if card.lives and _listens(card.socket) else None


def _listens(path: Path) -> bool:
    with socket.socket(socket.AF_UNIX) as line:
        try:
            line.connect(str(path))
        except OSError:
            return False
    return True


def start_world(folder: Path, rate: float = 1.0, start: float = 0.0) -> Card:
    """Starts a world in a session of its own, so that nothing that ends this process ends it.

    Args:
        folder: the data folder.
        rate: seconds of the world per second.
        start: its time at the beginning [s].

    Raises:
        DeviceError: it did not start, or one runs there already.
    """
    folder.mkdir(parents=True, exist_ok=True)
    other = card_of(folder)
    if other is not None:
        raise DeviceError(f"a world runs beside {folder} already, process {other.pid}")
    command = [sys.executable, "-m", "depal.simulation.process", str(folder), str(rate), str(start)]
    with (folder / LOG).open("ab") as log:
        quiet = (os.POSIX_SPAWN_OPEN, 0, os.devnull, os.O_RDONLY, 0)
        words = [(os.POSIX_SPAWN_DUP2, log.fileno(), number) for number in (1, 2)]
        pid = os.posix_spawn(
            command[0], command, os.environ, file_actions=[quiet, *words], setsid=True
        )
    until = time.monotonic() + PATIENCE
    while time.monotonic() < until:
        card = card_of(folder)
        if card is not None:
            return card
        if os.waitpid(pid, os.WNOHANG)[0] == pid:
            break
        time.sleep(0.02)
    raise DeviceError(
        f"the simulated world did not start; its words are in {folder / LOG}, "
        f"the last of them: {_last_line(folder / LOG)}"
    )


def _last_line(path: Path) -> str:
    lines = path.read_text(encoding="utf-8", errors="replace").splitlines()
    return lines[-1] if lines else "none"


async def connect(folder: Path, cameras: int) -> RemoteWorld:
    """The world that runs beside a data folder.

    Args:
        folder: the data folder.
        cameras: how many the cell has.

    Raises:
        DeviceError: none runs there, or another controller commands it.
    """
    card = card_of(folder)
    if card is None:
        raise DeviceError(f"no world runs beside {folder}")
    line, welcome = await Line.open(card.socket)
    return RemoteWorld(line, welcome, cameras)
