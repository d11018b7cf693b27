"""The screen's pages, on the same application as the API."""

from importlib.resources import files
from pathlib import Path

from fastapi import FastAPI, Request, Response
from nicegui import app as screen
from nicegui import ui

from depal.server.cell import Cell
from depal.server.screen.hub import Hub
from depal.server.screen.interim import Interim, InterimDesk
from depal.server.screen.picture import ADDRESS
from depal.server.screen.setup.products import ADDRESS as PRODUCTS
from depal.server.screen.window import Window
from depal.server.screen.words import CATALOGUES, language_of

MAIN = "#2f3f4e"
"""Of whatever is chosen: no signal colour."""


def language_for(request: Request) -> str:
    """The language that was chosen on this browser, else the one that it prefers."""
    chosen = request.cookies.get("depal-language", "")
    if chosen in CATALOGUES:
        return chosen
    return language_of(request.headers.get("accept-language", ""))


def attach(app: FastAPI, cell: Cell, records: Path | None = None) -> None:
    """Adds the screen to an application."""
    shared = Interim(cell, records)
    hub = Hub(cell)
    style = files("depal.server.screen").joinpath("style.css").read_text("utf-8")

    @ui.page("/", title="depal")
    async def window(request: Request) -> None:
        ui.add_css(style)
        ui.colors(primary=MAIN)
        desk = InterimDesk(shared)
        language = language_for(request)
        ui.query("html").props(f"lang={language}")
        page = Window(desk, hub, language)
        await page.live(ui.context.client)

    @screen.get(ADDRESS)
    def picture() -> Response:
        found = cell.picture()
        return Response(found, media_type="image/jpeg", headers={"cache-control": "no-store"})

    @screen.get(PRODUCTS + "/{gtin}")
    def product(gtin: str) -> Response:
        found = InterimDesk(shared).product_picture(gtin)
        kind = "image/png" if found[:4] == b"\x89PNG" else "image/jpeg"
        if not found:
            return Response(EMPTY, media_type="image/svg+xml")
        return Response(found, media_type=kind)

    ui.run_with(app, title="depal", tailwind=False, show_welcome_message=False)


EMPTY = (
    '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 64 64">'
    '<rect x="8" y="14" width="48" height="38" fill="#dedad2" stroke="#8a857b" stroke-width="2"/>'
    '<path d="M8 26h48M32 14v12" stroke="#8a857b" stroke-width="2" fill="none"/></svg>'
)
"""A box, for products without a picture."""
