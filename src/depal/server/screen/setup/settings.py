"""Settings of the cell, each within its bounds."""

from nicegui import ui

from depal.server.cell import Settings
from depal.server.screen.desk import Desk, asked
from depal.server.screen.pane import html, put
from depal.server.screen.toast import Guard
from depal.server.screen.words import Words

SLOWEST = 5
"""Of full speed [%]."""


class SettingsPart:
    """w, speed and policy; what is set is said before it is kept."""

    def __init__(self, desk: Desk, words: Words, guard: Guard) -> None:
        """Empty until it is opened."""
        self._desk, self._words, self._guard = desk, words, guard
        self._kept, self._version = Settings(), 0
        with ui.element("section").classes("card stack"):
            html(words("setup.settings"), "h2").classes("h3")
            self._w_told = html("", "p")
            self._w = ui.slider(min=0, max=1, step=0.05, value=0.5, on_change=self._tell)
            self._w.props(f'aria-label="{words("settings.w")}"')
            html(words("settings.w_how"), "p").classes("quiet")
            self._speed_told = html("", "p")
            self._speed = ui.slider(min=SLOWEST, max=100, step=5, value=100, on_change=self._tell)
            self._speed.props(f'aria-label="{words("settings.speed")}"')
            html(words("settings.policy"), "p")
            options = {name: words(f"settings.{name}") for name in ("paper", "access")}
            self._policy = ui.radio(options, value="paper", on_change=self._tell)
            self._policy.props(f'aria-label="{words("settings.policy")}"')
            self._preview = html("", "p").props("aria-live=polite")
            with ui.element("div").classes("acts"):
                self._undo = ui.button(words("act.undo"), color=None, on_click=self._put_back)
                self._undo.props("no-caps unelevated").classes("act")
                self._keep = ui.button(words("act.keep"), color=None, on_click=self._put)
                self._keep.props("no-caps unelevated").classes("act is-main")

    async def open(self) -> None:
        """As it is now."""
        self._kept, self._version = await asked(self._desk.settings)
        self._put_back()

    def _wanted(self) -> Settings:
        return Settings(
            round(float(self._w.value), 2),
            round(float(self._speed.value) / 100, 2),
            str(self._policy.value),
        )

    def _put_back(self) -> None:
        self._w.set_value(self._kept.w)
        self._speed.set_value(round(100 * self._kept.speed))
        self._policy.set_value(self._kept.policy)
        self._tell()

    def _tell(self) -> None:
        words, wanted = self._words, self._wanted()
        put(self._w_told, words("settings.w_is", w=f"{wanted.w:.2f}"))
        put(self._speed_told, words("settings.speed_is", speed=round(100 * wanted.speed)))
        changed = wanted != self._kept
        put(self._preview, words("settings.preview" if changed else "settings.same"))
        self._undo.set_enabled(changed)
        self._keep.set_enabled(changed)

    async def _put(self) -> None:
        given = (self._wanted(), self._version)
        await self._guard.do(self._words("done.kept"), self._desk.put_settings, *given)
        await self.open()
