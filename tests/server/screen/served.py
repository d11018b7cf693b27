"""Serves API and screen over a scripted cell: `python served.py FOLDER STEP [PORT]`.

Prints the first link once it answers, as `depal serve` does.
"""

import socket
import sys
from pathlib import Path

import uvicorn
from argon2 import PasswordHasher
from scripted_cell import ScriptedCell

from depal.app.serve.feed import Feed
from depal.app.serve.recording import Recorder
from depal.logistics.store import Database
from depal.server.api import Exposure, build_app
from depal.server.chance import SystemChance
from depal.server.screen import attach
from depal.server.site import Site


def site_in(
    folder: Path, step: float, hasher: PasswordHasher | None = None, *, patient: bool = False
) -> Site:
    """A site over a scripted cell, with nobody in it."""
    database, chance = Database(f"sqlite:///{folder / 'store.db'}"), SystemChance()
    cell = ScriptedCell(step, patient=patient)
    cell.records = Recorder(database, chance)
    return Site.over(database, cell, Feed(folder / "runs"), chance, folder / "runs", hasher)


class Announcing(uvicorn.Server):
    """Says where it is once it answers."""

    code = ""

    async def startup(self, sockets: list[socket.socket] | None = None) -> None:
        """Listens, then says so."""
        await super().startup(sockets)
        port = self.servers[0].sockets[0].getsockname()[1]
        print(f"http://127.0.0.1:{port}/first?code={self.code}", flush=True)  # noqa: T201


def main(folder: Path, step: float, port: int) -> None:
    """Serves until it is ended."""
    site, exposure = site_in(folder, step, patient=True), Exposure()
    app = build_app(site, exposure)
    attach(app, site, exposure)
    server = Announcing(uvicorn.Config(app, "127.0.0.1", port, log_level="warning"))
    server.code = site.codes.make()
    server.run()


if __name__ == "__main__":
    main(Path(sys.argv[1]), float(sys.argv[2]), int(sys.argv[3]) if len(sys.argv) > 3 else 0)
