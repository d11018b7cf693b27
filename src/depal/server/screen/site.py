"""The screen's pages, on the same application as the API."""

from importlib.resources import files

from fastapi import FastAPI, Request, Response
from nicegui import app as screen
from nicegui import ui

from depal.server.cell import Cell
from depal.server.screen.hub import Hub
from depal.server.screen.interim import Interim, InterimDesk
from depal.server.screen.picture import ADDRESS
from depal.server.screen.window import Window
from depal.server.screen.words import CATALOGUES, language_of


def language_for(request: Request) -> str:
    """The language that was chosen on this browser, else the one that it prefers."""
    chosen = request.cookies.get("depal-language", "")
    if chosen in CATALOGUES:
        return chosen
    return language_of(request.headers.get("accept-language", ""))


def attach(app: FastAPI, cell: Cell) -> None:
    """Adds the screen to an application."""
    shared = Interim(cell)
    hub = Hub(cell)
    style = files("depal.server.screen").joinpath("style.css").read_text("utf-8")

    @ui.page("/", title="depal")
    async def window(request: Request) -> None:
        ui.add_css(style)
        desk = InterimDesk(shared)
        page = Window(desk, hub, language_for(request))
        await page.live(ui.context.client)

    @screen.get(ADDRESS)
    def picture() -> Response:
        found = cell.picture()
        return Response(found, media_type="image/jpeg", headers={"cache-control": "no-store"})

    ui.run_with(app, title="depal", tailwind=False, storage_secret=None, show_welcome_message=False)
