"""Serves API and screen over a scripted cell: `python served.py FOLDER PORT STEP`.

Prints the first link once it answers, as `depal serve` does.
"""

import sys
from pathlib import Path

import uvicorn
from scripted_cell import ScriptedCell

from depal.app.serve.feed import Feed
from depal.app.serve.recording import Recorder
from depal.logistics.store import Database
from depal.server.api import Exposure, build_app
from depal.server.chance import SystemChance
from depal.server.screen import attach
from depal.server.site import Site


def site_in(folder: Path, step: float) -> Site:
    """A site over a scripted cell, with nobody in it."""
    database, chance = Database(f"sqlite:///{folder / 'store.db'}"), SystemChance()
    cell = ScriptedCell(step)
    cell.records = Recorder(database, chance)
    return Site.over(database, cell, Feed(folder / "runs"), chance, folder / "runs")


def main(folder: Path, port: int, step: float) -> None:
    """Serves until it is ended."""
    site, exposure = site_in(folder, step), Exposure()
    app = build_app(site, exposure)
    attach(app, site, exposure)
    code = site.codes.make()
    print(f"http://127.0.0.1:{port}/first?code={code}", flush=True)  # noqa: T201 - it is a command
    uvicorn.run(app, host="127.0.0.1", port=port, log_level="warning")


if __name__ == "__main__":
    main(Path(sys.argv[1]), int(sys.argv[2]), float(sys.argv[3]))
