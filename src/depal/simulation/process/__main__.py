"""`python -m depal.simulation.process FOLDER PACE START`: a world until somebody ends it."""

import sys
from pathlib import Path

from depal.executive.clock import Pace, run_paced
from depal.simulation.process.server import WorldServer


def main(folder: str, rate: str, start: str) -> None:
    """Serves a world from a data folder."""
    pace = Pace.from_now(float(rate), float(start))

    async def serve() -> None:
        await WorldServer(Path(folder), pace).serve()

    run_paced(serve(), pace)


if __name__ == "__main__":
    main(*sys.argv[1:])
