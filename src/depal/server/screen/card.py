"""The card that says what to do now."""

from collections.abc import Awaitable, Callable, Sequence
from inspect import isawaitable

from nicegui import ui

from depal.server.cellstate import CellState
from depal.server.records import QueuedView
from depal.server.roles import WORKERS
from depal.server.screen.desk import Desk
from depal.server.screen.files import ACCEPT, choose, problems
from depal.server.screen.markup import Markup, icon, tag
from depal.server.screen.pane import html, put
from depal.server.screen.said import Said
from depal.server.screen.toast import Guard
from depal.server.screen.todo import Act, Todo, Verb, todo_of
from depal.server.screen.words import Words

ICONS = {
    Verb.START: "play_arrow",
    Verb.HOLD: "pause",
    Verb.RESUME: "play_arrow",
    Verb.STOP: "stop",
    Verb.BRING: "upload_file",
    Verb.SAMPLE: "science",
    Verb.ANSWER: "",
}


class Card:
    """Headline, reason, buttons."""

    def __init__(
        self, desk: Desk, words: Words, said: Said, guard: Guard, queued: Callable[[], object]
    ) -> None:
        """Empty until it is shown a state.

        Args:
            desk: what the buttons ask of.
            words: of the screen.
            said: puts what the cell says into the screen's language.
            guard: against doing something twice.
            queued: called when the queue of deliveries has changed.
        """
        self._desk, self._words, self._said = desk, words, said
        self._guard, self._queued = guard, queued
        self._may = desk.who.role in WORKERS
        self._shown: Todo | None = None
        with ui.element("section").classes("card todo") as self.element:
            self.element.props(f'aria-label="{words("todo.title")}"')
            self._told = html("").props("aria-live=polite").classes("told")
            self._acts = ui.element("div").classes("acts")
            self._problems = html().classes("all")

    def show(self, state: CellState, waiting: Sequence[QueuedView]) -> None:
        """As the state is."""
        names = [each.id for each in waiting if each.state == "queued"]
        todo = todo_of(state, names, self._words, self._said)
        if todo == self._shown:
            return
        before, self._shown = self._shown, todo
        put(self._told, _told(todo))
        if before is None or before.tone is not todo.tone:
            self.element.classes(replace=f"card todo is-{todo.tone.value}")
        if before is None or before.acts != todo.acts:
            self._show_acts(todo.acts, waiting)

    def _show_acts(self, acts: Sequence[Act], waiting: Sequence[QueuedView]) -> None:
        self._acts.clear()
        if not self._may:
            return
        with self._acts:
            for act in acts:
                look = "act is-main" if act.main else "act"
                button = ui.button(act.label, color=None).classes(look)
                button.props("no-caps unelevated")
                self._bind(button, act, waiting)
                if ICONS[act.verb]:
                    button.props(f"icon={ICONS[act.verb]}")
                button.mark(act.verb.value)

    def _bind(self, button: ui.button, act: Act, waiting: Sequence[QueuedView]) -> None:
        if act.verb is Verb.BRING:
            choose(button, ACCEPT, self._words("file.too_large"), self._bring)
        else:
            button.on_click(_showing(button, self._doing(act, waiting)))

    async def _bring(self, name: str, content: bytes) -> None:
        done = self._words("done.upload", name=name)
        await self._guard.do(done, self._desk.upload, name, content, listed=True)
        put(self._problems, problems(self._guard.problems, self._words))
        await self._told_anew()

    async def _told_anew(self) -> None:
        found = self._queued()
        if isawaitable(found):
            await found

    def _doing(self, act: Act, waiting: Sequence[QueuedView]) -> Callable[[], Awaitable[None]]:
        delivery = next((each.id for each in waiting if each.id == act.about), None)

        async def do() -> None:
            desk, words = self._desk, self._words
            if act.verb is Verb.START:
                await self._guard.do(words("done.start"), desk.start, delivery)
            elif act.verb is Verb.HOLD:
                await self._guard.do(words("done.hold"), desk.hold)
            elif act.verb is Verb.RESUME:
                await self._guard.do(words("done.resume"), desk.resume)
            elif act.verb is Verb.STOP:
                await self._guard.do(words("done.stop"), desk.stop_after_box)
            elif act.verb is Verb.SAMPLE:
                await self._guard.do(words("done.sample"), desk.sample)
                await self._told_anew()
            else:
                done = words("done.answer", choice=act.label)
                await self._guard.do(done, desk.answer, act.about, act.choice)

        return do


def _showing(button: ui.button, do: Callable[[], Awaitable[None]]) -> Callable[[], Awaitable[None]]:
    """A button that shows that it has been pressed until what it does is done."""

    async def press() -> None:
        button.props("loading")
        try:
            await do()
        finally:
            if not button.is_deleted:
                button.props(remove="loading")

    return press


def _told(todo: Todo) -> Markup:
    return tag(
        "div",
        icon(todo.icon),
        tag("div", tag("h2", todo.headline), tag("p", todo.detail)),
        cls="told",
    )
