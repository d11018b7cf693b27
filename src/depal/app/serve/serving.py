"""`depal serve`: world, cell, store and screen, begun and ended in order."""

import asyncio
import logging
import signal
import socket
import sys
from collections.abc import Callable, Coroutine
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import uvicorn

from depal.app.run.inputs import cell_of, one_of
from depal.app.run.tasks import tasks_of
from depal.app.run.values import CAMERA, PERCEPTIONS
from depal.app.serve.feed import Feed
from depal.app.serve.host import Host
from depal.app.serve.means import Means
from depal.app.serve.outside import World
from depal.app.serve.recording import Recorder, RunStore
from depal.drivers.remote import connect, start_world
from depal.drivers.remote.finding import Card, card_of
from depal.errors import SettingError
from depal.executive.clock import Clock, run_paced
from depal.logistics.store import Database, LocalStore
from depal.ports import StoreSystem
from depal.server.api import Exposure, build_app
from depal.server.cell import Order
from depal.server.chance import SystemChance
from depal.server.records import KeptSettings, Queue, Requests, Runs
from depal.server.screen import attach
from depal.server.site import Site

STORE = "store.db"

RUNS = "runs"

LINGER = 3.0
"""After a signal connections that are open get so long to end [s]."""

TURN = 0.001
"""Threads that compute give way to those that answer after so long [s]."""

FASTEST = 50.0
"""The greatest pace of a simulated world."""


@dataclass(frozen=True, slots=True)
class Serving:
    """What `depal serve` was asked for.

    Attributes:
        cell: a cell file or the name of one that ships.
        folder: where everything is kept.
        url: of the store's database; "" for a file in the folder.
        host: the address to listen at.
        port: and the port; 0 for any.
        names: by which browsers may ask for it, beside this machine's own.
        secure: whether a proxy before it speaks TLS with the browsers.
        perception: where boxes come from.
        severity: how far simulated cameras and boxes are from ideal.
        pace: seconds of the simulated world per second.
        tasks: task files in place of the shipped ones.
    """

    cell: str = "default"
    folder: Path = Path("depal-data")
    url: str = ""
    host: str = "127.0.0.1"
    port: int = 8080
    names: tuple[str, ...] = ()
    secure: bool = False
    perception: str = CAMERA
    severity: str = "normal"
    pace: float = 1.0
    tasks: tuple[str, ...] = ()


class Service:
    """Everything that runs under `depal serve`; tests use it as well.

    Attributes:
        site: for the use cases.
        host: of the cell.
        app: of the web server.
    """

    def __init__(self, serving: Serving) -> None:
        """Reads and opens what is needed; nothing runs yet.

        Raises:
            InputError: something that was given cannot be used.
        """
        layout = cell_of(serving.cell)
        tasks = tasks_of(serving.tasks, layout) if serving.tasks else None
        perception = one_of("--perception", serving.perception, PERCEPTIONS)
        if not 0.0 < serving.pace <= FASTEST:
            raise SettingError("--pace", f"{serving.pace!r}", f"more than 0, at most {FASTEST}")
        if serving.host not in {"127.0.0.1", "localhost", "::1"} and not serving.secure:
            raise SettingError(
                "--host",
                f"{serving.host} can be reached from outside, and nothing is encrypted",
                "127.0.0.1, or --secure with a proxy before it that speaks TLS",
            )
        self._serving = serving
        if not serving.url:
            serving.folder.mkdir(parents=True, exist_ok=True)
        self._database = Database(serving.url or f"sqlite:///{serving.folder / STORE}")
        serving.folder.mkdir(parents=True, exist_ok=True)
        self._chance = SystemChance()
        self._feed = Feed(serving.folder / RUNS)
        self._card: Card | None = None
        means = Means(
            layout,
            serving.folder,
            self._connect,
            self._store,
            lambda: Recorder(self._database, self._chance),
            self._run_loop,
            perception=perception,
            severity=serving.severity,
            wrote=self._feed.wrote,
            tasks=tasks,
        )
        settings = KeptSettings(self._database).get().settings
        self.host = Host(means, settings, self._unfinished())
        self.site = Site.over(
            self._database, self.host, self._feed, self._chance, serving.folder / RUNS
        )
        self._keep_what_the_cell_has()
        names = frozenset(serving.names)
        exposure = Exposure(names, serving.secure)
        self.app = build_app(self.site, exposure)
        attach(self.app, self.site, exposure)

    def _keep_what_the_cell_has(self) -> None:
        self.site.store.keep_places(self.host.layout.places.values())

    def _unfinished(self) -> Order | None:
        """The run in the middle of which an earlier controller has ended."""
        run = Runs(self._database, self._chance).unfinished()
        if run is None:
            return None
        _, delivery = Queue(self._database, self._chance).get(run.delivery)
        Recorder(self._database, self._chance).dropped(run.number)
        card = card_of(self._serving.folder)
        now = 0.0 if card is None else card.pace.now()
        return Order(
            run.number, delivery, Requests(self._database, self._chance).waiting(run.number, now)
        )

    def _store(self, run: int) -> StoreSystem:
        return RunStore(LocalStore(self._database), run)

    def open(self) -> None:
        """Finds or starts the world, and the cell's thread.

        Raises:
            DepalError: one of them does not start.
        """
        folder = self._serving.folder
        self._card = card_of(folder) or start_world(folder, self._serving.pace)
        self.host.open()

    def _run_loop(self, work: Callable[[], Coroutine[Any, Any, None]]) -> None:
        if self._card is not None:
            run_paced(work(), self._card.pace)

    async def _connect(self, clock: Clock) -> World:
        del clock
        return await connect(self._serving.folder, len(self.host.layout.cameras))

    def shut(self) -> None:
        """Ends the cell and its world."""
        self.host.shut()
        self._database.close()

    def first_link(self, port: int) -> str | None:
        """The link with the one-time code, while there is nobody yet."""
        if self.site.accounts.any:
            return None
        scheme = "https" if self._serving.secure else "http"
        name = self._serving.names[0] if self._serving.names else self._serving.host
        return f"{scheme}://{name}:{port}/first?code={self.site.codes.make()}"


def serve(serving: Serving, say: Callable[[str], None]) -> None:
    """Runs until a signal ends it; then the world ends as well.

    Args:
        serving: what was asked for.
        say: told where the screen is.

    Raises:
        InputError: something that was given cannot be used.
        DepalError: the world or the cell does not start.
    """
    sys.setswitchinterval(TURN)
    listening = listen_at(serving.host, serving.port)
    service = Service(serving)
    # The web server ends on these signals and then raises them again, for whoever waits: for us
    # they are over by then, and cell and world end in order.
    for number in (signal.SIGTERM, signal.SIGINT):
        signal.signal(number, lambda *_: None)
    service.open()
    try:
        asyncio.run(_serve(service, serving, listening, say))
    finally:
        service.shut()
        listening.close()


def listen_at(host: str, port: int) -> socket.socket:
    """A socket that listens; what is written to those who come goes out at once.

    The event loop would not see to that by itself for a socket that it has not made: small answers
    would then wait for the other side's delayed acknowledgement, about 40 ms.

    Raises:
        SettingError: it cannot, for instance because somebody else does.
    """
    family = socket.AF_INET6 if ":" in host else socket.AF_INET
    try:
        listening = socket.create_server((host, port), family=family)
    except OSError as error:
        what = f"nobody can listen at {host}:{port}: {error.strerror}"
        raise SettingError("--port", what, "a free port, or 0 for any") from error
    listening.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
    return listening


async def _serve(
    service: Service, serving: Serving, listening: socket.socket, say: Callable[[str], None]
) -> None:
    config = uvicorn.Config(
        service.app,
        log_level=logging.WARNING,
        timeout_graceful_shutdown=int(LINGER),
        server_header=False,
        proxy_headers=serving.secure,
    )
    server = uvicorn.Server(config)
    loop = asyncio.get_running_loop()
    running = loop.create_task(server.serve([listening]))
    while not server.started and not running.done():  # noqa: ASYNC110 - it tells nobody
        await asyncio.sleep(0.02)
    if server.started:
        port = listening.getsockname()[1]
        link = service.first_link(port)
        scheme = "https" if serving.secure else "http"
        say(link or f"{scheme}://{serving.host}:{port}/")
    with suppress(asyncio.CancelledError):
        await running
