"""Products: what they are called, measure and weigh, and their picture."""

from nicegui import ui

from depal.domain import Gtin, Product
from depal.server.screen.desk import Desk, asked
from depal.server.screen.files import choose
from depal.server.screen.markup import tag
from depal.server.screen.pane import html, put
from depal.server.screen.toast import Guard
from depal.server.screen.words import Words
from depal.server.usecases.deliveries import ProductView

ADDRESS = "/screen/product"
"""Where a product's picture is."""

SHOWN = 40
"""So many at once; the search finds the others."""


class ProductsPart:
    """The store's products."""

    def __init__(self, desk: Desk, words: Words, guard: Guard) -> None:
        """Empty until it is opened."""
        self._desk, self._words, self._guard = desk, words, guard
        self._products: list[ProductView] = []
        self._changes = 0
        with ui.element("section").classes("card"):
            html(words("setup.products"), "h2").classes("h3")
            self._search = ui.input(words("product.search"), on_change=self._show)
            self._search.props("outlined clearable").classes("wide")
            self._count = html("", "p").classes("quiet")
            self._list = ui.element("ul").classes("lines")
        self._form = ui.dialog()

    async def open(self) -> None:
        """As it is now."""
        self._products = list(await asked(self._desk.products))
        self._show()

    def _show(self) -> None:
        wanted = (self._search.value or "").casefold()
        found = [p for p in self._products if wanted in f"{p.name} {p.gtin}".casefold()]
        put(self._count, self._words("product.count", count=len(found)))
        self._list.clear()
        with self._list:
            for product in found[:SHOWN]:
                self._line(product)

    def _line(self, product: ProductView) -> None:
        words = self._words
        size = " x ".join(f"{100 * edge:.1f}" for edge in product.size)
        told = words("product.about", gtin=product.gtin, size=size, mass=f"{product.mass:.2f}")
        with ui.element("li").classes("line"):
            picture = ui.element("img").classes("front")
            picture.props["src"] = f"{ADDRESS}/{product.gtin}?change={self._changes}"
            picture.props["alt"] = words("product.picture_of", name=product.name)
            html(tag("div", tag("strong", product.name), tag("small", told))).classes("told")
            change = ui.button(words("act.change"), color=None)
            change.on_click(lambda: self._open(product))
            change.props("no-caps unelevated").classes("act")
            change.props["aria-label"] = words("product.change", name=product.name)
            button = ui.button(words("product.picture"), icon="photo_camera", color=None)
            button.props("no-caps unelevated").classes("act")
            button.props["aria-label"] = words("product.new_picture", name=product.name)

            async def bring(_: str, content: bytes) -> None:
                done = words("done.picture")
                await self._guard.do(done, self._desk.put_picture, product.gtin, content)
                self._changes += 1
                self._show()

            choose(button, "image/png,image/jpeg", words("file.too_large"), bring)

    def _open(self, product: ProductView) -> None:
        words = self._words
        self._form.clear()
        self._form.props["aria-label"] = words("product.title", gtin=product.gtin)
        with self._form, ui.card().classes("form"):
            html(words("product.title", gtin=product.gtin), "h2").classes("h3")
            name = ui.input(words("product.name"), value=product.name).props("outlined")
            name.classes("wide")
            edges = [
                ui.number(words(f"product.{edge}"), value=100 * value, min=1, max=200, precision=1)
                for edge, value in zip(("length", "width", "height"), product.size, strict=True)
            ]
            mass = ui.number(words("product.mass"), value=product.mass, min=0.01, max=60)
            for field in (*edges, mass):
                field.props("outlined").classes("wide")
            with ui.element("div").classes("acts"):
                close = ui.button(words("act.close"), color=None, on_click=self._form.close)
                close.props("no-caps unelevated").classes("act")

                async def keep() -> None:
                    length, width, height = ((edge.value or 0) / 100 for edge in edges)
                    changed = Product(
                        Gtin(product.gtin), name.value, (length, width, height), mass.value or 0
                    )
                    done = words("done.kept")
                    if await self._guard.do(done, self._desk.put_product, changed):
                        self._form.close()
                        await self.open()

                button = ui.button(words("act.keep"), color=None, on_click=keep)
                button.props("no-caps unelevated").classes("act is-main")
        self._form.open()
