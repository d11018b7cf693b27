"""Desks over a cell alone: queue, people and names in memory, for the browser test."""

import itertools
from collections.abc import Callable, Sequence
from dataclasses import replace
from pathlib import Path

from depal.domain import BoxId, CellLayout, Delivery, Gtin, Product, Request
from depal.errors import DepalError, InputError
from depal.logistics import shipped_deliveries
from depal.logistics.delivery_csv import delivery_of_csv
from depal.logistics.delivery_json import deliveries_of_json
from depal.server.cell import Cell, Order, Refusal, Settings
from depal.server.cellstate import CellState
from depal.server.roles import Principal, Role
from depal.server.screen.desk import Person, Refused, Run, Token, Waiting


class Memory:
    """What all desks share."""

    def __init__(self, cell: Cell, records: Path | None = None) -> None:
        """An empty queue."""
        self.cell, self.records = cell, records
        self.queue: list[tuple[Waiting, Delivery]] = []
        self.numbers = itertools.count(1)
        self.people: list[Person] = []
        self.passwords: dict[str, str] = {}
        self.tokens: list[Token] = []
        self.known: dict[Gtin, Product] = {}
        self.pictures: dict[str, bytes] = {}


class MemoryDesk:
    """See `depal.server.screen.desk.Desk`."""

    def __init__(self, shared: Memory, who: Principal) -> None:
        """For one person."""
        self._shared, self.who = shared, who

    @property
    def layout(self) -> CellLayout:
        return self._shared.cell.layout

    def state(self) -> CellState:
        return self._shared.cell.state()

    def picture(self) -> bytes:
        return self._shared.cell.picture()

    def deliveries(self) -> Sequence[Waiting]:
        return [waiting for waiting, _ in self._shared.queue if waiting.state != "cancelled"]

    def upload(self, name: str, content: bytes) -> Sequence[Waiting]:
        try:
            text = content.decode("utf-8")
            if name.lower().endswith(".csv"):
                return self._queue([delivery_of_csv(text, name[:-4], name)])
            return self._queue(deliveries_of_json(text, name))
        except UnicodeDecodeError as error:
            raise Refused(f"{name}: is no text") from error
        except InputError as error:
            raise Refused(str(error), [str(problem) for problem in error.problems]) from error

    def sample(self) -> Sequence[Waiting]:
        return self._queue(shipped_deliveries()[:1])

    def _queue(self, found: Sequence[Delivery]) -> Sequence[Waiting]:
        for delivery in found:
            boxes = sum(line.count for line in delivery.lines)
            number = str(next(self._shared.numbers))
            waiting = Waiting(number, delivery.id, boxes, self.who.name)
            self._shared.queue.append((waiting, delivery))
            self._shared.known.update(delivery.products)
        return self.deliveries()

    def move_delivery(self, delivery: str, steps: int) -> None:
        queue = self._shared.queue
        place = self._place(delivery)
        queue.insert(max(place + steps, 0), queue.pop(place))

    def cancel_delivery(self, delivery: str) -> None:
        self._become(self._place(delivery), "cancelled")

    def _place(self, delivery: str) -> int:
        for place, (waiting, _) in enumerate(self._shared.queue):
            if waiting.id == delivery and waiting.state == "queued":
                return place
        raise Refused("this delivery is in the queue no more")

    def _become(self, place: int, state: str) -> None:
        waiting, delivery = self._shared.queue[place]
        self._shared.queue[place] = (replace(waiting, state=state), delivery)

    def start(self, delivery: str | None) -> None:
        if delivery is None:
            self._ask(lambda: self._shared.cell.start())
            return
        place = self._place(delivery)
        order = Order(next(self._shared.numbers), self._shared.queue[place][1])
        self._ask(lambda: self._shared.cell.start(order))
        self._become(place, "running")

    def hold(self) -> None:
        self._ask(lambda: self._shared.cell.hold(self.who.name))

    def resume(self) -> None:
        self._ask(lambda: self._shared.cell.resume(self.who.name))

    def stop_after_box(self) -> None:
        self._ask(lambda: self._shared.cell.stop_after_box(self.who.name))

    def answer(self, question: str, choice: str) -> None:
        self._ask(lambda: self._shared.cell.answer(question, choice, self.who.name))

    def products(self) -> Sequence[Product]:
        return sorted(self._shared.known.values(), key=lambda product: product.name)

    def put_product(self, product: Product) -> None:
        self._shared.known[product.gtin] = product

    def product_picture(self, gtin: str) -> bytes:
        return self._shared.pictures.get(gtin, b"")

    def put_picture(self, gtin: str, content: bytes) -> None:
        if content[:4] not in {b"\x89PNG"} and content[:2] != b"\xff\xd8":
            raise Refused("this is neither a PNG nor a JPEG picture")
        self._shared.pictures[gtin] = content

    def add_request(
        self, gtin: str | None, box: str | None, priority: float, minutes: float | None
    ) -> None:
        now = self.state().at
        due = None if minutes is None else now + 60 * minutes
        try:
            request = Request(
                priority, Gtin(gtin) if gtin else None, BoxId(box) if box else None, now, due
            )
        except DepalError as error:
            raise Refused(str(error)) from error
        key = f"r{next(self._shared.numbers)}"
        self._ask(lambda: self._shared.cell.add_request(key, request))

    def change_request(self, key: str, priority: float, minutes: float | None) -> None:
        state = self.state()
        found = next((request for request in state.requests if request.key == key), None)
        if found is None:
            raise Refused("this request has been served or cancelled already")
        due = None if minutes is None else state.at + 60 * minutes
        request = Request(
            priority,
            Gtin(found.gtin) if found.gtin else None,
            BoxId(found.box) if found.box else None,
            found.waits,
            due,
        )
        self._ask(lambda: self._shared.cell.change_request(key, request))

    def cancel_request(self, key: str) -> None:
        self._ask(lambda: self._shared.cell.cancel_request(key))

    def runs(self) -> Sequence[Run]:
        records = self._shared.records
        if records is None:
            return []
        folders = sorted((path for path in records.iterdir() if path.is_dir()), reverse=True)
        return [Run(int(path.name), "dev-000", "done", "", None, None) for path in folders]

    def record(self, number: int) -> Path:
        if self._shared.records is None:
            raise Refused(f"there is no run {number}")
        return self._shared.records / str(number)

    def settings(self) -> Settings:
        state = self.state()
        return Settings(state.w, state.speed, state.policy)

    def put_settings(self, settings: Settings) -> None:
        self._ask(lambda: self._shared.cell.set(settings))

    def people(self) -> Sequence[Person]:
        return self._shared.people

    def add_person(self, name: str, role: Role, password: str) -> None:
        if len(password) < 8:
            raise Refused("a password has at least 8 letters")
        if any(person.name == name for person in self._shared.people):
            raise Refused(f"there is somebody called {name} already")
        self._shared.people.append(Person(name, role))
        self._shared.passwords[name] = password

    def change_role(self, name: str, role: Role) -> None:
        self._shared.people = [
            replace(person, role=role) if person.name == name else person
            for person in self._shared.people
        ]

    def set_password(self, name: str, password: str) -> None:
        if len(password) < 8:
            raise Refused("a password has at least 8 letters")

    def remove_person(self, name: str) -> None:
        self._shared.people = [each for each in self._shared.people if each.name != name]

    def tokens(self) -> Sequence[Token]:
        return self._shared.tokens

    def add_token(self, name: str, days: int) -> str:
        self._shared.tokens.append(Token(str(next(self._shared.numbers)), name, f"{days} d"))
        return "not-a-real-token"

    def revoke_token(self, token: str) -> None:
        self._shared.tokens = [each for each in self._shared.tokens if each.id != token]

    def _ask(self, command: Callable[[], None]) -> None:
        try:
            command()
        except Refusal as refusal:
            raise Refused(str(refusal)) from refusal
