"""A desk over a cell alone, until the use cases are there: queue, keys and names in memory."""

import itertools
from collections.abc import Sequence
from dataclasses import replace

from depal.domain import BoxId, CellLayout, Delivery, Gtin, Product, Request
from depal.errors import DepalError
from depal.logistics.delivery_csv import delivery_of_csv
from depal.logistics.delivery_json import deliveries_of_json
from depal.server.cell import Cell, Order, Refusal
from depal.server.cellstate import CellState
from depal.server.roles import Principal, Role
from depal.server.screen.desk import Refused, Waiting


class Interim:
    """What all desks share."""

    def __init__(self, cell: Cell) -> None:
        """An empty queue."""
        self.cell = cell
        self.queue: list[tuple[Waiting, Delivery]] = []
        self.numbers = itertools.count(1)


class InterimDesk:
    """See `depal.server.screen.desk.Desk`."""

    def __init__(self, shared: Interim, who: Principal | None = None) -> None:
        """For one person."""
        self._shared = shared
        self.who = who or Principal("anna", Role.INTEGRATOR)

    @property
    def layout(self) -> CellLayout:
        return self._shared.cell.layout

    def state(self) -> CellState:
        return self._shared.cell.state()

    def deliveries(self) -> Sequence[Waiting]:
        return [waiting for waiting, _ in self._shared.queue]

    def upload(self, name: str, text: str) -> Sequence[Waiting]:
        try:
            if name.lower().endswith(".csv"):
                found: Sequence[Delivery] = [delivery_of_csv(text, name[:-4], name)]
            else:
                found = deliveries_of_json(text, name)
        except DepalError as error:
            raise Refused(str(error)) from error
        for delivery in found:
            boxes = sum(line.count for line in delivery.lines)
            number = str(next(self._shared.numbers))
            self._shared.queue.append(
                (Waiting(number, delivery.id, boxes, self.who.name), delivery)
            )
        return self.deliveries()

    def start(self, delivery: str | None) -> None:
        if delivery is None:
            self._ask(lambda: self._shared.cell.start())
            return
        found = next((both for both in self._shared.queue if both[0].id == delivery), None)
        if found is None or found[0].state != "queued":
            raise Refused("somebody has started this delivery already")
        order = Order(next(self._shared.numbers), found[1])
        self._ask(lambda: self._shared.cell.start(order))
        place = self._shared.queue.index(found)
        self._shared.queue[place] = (replace(found[0], state="running"), found[1])

    def hold(self) -> None:
        self._ask(lambda: self._shared.cell.hold(self.who.name))

    def resume(self) -> None:
        self._ask(lambda: self._shared.cell.resume(self.who.name))

    def stop_after_box(self) -> None:
        self._ask(lambda: self._shared.cell.stop_after_box(self.who.name))

    def answer(self, question: str, choice: str) -> None:
        self._ask(lambda: self._shared.cell.answer(question, choice, self.who.name))

    def products(self) -> Sequence[Product]:
        found = {p.gtin: p for _, d in self._shared.queue for p in d.products.values()}
        return sorted(found.values(), key=lambda product: product.name)

    def add_request(
        self, gtin: str | None, box: str | None, priority: float, minutes: float | None
    ) -> None:
        now = self.state().at
        due = None if minutes is None else now + 60 * minutes
        try:
            request = Request(
                priority,
                Gtin(gtin) if gtin else None,
                BoxId(box) if box else None,
                now,
                due,
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

    def _ask(self, command) -> None:  # noqa: ANN001
        try:
            command()
        except Refusal as refusal:
            raise Refused(str(refusal)) from refusal
