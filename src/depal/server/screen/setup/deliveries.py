"""Deliveries: upload, all that is wrong with one, their order, start."""

from collections.abc import Sequence

from nicegui import ui

from depal.server.records import QueuedView
from depal.server.screen.desk import Desk, asked
from depal.server.screen.files import ACCEPT, choose, problems
from depal.server.screen.markup import tag
from depal.server.screen.pane import html, put
from depal.server.screen.toast import Guard
from depal.server.screen.words import Words


class DeliveriesPart:
    """The queue."""

    def __init__(self, desk: Desk, words: Words, guard: Guard) -> None:
        """Empty until it is opened."""
        self._desk, self._words, self._guard = desk, words, guard
        with ui.element("section").classes("card"):
            with ui.element("div").classes("head"):
                html(words("setup.deliveries"), "h2").classes("h3")
                button = ui.button(words("act.bring"), icon="upload_file", color=None)
                button.props("no-caps unelevated").classes("act is-main").mark("upload")
                choose(button, ACCEPT, words("file.too_large"), self._bring)
            html(words("delivery.how"), "p").classes("quiet")
            self._problems = html("").props("aria-live=assertive")
            self._list = ui.element("ul").classes("lines")

    async def open(self) -> None:
        """As it is now."""
        self._show(await asked(self._desk.deliveries))

    async def _bring(self, name: str, content: bytes) -> None:
        done = self._words("done.upload", name=name)
        await self._guard.do(done, self._desk.upload, name, content, listed=True)
        put(self._problems, problems(self._guard.problems, self._words))
        await self.open()

    def _show(self, waiting: Sequence[QueuedView]) -> None:
        self._list.clear()
        with self._list:
            if not waiting:
                html(self._words("delivery.none"), "li").classes("quiet")
            queued = [each for each in waiting if each.state == "queued"]
            for each in waiting:
                self._line(each, each in queued[1:], each in queued[:-1])

    def _line(self, each: QueuedView, earlier: bool, later: bool) -> None:  # noqa: FBT001
        words = self._words
        state = words(f"delivery.{each.state}")
        told = words("delivery.about", boxes=each.boxes, by=each.by, state=state)
        with ui.element("li").classes("line"):
            html(tag("div", tag("strong", each.id), tag("small", told))).classes("told")
            if each.state != "queued":
                return
            self._small(
                "arrow_upward", words("delivery.up", name=each.id), each, each.position - 1, earlier
            )
            self._small(
                "arrow_downward",
                words("delivery.down", name=each.id),
                each,
                each.position + 1,
                later,
            )
            drop = ui.button(icon="close", color=None, on_click=lambda: self._cancel(each))
            drop.props["aria-label"] = words("delivery.cancel", name=each.id)
            drop.props("flat").classes("small")
            start = ui.button(words("act.start"), icon="play_arrow", color=None)
            start.on_click(lambda: self._start(each))
            start.props("no-caps unelevated").classes("act")

    def _small(self, icon: str, label: str, each: QueuedView, position: int, able: bool) -> None:  # noqa: FBT001
        button = ui.button(icon=icon, color=None, on_click=lambda: self._move(each, position))
        button.props["aria-label"] = label
        button.props("flat").classes("small").set_enabled(able)

    async def _move(self, each: QueuedView, position: int) -> None:
        await self._guard.do("", self._desk.move_delivery, each.id, position, each.version)
        await self.open()

    async def _cancel(self, each: QueuedView) -> None:
        done = self._words("done.delivery_cancelled", name=each.id)
        await self._guard.do(done, self._desk.cancel_delivery, each.id, each.version)
        await self.open()

    async def _start(self, each: QueuedView) -> None:
        await self._guard.do(self._words("done.start"), self._desk.start, each.id)
        await self.open()
