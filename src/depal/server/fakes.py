"""A cell without a cell: it follows commands at once. For tests and for trying a screen."""

from collections.abc import Callable
from dataclasses import replace

from depal.domain import CellLayout, Request
from depal.server.cell import Order, Refusal, Settings, Watcher
from depal.server.cellstate import CellState, Mode, RequestState


class FakeCell:
    """Behind the protocol `Cell`; its state is set by commands, and by tests."""

    def __init__(self, layout: CellLayout) -> None:
        """Nothing is started."""
        self.layout, self.told = layout, CellState(version=1)
        self._watchers: list[Watcher] = []
        self.answers: dict[str, str] = {}

    def state(self) -> CellState:
        """What was told last."""
        return self.told

    def tell(self, state: CellState) -> None:
        """Something has changed."""
        self.told = replace(state, version=self.told.version + 1)
        for watcher in tuple(self._watchers):
            watcher(self.told)

    def watch(self, watcher: Watcher) -> Callable[[], None]:
        """Calls a function with every new state."""
        self._watchers.append(watcher)
        return lambda: self._watchers.remove(watcher)

    def start(self, order: Order | None = None) -> None:
        """Begins, or goes on."""
        if order is None:
            self._go(Mode.EXECUTE, {Mode.HELD, Mode.STOPPED})
        else:
            name, boxes = order.delivery.id, sum(line.count for line in order.delivery.lines)
            fresh = CellState(mode=Mode.EXECUTE, delivery=name, run=order.run, boxes=boxes)
            self.tell(replace(fresh, version=self.told.version))

    def hold(self, source: str) -> None:
        """Nothing new begins."""
        del source
        self._go(Mode.HELD, {Mode.EXECUTE})

    def resume(self, source: str) -> None:
        """Goes on."""
        del source
        self._go(Mode.EXECUTE, {Mode.HELD, Mode.STOPPED})

    def stop_after_box(self, source: str) -> None:
        """Stops at once: there is no box in its hand."""
        del source
        self._go(Mode.STOPPED, {Mode.EXECUTE})

    def _go(self, mode: Mode, fitting: set[Mode]) -> None:
        if self.told.mode not in fitting:
            raise Refusal(f"the cell is {self.told.mode.value}")
        self.tell(replace(self.told, mode=mode))

    def add_request(self, key: str, request: Request) -> None:
        """One more, once."""
        self.cancel_request(key)
        line = RequestState(key, request.gtin, request.box, request.priority, 0.0, request.due)
        self.tell(replace(self.told, requests=(*self.told.requests, line)))

    def change_request(self, key: str, request: Request) -> None:
        """Another priority."""
        self.add_request(key, request)

    def cancel_request(self, key: str) -> None:
        """Not wanted any more."""
        kept = tuple(each for each in self.told.requests if each.key != key)
        self.tell(replace(self.told, requests=kept))

    def answer(self, question: str, choice: str, source: str) -> None:
        """The first answer counts."""
        if question in self.answers:
            raise Refusal(self.answers[question])
        self.answers[question] = f"{source} has answered this question: {choice}"
        self.tell(self.told)

    def set(self, settings: Settings) -> None:
        """Other settings."""
        self.tell(replace(self.told, w=settings.w, speed=settings.speed, policy=settings.policy))

    def why(self, box: str) -> str:
        """Always the same."""
        return f"{box}: it has the greatest score"

    def picture(self) -> bytes:
        """The smallest JPEG that begins like one."""
        return b"\xff\xd8\xff\xd9"
