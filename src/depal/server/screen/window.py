"""One browser window: the rail, the three views, and the news that it is shown."""

from collections.abc import Callable

from nicegui import Client, background_tasks, ui

from depal.server.cellstate import CellState
from depal.server.screen.desk import Desk, asked
from depal.server.screen.entrance import SIGN_OUT
from depal.server.screen.hub import Hub
from depal.server.screen.now import NowView
from depal.server.screen.pane import html
from depal.server.screen.past import PastView
from depal.server.screen.said import said_in
from depal.server.screen.setup import SetupView
from depal.server.screen.toast import ENTRANCE, Guard
from depal.server.screen.words import CATALOGUES, NAMES, words_of

CHECK = 10.0
"""So often a window asks whether its session is still good [s]."""

VIEWS = {"now": "dashboard", "past": "history", "setup": "tune"}
"""The views with their pictures."""


class Window:
    """The page, once for each window."""

    def __init__(self, desk: Desk, hub: Hub, language: str) -> None:
        """Lays out the page.

        Args:
            desk: of whoever looks.
            hub: brings the news.
            language: of the page.
        """
        self._desk, self._hub = desk, hub
        self._language, self._words = language, words_of(language)
        self._guard = Guard(self._words, said_in(language))
        self._sections: dict[str, ui.element] = {}
        self._tabs: dict[str, ui.button] = {}
        self._end: Callable[[], None] = lambda: None
        self._past: PastView | None = None
        self._setup: SetupView | None = None
        self._rail()
        with ui.element("div").classes("main"):
            html(self._words("app.title"), "h1").classes("unseen")
            for view in VIEWS:
                self._sections[view] = ui.element("div").classes(f"view view-{view}")
        with self._sections["now"]:
            self._now = NowView(desk, self._words, said_in(language), self._guard)
        self._show_only("now")

    async def open(self, view: str) -> None:
        """Shows one of the views; what is not *Now* is made when it is first opened."""
        self._show_only(view)
        with self._sections[view]:
            if view == "past":
                self._past = self._past or PastView(
                    self._desk, self._words, said_in(self._language)
                )
                await self._past.open()
            elif view == "setup":
                self._setup = self._setup or SetupView(self._desk, self._words, self._guard)
                await self._setup.open()
            else:
                await self._now.refresh()

    def _show_only(self, view: str) -> None:
        for name, section in self._sections.items():
            here = name == view
            section.set_visibility(here)
            tab = self._tabs[name]
            tab.classes(add="is-here" if here else "", remove="" if here else "is-here")
            tab.props("aria-current=page" if here else "", remove="" if here else "aria-current")

    async def live(self, client: Client) -> None:
        """Shows news as long as the window is there."""
        await client.connected(timeout=30)
        with client:
            await self._now.settle()
        viewer = self._hub.add(lambda state: self._show(client, state))
        task = background_tasks.create(viewer.run(), name="viewer")
        with client:
            ui.timer(CHECK, self._still)

        def end() -> None:
            task.cancel()
            self._hub.remove(viewer)

        self._end = end
        client.on_delete(end)

    async def _still(self) -> None:
        """Whoever is signed in no more sees no more."""
        if await asked(self._desk.me) is None:
            self._end()
            ui.navigate.to(ENTRANCE)

    async def _show(self, client: Client, state: CellState) -> None:
        with client:
            await self._now.show(state)

    def _rail(self) -> None:
        words = self._words
        with ui.element("nav").classes("rail").props(f'aria-label="{words("rail.title")}"'):
            for view, sign in VIEWS.items():
                tab = ui.button(words(f"rail.{view}"), icon=sign, color=None)
                tab.on_click(self._opening(view))
                tab.props("no-caps flat stack").classes("tab").mark(view)
                self._tabs[view] = tab
            ui.element("div").classes("space")
            other = next(name for name in CATALOGUES if name != self._language)
            button = ui.button(
                NAMES[other], icon="translate", color=None, on_click=self._speaking(other)
            )
            button.props(f"no-caps flat stack lang={other}").classes("tab").mark("language")
            button = ui.button(words("rail.out"), icon="logout", color=None, on_click=self._leave)
            button.props("no-caps flat stack").classes("tab").mark("sign out")

    def _opening(self, view: str) -> Callable[[], object]:
        return lambda: self.open(view)

    @staticmethod
    def _speaking(language: str) -> Callable[[], None]:
        """The language is kept in the browser; the page is made anew in it."""

        def speak() -> None:
            ui.run_javascript(
                f"document.cookie = 'depal-language={language}; path=/; max-age=31536000; "
                "samesite=strict'; location.reload()"
            )

        return speak

    @staticmethod
    def _leave() -> None:
        """The session ends, then the page does."""
        ui.run_javascript(
            f"fetch('{SIGN_OUT}', {{method: 'POST'}}).finally(() => location.replace('{ENTRANCE}'))"
        )
