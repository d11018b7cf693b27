"""The view *Past*: every run, and any moment of it with the task tree and the reasons."""

from collections.abc import Sequence
from dataclasses import replace

from nicegui import ui

from depal.errors import DepalError
from depal.server.cellstate import CellState
from depal.server.records import RunView
from depal.server.screen.desk import Desk, asked
from depal.server.screen.markup import Markup, joined, tag
from depal.server.screen.moments import minutes_of, moment_of
from depal.server.screen.pane import html, put
from depal.server.screen.panels.queue import queue_table
from depal.server.screen.panels.tree import trees
from depal.server.screen.replayed import Moment, Replayed
from depal.server.screen.said import Said
from depal.server.screen.words import Words


class PastView:
    """One window's *Past*."""

    def __init__(self, desk: Desk, words: Words, said: Said) -> None:
        """Empty until it is opened."""
        self._desk, self._words, self._said = desk, words, said
        self._replayed: Replayed | None = None
        self._names: dict[str, str] = {}
        self._buttons: dict[int, ui.button] = {}
        self._busy = False
        with ui.element("div").classes("past-grid"):
            with ui.element("section").classes("card"):
                html(words("past.runs"), "h2").classes("h3")
                self._list = ui.element("div")
            self._shown = ui.element("div").classes("stack")
        with self._shown:
            self._lay_out()
        self._shown.set_visibility(False)

    def _lay_out(self) -> None:
        words = self._words
        with ui.element("section").classes("card"):
            self._title = html("", "h2").classes("h3")
            with ui.element("div").classes("scrub") as scrub:
                back = ui.button(icon="chevron_left", on_click=lambda: self._step(-1))
                back.props(f'flat aria-label="{words("past.back")}"').classes("small")
                self._slider = ui.slider(min=0, max=1, step=1, value=0, on_change=self._scrub)
                self._slider.props(f'aria-label="{words("past.scrub")}"').mark("scrub")
                on = ui.button(icon="chevron_right", on_click=lambda: self._step(1))
                on.props(f'flat aria-label="{words("past.on")}"').classes("small")
            self._happened = html("").props("aria-live=polite")
        with ui.element("section").classes("card") as tasks:
            html(words("past.tasks"), "h3")
            self._trees = html("")
        with ui.element("section").classes("card") as selection:
            html(words("past.selection"), "h3")
            self._selection = html("").classes("scrolls")
            self._selection.props(f'tabindex=0 role=region aria-label="{words("past.selection")}"')

        self._parts = (scrub, self._happened, tasks, selection)

    async def open(self) -> None:
        """The runs as they are now."""
        runs = await asked(self._desk.runs)
        self._names = {product.gtin: product.name for product in await asked(self._desk.products)}
        self._list.clear()
        self._buttons = {}
        with self._list:
            if not runs:
                html(self._words("past.none"), "p").classes("quiet")
            for run in runs:
                self._button(run)
        if runs and self._replayed is None:
            await self._choose(runs[0])

    def _button(self, run: RunView) -> None:
        text = self._words("past.run", number=run.number, delivery=run.delivery)
        button = ui.button(color=None, on_click=lambda: self._choose(run)).props("no-caps flat")
        button.classes("run")
        with button:
            html(_run(run, text, self._words))
        self._buttons[run.number] = button

    async def _choose(self, run: RunView) -> None:
        try:
            folder = await asked(self._desk.record, run.number)
            self._replayed = await asked(Replayed.read, folder)
        except DepalError:
            self._mark(run)
            put(self._title, self._words("past.no_record", number=run.number))
            self._show_parts(shown=False)
            return
        self._mark(run)
        text = self._words("past.run", number=run.number, delivery=run.delivery)
        put(self._title, tag("span", text))
        last = len(self._replayed.steps)
        self._show_parts(shown=True)
        self._slider.props["max"] = last
        self._slider.update()
        if self._slider.value == last:
            await self._scrub()
        else:
            self._slider.set_value(last)

    def _mark(self, run: RunView) -> None:
        for number, button in self._buttons.items():
            here = number == run.number
            button.classes(add="is-here" if here else "", remove="" if here else "is-here")

    def _show_parts(self, *, shown: bool) -> None:
        self._shown.set_visibility(True)
        for part in self._parts:
            part.set_visibility(shown)

    def _step(self, by: int) -> None:
        value = int(self._slider.value) + by
        self._slider.set_value(min(max(value, 0), int(self._slider.props["max"])))

    async def _scrub(self) -> None:
        """To where the slider is; while one moment is made, only the newest wish is kept."""
        replayed = self._replayed
        if replayed is None or self._busy:
            return
        self._busy = True
        try:
            while True:
                place = int(self._slider.value)
                number = replayed.steps[place - 1] if place else 0
                moment = await asked(replayed.moment, number)
                self._show(moment)
                if place == int(self._slider.value):
                    return
        finally:
            self._busy = False

    def _show(self, moment: Moment) -> None:
        words, said = self._words, self._said
        put(self._happened, happened(moment, words, said))
        put(self._trees, trees(moment.trees, words))
        selection = moment.selection
        if selection is None:
            put(self._selection, tag("p", words("past.no_selection"), cls="quiet"))
            return
        queue = tuple(
            replace(line, name=self._names.get(line.gtin or "", line.name))
            for line in selection.queue
        )
        state = CellState(target=selection.target, queue=queue)
        put(self._selection, queue_table(state, words, said))


def _run(run: RunView, text: str, words: Words) -> Markup:
    told = [words(f"past.state_{run.state}"), moment_of(run.began)]
    stored, boxes = run.result.get("stored"), run.result.get("boxes")
    if isinstance(stored, int) and isinstance(boxes, int):
        told.append(words("summary.stored", stored=stored, boxes=boxes))
    return tag("span", tag("strong", text), tag("br"), tag("small", " · ".join(told)))


def happened(moment: Moment, words: Words, said: Said) -> Markup:
    """The last events, the latest first and large."""
    return tag("ul", _items(moment, words, said), cls="happened")


def _items(moment: Moment, words: Words, said: Said) -> Markup:
    if not moment.last:
        return tag("li", words("past.beginning"))
    parts: Sequence[Markup] = [
        tag(
            "li",
            tag("time", minutes_of(event.at)),
            words(event.what, label=event.label),
            f": {said(event.reason)}" if event.reason else None,
            cls="is-last" if place == 0 else None,
        )
        for place, event in enumerate(moment.last)
    ]
    return joined(parts)
