"""People: who may do what."""

from nicegui import ui

from depal.server.people import PersonView
from depal.server.roles import PEOPLE, Role
from depal.server.screen.desk import Desk, asked
from depal.server.screen.markup import tag
from depal.server.screen.pane import html
from depal.server.screen.toast import Guard
from depal.server.screen.words import Words

RANKS = tuple(role for role in Role if role in PEOPLE)


class PeoplePart:
    """The accounts."""

    def __init__(self, desk: Desk, words: Words, guard: Guard) -> None:
        """Empty until it is opened."""
        self._desk, self._words, self._guard = desk, words, guard
        self._roles = {role.value: words(f"role.{role.value}") for role in RANKS}
        with ui.element("section").classes("card"):
            with ui.element("div").classes("head"):
                html(words("setup.people"), "h2").classes("h3")
                add = ui.button(words("person.add"), icon="person_add", color=None)
                add.on_click(self._add)
                add.props("no-caps unelevated").classes("act is-main")
            self._list = ui.element("ul").classes("lines")
        self._form = ui.dialog()

    async def open(self) -> None:
        """As it is now."""
        people = await asked(self._desk.people)
        self._list.clear()
        with self._list:
            for person in people:
                self._line(person)

    def _line(self, person: PersonView) -> None:
        words, name = self._words, person.name
        me = words("person.you") if name == self._desk.who.name else None
        with ui.element("li").classes("line"):
            html(tag("div", tag("strong", name), tag("small", me))).classes("told")

            async def change() -> None:
                role = Role(str(select.value))
                if role is not person.role:
                    done = words("done.role", name=name, role=self._roles[role.value])
                    await self._guard.do(done, self._desk.change_role, name, role)
                    await self.open()

            select = ui.toggle(self._roles, value=person.role.value, on_change=change)
            select.props("no-caps unelevated")
            select.props["aria-label"] = words("person.role_of", name=name)
            password = ui.button(words("person.password"), color=None)
            password.on_click(lambda: self._password(name))
            password.props("no-caps unelevated").classes("act")
            remove = ui.button(icon="delete", color=None, on_click=lambda: self._remove(name))
            remove.props("flat").classes("small")
            remove.props["aria-label"] = words("person.remove", name=name)

    def _add(self) -> None:
        words = self._words
        self._form.clear()
        self._form.props["aria-label"] = words("person.add")
        with self._form, ui.card().classes("form"):
            html(words("person.add"), "h2").classes("h3")
            name = ui.input(words("person.name")).props("outlined autocomplete=off").classes("wide")
            html(words("person.role"), "p")
            role = ui.toggle(self._roles, value=Role.OPERATOR.value)
            role.props("no-caps unelevated spread").classes("wide")
            role.props["aria-label"] = words("person.role")
            password = _secret(words)

            async def add() -> None:
                done = words("done.person", name=name.value)
                given = (name.value, Role(str(role.value)), password.value)
                if await self._guard.do(done, self._desk.add_person, *given):
                    self._form.close()
                    await self.open()

            self._foot(words("person.add"), add)
        self._form.open()

    def _password(self, name: str) -> None:
        words = self._words
        self._form.clear()
        self._form.props["aria-label"] = words("person.password_of", name=name)
        with self._form, ui.card().classes("form"):
            html(words("person.password_of", name=name), "h2").classes("h3")
            password = _secret(words)

            async def put() -> None:
                done = words("done.password", name=name)
                if await self._guard.do(done, self._desk.set_password, name, password.value):
                    self._form.close()

            self._foot(words("act.keep"), put)
        self._form.open()

    def _remove(self, name: str) -> None:
        words = self._words
        self._form.clear()
        self._form.props["aria-label"] = words("person.remove_sure", name=name)
        with self._form, ui.card().classes("form"):
            html(words("person.remove_sure", name=name), "h2").classes("h3")

            async def remove() -> None:
                done = words("done.removed", name=name)
                if await self._guard.do(done, self._desk.remove_person, name):
                    self._form.close()
                    await self.open()

            self._foot(words("person.remove_now"), remove)
        self._form.open()

    def _foot(self, label: str, do: object) -> None:
        with ui.element("div").classes("acts"):
            close = ui.button(self._words("act.close"), color=None, on_click=self._form.close)
            close.props("no-caps unelevated").classes("act")
            button = ui.button(label, color=None, on_click=do)  # type: ignore[arg-type]
            button.props("no-caps unelevated").classes("act is-main")


def _secret(words: Words) -> ui.input:
    field = ui.input(words("person.new_password"), password=True, password_toggle_button=True)
    return field.props("outlined autocomplete=new-password").classes("wide")
