"""Text and markup in a page: the only way in, and everything that is no markup is escaped."""

from collections.abc import Callable

from nicegui import ui

from depal.server.cellstate import CellState
from depal.server.screen.markup import Content, Markup, text


def html(content: Content = "", name: str = "div") -> ui.html:
    """An element with text or markup in it.

    Args:
        content: markup as it is, all else escaped.
        name: of the element.
    """
    return ui.html(str(text(content)), tag=name)


def put(element: ui.html, content: Content) -> None:
    """Other text or markup in an element; nothing is sent where it is the same."""
    found = str(text(content))
    if found != element.content:
        element.content = found


class Pane:
    """A part of a page that is drawn anew only when it has changed."""

    def __init__(self, draw: Callable[[CellState], Markup], classes: str = "") -> None:
        """Empty until it is shown a state.

        Args:
            draw: the part for a state.
            classes: of the element.
        """
        self._draw = draw
        self.element = html().classes(classes)

    def show(self, state: CellState) -> None:
        """As the state is."""
        put(self.element, self._draw(state))
