"""`python -m depal.simulation.process FOLDER PACE START`: a world until somebody ends it."""

import asyncio
import os
import signal
import sys
from pathlib import Path

from depal.errors import DepalError
from depal.executive.clock import Pace, run_paced
from depal.simulation.process.server import WorldServer


def main(folder: str, rate: str, start: str) -> None:
    """Serves a world from a data folder."""
    os.umask(0o077)  # nobody else may open its socket or read its card
    pace = Pace.from_now(float(rate), float(start))

    async def serve() -> None:
        server = WorldServer(Path(folder), pace)
        for number in (signal.SIGTERM, signal.SIGINT):
            asyncio.get_running_loop().add_signal_handler(number, server.end)
        await server.serve()

    try:
        run_paced(serve(), pace)
    except DepalError as error:
        sys.exit(str(error))


if __name__ == "__main__":
    main(*sys.argv[1:])
