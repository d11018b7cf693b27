"""The camera's last picture with what was seen in it."""

from nicegui import ui

from depal.server.cellstate import CellState
from depal.server.screen.pane import html
from depal.server.screen.words import Words

ADDRESS = "/screen/picture"


class CameraPicture:
    """An image that changes with its number; the browser asks for it, signed in."""

    def __init__(self, words: Words) -> None:
        """No picture yet."""
        self._number = 0
        with ui.element("section").classes("card camera"):
            html(words("picture.title"), "h3")
            self._none = html(words("picture.none"), "p").classes("quiet")
            self._image = ui.element("img").props(f'alt="{words("picture.what")}"')
            self._image.set_visibility(False)

    def show(self, state: CellState) -> None:
        """As the state is."""
        if state.picture == self._number:
            return
        self._number = state.picture
        self._image.set_visibility(bool(state.picture))
        self._none.set_visibility(not state.picture)
        if state.picture:
            self._image.props["src"] = f"{ADDRESS}?number={state.picture}"
            self._image.update()
