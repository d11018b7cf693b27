"""Requests: those that wait, with an estimate; more, other, fewer of them."""

from collections.abc import Sequence

from nicegui import ui

from depal.server.cellstate import CellState, RequestState
from depal.server.roles import WORKERS
from depal.server.screen.desk import Desk, asked
from depal.server.screen.markup import Markup, tag
from depal.server.screen.pane import html, put
from depal.server.screen.toast import Guard
from depal.server.screen.wishform import LEVELS, WishForm, level_of
from depal.server.screen.words import Words
from depal.server.usecases.deliveries import ProductView


def estimate(request: RequestState, words: Words, *, seen: bool) -> str:
    """When it will come, as it looks now.

    Args:
        request: that waits.
        words: of the screen.
        seen: whether what is wanted stands on the pallet.
    """
    if request.boxes_before is None or request.minutes is None:
        return words("wish.counting" if seen else "wish.unknown")
    minutes = max(round(request.minutes), 1)
    if request.boxes_before == 0:
        return words("wish.this_one", minutes=minutes)
    return words("wish.estimate", boxes=request.boxes_before, minutes=minutes)


class Row:
    """One request."""

    def __init__(self, desk: Desk, words: Words, guard: Guard, key: str) -> None:
        """Empty until it is shown."""
        self._desk, self._words, self._guard, self._key = desk, words, guard, key
        self._request: RequestState | None = None
        with ui.element("li").classes("wish") as self.element:
            self._told = html("").classes("told")
            if desk.who.role in WORKERS:
                self._level = ui.button("", color=None, on_click=self._change).props(
                    "no-caps outline"
                )
                self._level.classes("small")
                self._drop = ui.button(icon="close", color=None, on_click=self._cancel).props(
                    "flat"
                )
                self._drop.classes("small")

    def show(self, request: RequestState, name: str, now: float, *, seen: bool) -> None:
        """As it is now."""
        self._request = request
        put(self._told, _told(request, name, now, self._words, seen=seen))
        if self._desk.who.role in WORKERS:
            level = self._words(f"wish.{level_of(request.priority)}")
            self._level.set_text(level)
            self._level.props["aria-label"] = self._words("wish.change", name=name, level=level)
            self._drop.props["aria-label"] = self._words("wish.cancel", name=name)

    async def _change(self) -> None:
        """The next level: soon, next, now, and around again."""
        request = self._request
        if request is None:
            return
        levels = list(LEVELS)
        level = levels[(levels.index(level_of(request.priority)) + 1) % len(levels)]
        done = self._words("done.wish_changed", level=self._words(f"wish.{level}"))
        await self._guard.do(done, self._desk.change_request, self._key, LEVELS[level])

    async def _cancel(self) -> None:
        done = self._words("done.wish_cancelled")
        await self._guard.do(done, self._desk.cancel_request, self._key)


def _told(request: RequestState, name: str, now: float, words: Words, *, seen: bool) -> Markup:
    due = None
    if request.due is not None:
        left = round((request.due - now) / 60)
        key = "wish.due" if left >= 0 else "wish.late"
        due = tag("span", words(key, minutes=abs(left)), cls="due" if left >= 0 else "due bad")
    waits = tag("span", estimate(request, words, seen=seen))
    return tag("div", tag("strong", name), tag("span", waits, due, cls="when"))


class Wishes:
    """The list and the form."""

    def __init__(self, desk: Desk, words: Words, guard: Guard) -> None:
        """Empty until it is shown a state."""
        self._desk, self._words, self._guard = desk, words, guard
        self._rows: dict[str, Row] = {}
        self._names: dict[str, str] = {}
        self._boxes: tuple[str, ...] = ()
        with ui.element("section").classes("card wishes"):
            with ui.element("div").classes("head"):
                html(words("wish.title"), "h3")
                if desk.who.role in WORKERS:
                    button = ui.button(
                        words("wish.add"), icon="add", color=None, on_click=self._open
                    )
                    button.props("no-caps unelevated").classes("act").mark("add request")
            self._none = html(words("wish.none"), "p").classes("quiet")
            self._list = ui.element("ul")
        self._form = WishForm(desk, words, guard)

    def name_products(self, products: Sequence[ProductView]) -> None:
        """What products are called."""
        self._names = {product.gtin: product.name for product in products}

    def show(self, state: CellState) -> None:
        """As the state is; rows stay, so that nobody loses the place."""
        gtins = {line.gtin for line in state.queue if line.gtin is not None}
        self._boxes = tuple(line.box for line in state.queue)
        self._none.set_visibility(not state.requests)
        known = {request.key for request in state.requests}
        for key in [key for key in self._rows if key not in known]:
            self._rows.pop(key).element.delete()
        for place, request in enumerate(_ordered(state.requests)):
            row = self._rows.get(request.key)
            if row is None:
                with self._list:
                    row = Row(self._desk, self._words, self._guard, request.key)
                self._rows[request.key] = row
            if self._list.default_slot.children[place] is not row.element:
                row.element.move(target_index=place)
            seen = request.gtin in gtins or request.box in self._boxes
            row.show(request, self._name(request), state.at, seen=seen)

    def _name(self, request: RequestState) -> str:
        if request.box is not None:
            return self._words("wish.box", box=request.box)
        return self._names.get(request.gtin or "", request.gtin or "")

    async def _open(self) -> None:
        self.name_products(await asked(self._desk.products))
        self._form.open(self._names, self._boxes)


def _ordered(requests: Sequence[RequestState]) -> list[RequestState]:
    """The next to be served first, as it looks now."""
    far = float("inf")
    return sorted(
        requests, key=lambda request: (
            far if request.boxes_before is None else request.boxes_before, -request.priority
        )
    )  # fmt: skip
