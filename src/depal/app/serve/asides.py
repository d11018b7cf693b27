"""Boxes that were set aside: a person is asked to take each, and its spot is free again."""

import asyncio
from collections.abc import Callable, Iterable

from depal.app.run.assembly import Assembly
from depal.app.serve.person import ScreenPerson
from depal.cell.departures import Departure, Fate
from depal.cell.ledger import Page
from depal.domain import BoxId
from depal.ports import TAKEN, Question


class Asides:
    """Asks for what was set aside, box by box; the cell does not wait for the answers."""

    def __init__(self, wired: Assembly, person: ScreenPerson, changed: Callable[[], None]) -> None:
        """Nobody has been asked.

        Args:
            wired: the run.
            person: who is asked.
            changed: called when a box was taken away.
        """
        self._wired, self._person, self._changed = wired, person, changed
        self._tasks: set[asyncio.Task[None]] = set()
        self._told: set[BoxId] = set()

    def recall(self, page: Page) -> None:
        """After a restart: what still stands where it was set aside is asked about anew."""
        kept = {each.standing.id for each in page.kept}
        self._told = {
            departure.box
            for departure in page.departures
            if departure.fate is not Fate.SET_ASIDE or departure.box not in kept
        }

    def ask(self, departures: Iterable[Departure]) -> None:
        """Asks for those that were set aside and have not been asked for."""
        for departure in departures:
            if departure.fate is Fate.SET_ASIDE and departure.box not in self._told:
                self._told.add(departure.box)
                task = asyncio.get_running_loop().create_task(self._cleared(departure))
                self._tasks.add(task)
                task.add_done_callback(self._tasks.discard)

    def close(self) -> None:
        """Nobody is asked any more."""
        for task in self._tasks:
            task.cancel()

    async def _cleared(self, departure: Departure) -> None:
        promises, place = self._wired.desk.promises, departure.place
        solid = None if place is None else promises.standing(departure.box, place)
        question = Question(
            f"aside/{departure.box}",
            f"Box {departure.box} was set aside: {departure.reason}. Please take it away.",
            (TAKEN,),
            str(departure.box),
            None if solid is None else solid.centre,
            departure.gtin,
        )
        await self._person.ask(question, blocks=False)
        promises.gone(departure.box)
        self._wired.work.keep()
        self._changed()
