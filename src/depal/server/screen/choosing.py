"""One of many, for gloves: a field to search by, and large buttons for what is found."""

from collections.abc import Mapping

from nicegui import ui

from depal.server.screen.pane import html, put
from depal.server.screen.words import Words

SHOWN = 30
"""So many at once; typing finds the others."""


class Choosing:
    """What is chosen stays so while one searches on.

    Attributes:
        chosen: the key of the option; None while none is.
    """

    def __init__(self, options: Mapping[str, str], label: str, words: Words) -> None:
        """Lays it out where one is.

        Args:
            options: what they are called, by key.
            label: of the field.
            words: of the screen.
        """
        self.chosen: str | None = None
        self._options, self._words = options, words
        self._buttons: dict[str, ui.button] = {}
        self._search = ui.input(label, on_change=self._show)
        self._search.props("outlined clearable debounce=150").classes("wide").mark("search")
        self._found = html(name="p").classes("quiet").props("aria-live=polite")
        self._list = ui.element("div").classes("choices")
        self._show()

    def _show(self) -> None:
        wanted = (self._search.value or "").casefold()
        found = [key for key, name in self._options.items() if wanted in f"{name} {key}".casefold()]
        put(self._found, self._words("choosing.found", count=len(found)))
        shown = set(found[:SHOWN])
        for key, button in self._buttons.items():
            button.set_visibility(key in shown)
        with self._list:
            for key in found[:SHOWN]:
                if key not in self._buttons:
                    self._button(key)

    def _button(self, key: str) -> None:
        button = ui.button(self._options[key], color=None, on_click=lambda: self._choose(key))
        button.props("no-caps flat align=left").classes("choice")
        self._buttons[key] = button
        self._mark(key)

    def _choose(self, key: str) -> None:
        before, self.chosen = self.chosen, key
        for each in (before, key):
            if each is not None:
                self._mark(each)

    def _mark(self, key: str) -> None:
        button = self._buttons.get(key)
        if button is None:
            return
        here = key == self.chosen
        button.props(f"aria-pressed={str(here).lower()}")
        button.props("icon=check" if here else "", remove="" if here else "icon")
