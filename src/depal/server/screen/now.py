"""The view *Now*: what to do, the cell, the requests, the queue, the trolleys."""

import time

from nicegui import ui

from depal.server.cellstate import CellState
from depal.server.records import QueuedView
from depal.server.screen.card import Card
from depal.server.screen.desk import Desk, asked
from depal.server.screen.pane import Pane, html
from depal.server.screen.panels.alarms import alarms
from depal.server.screen.panels.queue import queue_table
from depal.server.screen.panels.summary import summary
from depal.server.screen.panels.trolleys import trolleys
from depal.server.screen.picture import CameraPicture
from depal.server.screen.said import Said
from depal.server.screen.toast import Guard
from depal.server.screen.todo import first_question
from depal.server.screen.view import CellView
from depal.server.screen.wishes import Wishes
from depal.server.screen.words import Words


class NowView:
    """One window's *Now*."""

    def __init__(self, desk: Desk, words: Words, said: Said, guard: Guard) -> None:
        """Empty until it is shown a state.

        Args:
            desk: what its buttons ask of.
            words: of the screen.
            said: puts what the cell says into the screen's language.
            guard: against doing something twice.
        """
        self._desk = desk
        self._waiting: tuple[QueuedView, ...] = ()
        self._state: CellState | None = None
        self._run: tuple[object, ...] = ()
        self._summary = Pane(lambda state: summary(state, words), "summary-line")
        self._card = Card(desk, words, said, guard, self.refresh)
        self._alarms = Pane(lambda state: alarms(state, _shown(state), words, said))
        with ui.element("div").classes("now-grid"):
            with ui.element("div").classes("now-left"):
                self._view = CellView(desk.layout, words)
                with ui.element("section").classes("card"):
                    html(words("trolley.title"), "h3")
                    self._trolleys = Pane(lambda state: trolleys(state, words))
            with ui.element("div").classes("now-right"):
                self._wishes = Wishes(desk, words, guard)
                with ui.element("section").classes("card"):
                    html(words("queue.title"), "h3")
                    self._queue = Pane(lambda state: queue_table(state, words, said), "scrolls")
                    self._queue.element.props(
                        f'tabindex=0 role=region aria-label="{words("queue.title")}"'
                    )
                self._picture = CameraPicture(words)
        self._panes = (self._summary, self._alarms, self._trolleys, self._queue)

    async def settle(self) -> None:
        """Once the browser is there."""
        await self._view.settle()

    async def refresh(self) -> None:
        """Asks anew for what the cell's state does not tell."""
        self._waiting = tuple(await asked(self._desk.deliveries))
        if self._state is not None:
            self._card.show(self._state, self._waiting)
        self._wishes.name_products(await asked(self._desk.products))

    async def show(self, state: CellState) -> None:
        """As the state is."""
        self._state = state
        run = (state.run, state.mode)
        if run != self._run:
            self._run = run
            await self.refresh()
        for pane in self._panes:
            pane.show(state)
        self._card.show(state, self._waiting)
        self._wishes.show(state)
        self._picture.show(state)
        self._view.show(state, time.monotonic())


def _shown(state: CellState) -> str:
    """The alarm or the question that the card is about."""
    question = first_question(state)
    if question is not None:
        return question.id
    return next((alarm.id for alarm in state.alarms if alarm.urgent), "")
