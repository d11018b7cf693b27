"""Tokens: how a store's system signs in."""

from nicegui import ui

from depal.server.people import TokenView
from depal.server.screen.desk import Desk, asked
from depal.server.screen.markup import tag
from depal.server.screen.moments import day_of
from depal.server.screen.pane import html
from depal.server.screen.toast import Guard
from depal.server.screen.words import Words

DAYS = 365
"""How long a token is good unless said otherwise [days]."""


class TokensPart:
    """The store systems' ways in."""

    def __init__(self, desk: Desk, words: Words, guard: Guard) -> None:
        """Empty until it is opened."""
        self._desk, self._words, self._guard = desk, words, guard
        with ui.element("section").classes("card"):
            html(words("setup.tokens"), "h2").classes("h3")
            html(words("token.how"), "p").classes("quiet")
            with ui.element("div").classes("pair"):
                self._name = ui.input(words("token.name")).props("outlined")
                self._days = ui.number(words("token.days"), value=DAYS, min=1, max=DAYS)
                self._days.props("outlined")
                add = ui.button(words("token.add"), icon="key", color=None, on_click=self._add)
                add.props("no-caps unelevated").classes("act is-main")
            self._list = ui.element("ul").classes("lines")
        self._form = ui.dialog().props("persistent")

    async def open(self) -> None:
        """As it is now."""
        tokens = await asked(self._desk.tokens)
        self._list.clear()
        with self._list:
            if not tokens:
                html(self._words("token.none"), "li").classes("quiet")
            for token in tokens:
                self._line(token)

    def _line(self, token: TokenView) -> None:
        words = self._words
        told = words("token.expires", when=day_of(token.expires))
        with ui.element("li").classes("line"):
            html(tag("div", tag("strong", token.name), tag("small", told))).classes("told")
            revoke = ui.button(words("token.revoke"), color=None)
            revoke.on_click(lambda: self._revoke(token))
            revoke.props("no-caps unelevated").classes("act")
            revoke.props["aria-label"] = words("token.revoke_this", name=token.name)

    async def _add(self) -> None:
        made: list[str] = []

        def add() -> None:
            made.append(self._desk.add_token(self._name.value, int(self._days.value or DAYS)))

        if await self._guard.do("", add):
            self._show(made[0])
            self._name.set_value("")
            await self.open()

    def _show(self, secret: str) -> None:
        words = self._words
        self._form.clear()
        self._form.props["aria-label"] = words("token.once")
        with self._form, ui.card().classes("form"):
            html(words("token.once"), "h2").classes("h3")
            html(words("token.once_how"), "p").classes("quiet")
            html(tag("code", secret, cls="secret"))
            close = ui.button(words("token.kept"), color=None, on_click=self._form.close)
            close.props("no-caps unelevated").classes("act is-main")
        self._form.open()

    async def _revoke(self, token: TokenView) -> None:
        done = self._words("done.revoked", name=token.name)
        await self._guard.do(done, self._desk.revoke_token, token.id)
        await self.open()
