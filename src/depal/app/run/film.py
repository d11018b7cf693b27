"""The cell at moments of a run, for its pictures."""

import asyncio
from collections.abc import Callable, Iterator
from pathlib import Path

from depal.app.pictures import CellPainter, save_animation, save_picture
from depal.simulation.cell import SimulatedCell
from depal.simulation.snapshot import Snapshot

PERIOD = 1.0
"""Simulated time between two moments [s]."""

MOMENTS = 240
"""A film has at most about so many; longer runs are thinned."""

FPS = 12.0

PICTURE, ANIMATION = "picture.png", "run.gif"

STILL = (1200, 900)
"""Width and height of the final picture [pixel]."""

Progress = Callable[[int, int], None]


class Film:
    """Takes a snapshot every second of simulated time."""

    def __init__(self, cell: SimulatedCell, caption: Callable[[], str]) -> None:
        """Of a cell, with what is to be written below each picture."""
        self._cell = cell
        self._caption = caption
        self._moments: list[tuple[Snapshot, str]] = []
        self._every, self._skipped = 1, 0

    async def record(self) -> None:
        """Goes on until it is cancelled."""
        while True:
            self.take()
            await asyncio.sleep(PERIOD)

    def take(self) -> None:
        """One moment, now; where there are too many, every second one is forgotten."""
        self._skipped += 1
        if self._skipped < self._every:
            return
        self._skipped = 0
        self._cell.world.advance(asyncio.get_running_loop().time())
        self._moments.append((self._cell.world.snapshot(), self._caption()))
        if len(self._moments) > MOMENTS:
            self._moments = self._moments[::2]
            self._every *= 2

    def save(self, folder: Path, progress: Progress) -> None:
        """Draws the last moment as a picture, and all of them as an animation.

        Args:
            folder: where to.
            progress: told how many moments are drawn, of how many.
        """
        painter = CellPainter(self._cell.world.layout, self._cell.world.cases)
        last, caption = self._moments[-1]
        save_picture(folder / PICTURE, painter.picture(last, caption, STILL))

        save_animation(folder / ANIMATION, painter, self._told(progress), fps=FPS)

    def _told(self, progress: Progress) -> Iterator[tuple[Snapshot, str]]:
        """The moments, one by one, with progress."""
        for number, moment in enumerate(self._moments):
            progress(number, len(self._moments))
            yield moment
        progress(len(self._moments), len(self._moments))
