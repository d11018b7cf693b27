"""What a host has to say, written into the store's data: each thing once, however often told."""

from depal.app.serve.outside import Records
from depal.cell.stock import movement_id
from depal.domain import Gtin, PlaceId
from depal.logistics.store import Database, LocalStore
from depal.ports import Movement
from depal.server.cellstate import QuestionState
from depal.server.chance import Chance
from depal.server.records import Questions, Requests, Runs


class Recorder(Records):
    """Over the store's database."""

    def __init__(self, database: Database, chance: Chance) -> None:
        """Writes with a connection of its own."""
        self._questions = Questions(database)
        self._requests = Requests(database, chance)
        self._runs = Runs(database, chance)

    def asked(self, run: int, question: QuestionState) -> None:
        """A question was asked."""
        self._questions.asked(run, question)

    def answered(self, question: str, choice: str, by: str, at: float) -> None:
        """It was answered."""
        self._questions.answered(question, choice, by, at)

    def request_ended(self, key: str, *, served: bool, at: float, reason: str) -> None:
        """A request has ended."""
        self._requests.end(key, served=served, at=at, reason=reason)

    def run_ended(self, run: int, state: str, at: float, result: dict[str, object]) -> None:
        """A run is over, and its delivery with it."""
        self._runs.end(run, state, result, at)

    def dropped(self, run: int) -> None:
        """What a controller has asked that is gone: the next one asks anew."""
        self._questions.drop(run)


class RunStore:
    """The store's system for one run: its movements carry the number of the run."""

    def __init__(self, store: LocalStore, run: int) -> None:
        """Over the store's data."""
        self._store, self._run = store, run

    async def places_for(self, gtin: Gtin) -> tuple[PlaceId, ...]:
        """Where a product belongs, best first."""
        return await self._store.places_for(gtin)

    async def moved(self, movement: Movement) -> None:
        """Takes note of a case that was put away; told twice, it counts once."""
        name = f"{self._run}/{movement_id(movement.box, movement.place)}"
        self._store.note(Movement(name, movement.box, movement.gtin, movement.place, movement.at))
