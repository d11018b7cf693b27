"""The form to ask for a case: which, how urgent, by when."""

from collections.abc import Mapping, Sequence
from types import MappingProxyType
from typing import Final
from uuid import uuid4

from nicegui import ui

from depal.server.screen.choosing import Choosing
from depal.server.screen.desk import Desk
from depal.server.screen.pane import html
from depal.server.screen.toast import Guard, refused
from depal.server.screen.words import Words

LEVELS: Final[Mapping[str, float]] = MappingProxyType({"soon": 0.3, "next": 0.6, "now": 0.9})
"""What a person says, and the p of the paper that it means."""

USUAL = "next"


def level_of(priority: float) -> str:
    """The word that is nearest to a priority."""
    return min(LEVELS, key=lambda level: abs(LEVELS[level] - priority))


class WishForm:
    """One dialog; what is sent twice from it is asked for once."""

    def __init__(self, desk: Desk, words: Words, guard: Guard) -> None:
        """Closed.

        Args:
            desk: what it asks of.
            words: of the screen.
            guard: against doing something twice.
        """
        self._desk, self._words, self._guard = desk, words, guard
        self._dialog = ui.dialog()
        self._dialog.props["aria-label"] = words("wish.add_title")
        self._opened, self._name = 0.0, ""

    def open(self, products: Mapping[str, str], boxes: Sequence[str]) -> None:
        """Asks.

        Args:
            products: their names, by number.
            boxes: on the pallet.
        """
        words = self._words
        self._opened, self._name = self._desk.site.chance.now(), uuid4().hex
        options = {f"p {gtin}": name for gtin, name in products.items()}
        options |= {f"b {box}": words("wish.box", box=box) for box in boxes}
        self._dialog.clear()
        with self._dialog, ui.card().classes("form"):
            html(words("wish.add_title"), "h3")
            self._what = Choosing(options, words("wish.what"), words)
            levels = {level: words(f"wish.{level}") for level in LEVELS}
            self._level = ui.toggle(levels, value=USUAL).props("no-caps unelevated spread")
            self._level.classes("wide").props["aria-label"] = words("wish.level")
            self._due = ui.number(words("wish.due_in"), min=1, max=1440, precision=0)
            self._due.props("outlined clearable").classes("wide")
            self._lay_out_acts()
        self._dialog.open()

    def _lay_out_acts(self) -> None:
        with ui.element("div").classes("acts"):
            close = ui.button(self._words("act.close"), color=None, on_click=self._dialog.close)
            close.props("no-caps unelevated").classes("act")
            send = ui.button(self._words("wish.add"), icon="add", color=None, on_click=self._send)
            send.props("no-caps unelevated").classes("act is-main").mark("send request")

    async def _send(self) -> None:
        what, level, minutes = self._what.chosen, self._level.value or USUAL, self._due.value
        if not what:
            refused(self._words("wish.choose"))
            return
        kind, _, name = what.partition(" ")
        gtin, box = (name, None) if kind == "p" else (None, name)
        due = None if minutes is None else self._opened + 60.0 * minutes
        wanted = (gtin, box, LEVELS[level], due, f"{self._name} {what} {level} {minutes}")
        if await self._guard.do(self._words("done.wish"), self._desk.add_request, *wanted):
            self._dialog.close()
