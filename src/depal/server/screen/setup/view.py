"""The parts of *Set-up* and the way between them."""

from collections.abc import Callable
from typing import Protocol

from nicegui import ui

from depal.server.roles import SET_UP, WORKERS
from depal.server.screen.desk import Desk
from depal.server.screen.setup.cellfile import CellPart
from depal.server.screen.setup.deliveries import DeliveriesPart
from depal.server.screen.setup.people import PeoplePart
from depal.server.screen.setup.products import ProductsPart
from depal.server.screen.setup.settings import SettingsPart
from depal.server.screen.setup.tokens import TokensPart
from depal.server.screen.toast import Guard
from depal.server.screen.words import Words


class Part(Protocol):
    """One of the parts."""

    async def open(self) -> None:
        """As it is now."""
        ...


class SetupView:
    """One window's *Set-up*."""

    def __init__(self, desk: Desk, words: Words, guard: Guard) -> None:
        """Lays out what the role of whoever looks may use."""
        self._rooms: dict[str, ui.element] = {}
        self._buttons: dict[str, ui.button] = {}
        self._parts: dict[str, Part] = {}
        self._makers: dict[str, Callable[[], Part]] = {}
        if desk.who.role in WORKERS:
            self._makers["deliveries"] = lambda: DeliveriesPart(desk, words, guard)
        self._makers["cell"] = lambda: CellPart(desk.layout, words)
        if desk.who.role in SET_UP:
            self._makers |= {
                "products": lambda: ProductsPart(desk, words, guard),
                "settings": lambda: SettingsPart(desk, words, guard),
                "people": lambda: PeoplePart(desk, words, guard),
                "tokens": lambda: TokensPart(desk, words, guard),
            }
        self._lay_out(words)

    def _lay_out(self, words: Words) -> None:
        with ui.element("nav").classes("sub").props(f'aria-label="{words("setup.parts")}"'):
            for name in self._makers:
                button = ui.button(words(f"setup.{name}"), color=None, on_click=self._opening(name))
                self._buttons[name] = button.props("no-caps flat").mark(name)
        for name in self._makers:
            self._rooms[name] = ui.element("div")

    def _opening(self, name: str) -> Callable[[], object]:
        return lambda: self.open(name)

    async def open(self, name: str = "") -> None:
        """Shows one of the parts; the first where none is named or it is not for this role."""
        name = name if name in self._makers else next(iter(self._makers))
        for each, room in self._rooms.items():
            here = each == name
            room.set_visibility(here)
            button = self._buttons[each]
            button.classes(add="is-here" if here else "", remove="" if here else "is-here")
            button.props("aria-current=page" if here else "", remove="" if here else "aria-current")
        if name not in self._parts:
            with self._rooms[name]:
                self._parts[name] = self._makers[name]()
        await self._parts[name].open()
