"""A part of a page that is drawn anew only when it has changed."""

from collections.abc import Callable

from nicegui import ui

from depal.server.cellstate import CellState
from depal.server.screen.markup import Markup


class Pane:
    """Markup in a page."""

    def __init__(self, draw: Callable[[CellState], Markup], classes: str = "") -> None:
        """Empty until it is shown a state.

        Args:
            draw: the part for a state.
            classes: of the element.
        """
        self._draw = draw
        self.element = ui.html("").classes(classes)

    def show(self, state: CellState) -> None:
        """As the state is; nothing is sent where that looks the same."""
        found = self._draw(state)
        if found != self.element.content:
            self.element.content = str(found)
