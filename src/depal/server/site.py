"""Everything that the use cases work with: the cell, the store's data, people, time."""

from dataclasses import dataclass
from pathlib import Path
from typing import Self

from argon2 import PasswordHasher

from depal.logistics.store import Database, LocalStore
from depal.server.cell import Cell
from depal.server.chance import Chance
from depal.server.events import Events
from depal.server.people import Accounts, AuditLog, Codes, Limits, Sessions, Tokens
from depal.server.records import (
    KeptSettings,
    Pictures,
    Products,
    Questions,
    Queue,
    Repeats,
    Requests,
    Runs,
)


@dataclass(frozen=True, slots=True)
class Site:
    """The store's side of one cell.

    Attributes:
        cell: behind its protocol.
        folder: of the runs' records.
        store: products, places, stock.
        chance: time and secrets.
        events: of the journal.
        accounts: people.
        sessions: who is signed in.
        tokens: of services.
        codes: of the first start.
        limits: against guessing.
        audit: of every command.
        queue: of deliveries.
        runs: what became of them.
        questions: to people.
        requests: what is wanted.
        pictures: of products.
        repeats: of requests with a key.
        settings: of the cell.
        products: and who may change them when.
    """

    cell: Cell
    folder: Path
    store: LocalStore
    chance: Chance
    events: Events
    accounts: Accounts
    sessions: Sessions
    tokens: Tokens
    codes: Codes
    limits: Limits
    audit: AuditLog
    queue: Queue
    runs: Runs
    questions: Questions
    requests: Requests
    pictures: Pictures
    repeats: Repeats
    settings: KeptSettings
    products: Products

    @classmethod
    def over(
        cls,
        database: Database,
        cell: Cell,
        events: Events,
        chance: Chance,
        folder: Path,
        hasher: PasswordHasher | None = None,
    ) -> Self:
        """A site over a database.

        Args:
            database: of the store.
            cell: that works for it.
            events: of its journal.
            chance: time and secrets.
            folder: of the runs' records.
            hasher: of passwords; None for the usual cost.
        """
        return cls(
            cell,
            folder,
            LocalStore(database),
            chance,
            events,
            Accounts(database, chance, hasher or PasswordHasher()),
            Sessions(database, chance),
            Tokens(database, chance),
            Codes(database, chance),
            Limits(chance),
            AuditLog(database, chance),
            Queue(database, chance),
            Runs(database, chance),
            Questions(database),
            Requests(database, chance),
            Pictures(database, chance),
            Repeats(database, chance),
            KeptSettings(database),
            Products(database),
        )
