"""The screen's pages, on the same application as the API."""

from collections.abc import Callable
from importlib.resources import files

from fastapi import FastAPI, Request, Response
from fastapi.responses import HTMLResponse, RedirectResponse
from nicegui import app as screen
from nicegui import ui

from depal.server.api import Exposure
from depal.server.problems import Answer, SignInNeeded
from depal.server.screen.desk import Desk, asked, desk_for
from depal.server.screen.entrance import SCRIPT, STYLE, first_page, sign_in_page
from depal.server.screen.hub import Hub
from depal.server.screen.picture import ADDRESS as PICTURE
from depal.server.screen.setup.products import ADDRESS as PRODUCT
from depal.server.screen.toast import ENTRANCE
from depal.server.screen.window import Window
from depal.server.screen.words import CATALOGUES, language_of, words_of
from depal.server.site import Site

MAIN = "#2f3f4e"
"""Of whatever is chosen: no signal colour."""

EMPTY = (
    '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 64 64">'
    '<rect x="8" y="14" width="48" height="38" fill="#dedad2" stroke="#8a857b" stroke-width="2"/>'
    '<path d="M8 26h48M32 14v12" stroke="#8a857b" stroke-width="2" fill="none"/></svg>'
)
"""A box, for products without a picture."""


def attach(app: FastAPI, site: Site, exposure: Exposure) -> None:
    """Adds the screen to an application.

    Args:
        app: with the API.
        site: what the use cases work with.
        exposure: how it is reached.
    """
    _add_pages(site, exposure)
    _add_pictures(site, exposure)
    _add_files()
    ui.run_with(app, title="depal", tailwind=False, show_welcome_message=False)


def language_for(request: Request) -> str:
    """The language that was chosen on this browser, else the one that it prefers."""
    chosen = request.cookies.get("depal-language", "")
    if chosen in CATALOGUES:
        return chosen
    return language_of(request.headers.get("accept-language", ""))


def _add_pages(site: Site, exposure: Exposure) -> None:
    hub = Hub(site.cell)

    @ui.page("/", title="depal")
    async def window(request: Request) -> Response | None:
        try:
            desk = await asked(desk_for, site, request.cookies.get(exposure.cookie))
        except SignInNeeded:
            return RedirectResponse(ENTRANCE, 303)
        ui.add_head_html(f'<link rel="stylesheet" href="{STYLE}">')
        ui.colors(primary=MAIN)
        language = language_for(request)
        ui.add_head_html(f'<script>document.documentElement.lang = "{language}"</script>')
        page = Window(desk, hub, language)
        await page.live(ui.context.client)
        return None

    @screen.get(ENTRANCE)
    def sign_in(request: Request) -> HTMLResponse:
        language = language_for(request)
        return HTMLResponse(sign_in_page(language, words_of(language)))

    @screen.get("/first")
    def first(request: Request, code: str = "") -> HTMLResponse:
        language = language_for(request)
        return HTMLResponse(first_page(language, words_of(language), code[:200]))


def _add_pictures(site: Site, exposure: Exposure) -> None:
    @screen.get(PICTURE)
    def picture(request: Request) -> Response:
        return _image(site, request.cookies.get(exposure.cookie), Desk.picture)

    @screen.get(PRODUCT + "/{gtin}")
    def product(request: Request, gtin: str) -> Response:
        secret = request.cookies.get(exposure.cookie)
        return _image(site, secret, lambda desk: desk.product_picture(gtin))


def _image(site: Site, secret: str | None, find: Callable[[Desk], bytes]) -> Response:
    """A picture of a kind that browsers only draw."""
    headers = {"cache-control": "no-store"}
    try:
        content = find(desk_for(site, secret))
    except Answer as answer:
        return Response(status_code=answer.status)
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
