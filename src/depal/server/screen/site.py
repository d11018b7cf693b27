"""The screen's pages, on the same application as the API."""

from collections.abc import Callable
from importlib.resources import files
from typing import Protocol

from fastapi import FastAPI, Request, Response
from fastapi.responses import HTMLResponse, RedirectResponse
from nicegui import app as screen
from nicegui import ui

from depal.server.cell import Cell
from depal.server.screen.desk import Desk
from depal.server.screen.entrance import SCRIPT, STYLE, first_page, sign_in_page
from depal.server.screen.hub import Hub
from depal.server.screen.picture import ADDRESS as PICTURE
from depal.server.screen.setup.products import ADDRESS as PRODUCT
from depal.server.screen.window import Window
from depal.server.screen.words import CATALOGUES, language_of, words_of

MAIN = "#2f3f4e"
"""Of whatever is chosen: no signal colour."""

EMPTY = (
    '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 64 64">'
    '<rect x="8" y="14" width="48" height="38" fill="#dedad2" stroke="#8a857b" stroke-width="2"/>'
    '<path d="M8 26h48M32 14v12" stroke="#8a857b" stroke-width="2" fill="none"/></svg>'
)
"""A box, for products without a picture."""


class Reception(Protocol):
    """Knows people by what their browser sends."""

    def desk(self, request: Request) -> Desk | None:
        """The desk of whoever is signed in; None where nobody is."""
        ...


def attach(app: FastAPI, cell: Cell, reception: Reception) -> None:
    """Adds the screen to an application.

    Args:
        app: with the API.
        cell: whose news are shown; commands go over desks alone.
        reception: knows who is signed in.
    """
    _add_pages(cell, reception)
    _add_pictures(reception)
    _add_files()
    ui.run_with(app, title="depal", tailwind=False, show_welcome_message=False)


def language_for(request: Request) -> str:
    """The language that was chosen on this browser, else the one that it prefers."""
    chosen = request.cookies.get("depal-language", "")
    if chosen in CATALOGUES:
        return chosen
    return language_of(request.headers.get("accept-language", ""))


def _add_pages(cell: Cell, reception: Reception) -> None:
    hub = Hub(cell)

    @ui.page("/", title="depal")
    async def window(request: Request) -> Response | None:
        desk = reception.desk(request)
        if desk is None:
            return RedirectResponse("/sign-in", 303)
        ui.add_head_html(f'<link rel="stylesheet" href="{STYLE}">')
        ui.colors(primary=MAIN)
        language = language_for(request)
        ui.query("html").props(f"lang={language}")
        page = Window(desk, hub, language)
        await page.live(ui.context.client)
        return None

    @screen.get("/sign-in")
    def sign_in(request: Request) -> HTMLResponse:
        language = language_for(request)
        return HTMLResponse(sign_in_page(language, words_of(language)))

    @screen.get("/first")
    def first(request: Request, code: str = "") -> HTMLResponse:
        language = language_for(request)
        return HTMLResponse(first_page(language, words_of(language), code[:200]))


def _add_pictures(reception: Reception) -> None:
    @screen.get(PICTURE)
    def picture(request: Request) -> Response:
        desk = reception.desk(request)
        if desk is None:
            return Response(status_code=401)
        return _image(desk.picture())

    @screen.get(PRODUCT + "/{gtin}")
    def product(request: Request, gtin: str) -> Response:
        desk = reception.desk(request)
        if desk is None:
            return Response(status_code=401)
        return _image(desk.product_picture(gtin))


def _image(content: bytes) -> Response:
    """A picture of a kind that browsers only draw."""
    headers = {"cache-control": "no-store", "x-content-type-options": "nosniff"}
    if not content:
        return Response(EMPTY, media_type="image/svg+xml", headers=headers)
    kind = "image/png" if content.startswith(b"\x89PNG") else "image/jpeg"
    return Response(content, media_type=kind, headers=headers)


def _add_files() -> None:
    """Style and script; they are the same for everybody."""
    for address, name, kind in (
        (STYLE, "style.css", "text/css"),
        (SCRIPT, "entrance.js", "text/javascript"),
    ):
        content = files("depal.server.screen").joinpath(name).read_text("utf-8")
        screen.get(address)(_serving(content, kind))


def _serving(content: str, kind: str) -> Callable[[], Response]:
    def serve() -> Response:
        return Response(content, media_type=kind, headers={"cache-control": "no-cache"})

    return serve
