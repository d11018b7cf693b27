"""What one window asks of the use cases: the only way from here to the cell.

Everything may wait for a database or the cell's thread: call it with `asked`, off the loop.
"""

import asyncio
import json
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TypeVar

from depal.domain import CellLayout, Product
from depal.logistics import shipped_deliveries
from depal.server.cell import Settings
from depal.server.people import PersonView, TokenView
from depal.server.problems import Conflict, NotFound, SignInNeeded
from depal.server.records import QueuedView, RunView
from depal.server.records.documents import document_of
from depal.server.records.queue import QUEUED, RUNNING
from depal.server.roles import Principal, Role
from depal.server.site import Site
from depal.server.usecases import deliveries, managing, wanting, working
from depal.server.usecases.deliveries import ProductView

T = TypeVar("T")

FACE = "front"
"""The face of a product that the screen shows."""

PAGE, MOST = 500, 5000
"""Products are read so many at once, and no more than that."""

DAY = 86400.0


@dataclass(frozen=True, slots=True)
class Desk:
    """A signed-in window.

    Attributes:
        site: what the use cases work with.
        secret: of the session; who that is, is looked up anew for every use case.
        who: signed in when the window was opened.
    """

    site: Site
    secret: str
    who: Principal

    def me(self) -> Principal | None:
        """Who is signed in now; None once the session has ended."""
        return self.site.sessions.who(self.secret)

    @property
    def layout(self) -> CellLayout:
        """The cell."""
        return self.site.cell.layout

    # The cell

    def start(self, delivery: str | None) -> None:
        """Begins with a delivery, or goes on."""
        working.start(self.site, self.me(), delivery)

    def hold(self) -> None:
        """Nothing new begins."""
        working.hold(self.site, self.me())

    def resume(self) -> None:
        """Goes on."""
        working.resume(self.site, self.me())

    def stop_after_box(self) -> None:
        """Finishes the box in hand."""
        working.stop_after_box(self.site, self.me())

    def answer(self, question: str, choice: str) -> None:
        """Answers a question."""
        wanting.answer_question(self.site, self.me(), question, choice)

    def picture(self) -> bytes:
        """The camera's last one; empty where there is none."""
        try:
            return working.see_picture(self.site, self.me())
        except NotFound:
            return b""

    def settings(self) -> tuple[Settings, int]:
        """Of the cell, and their version."""
        kept = working.see_settings(self.site, self.me())
        return kept.settings, kept.version

    def put_settings(self, settings: Settings, version: int) -> None:
        """Other settings, unless somebody has changed them meanwhile."""
        working.change_settings(
            self.site,
            self.me(),
            w=settings.w,
            speed=settings.speed,
            policy=settings.policy,
            version=version,
        )

    # Deliveries and products

    def deliveries(self) -> Sequence[QueuedView]:
        """The one on the pallet, then those that wait, the next first."""
        found = deliveries.list_deliveries(self.site, self.me())
        return [each for each in found if each.state in {QUEUED, RUNNING}]

    def upload(self, name: str, content: bytes) -> None:
        """Adds the deliveries of a file to the queue."""
        text = content.decode("utf-8", "replace")
        deliveries.add_deliveries(self.site, self.me(), text, name)

    def sample(self) -> None:
        """Adds a delivery that ships with the package: the first that was not used yet."""
        known = {each.id for each in deliveries.list_deliveries(self.site, self.me())}
        found = next((each for each in shipped_deliveries() if each.id not in known), None)
        if found is None:
            raise Conflict("all sample deliveries have been used")
        text = json.dumps(document_of(found))
        deliveries.add_deliveries(self.site, self.me(), text, "sample.json")

    def move_delivery(self, name: str, position: int, version: int) -> None:
        """Earlier or later in the queue."""
        deliveries.move_delivery(self.site, self.me(), name, position, version)

    def cancel_delivery(self, name: str, version: int) -> None:
        """Not to be emptied any more."""
        deliveries.cancel_delivery(self.site, self.me(), name, version)

    def products(self) -> Sequence[ProductView]:
        """Those that the store knows, by name."""
        found = [product for page in self._pages() for product in page]
        return sorted(found, key=lambda product: product.name.casefold())

    def _pages(self) -> Iterator[Sequence[ProductView]]:
        after = ""
        for _ in range(MOST // PAGE):
            page = deliveries.list_products(self.site, self.me(), "", after, PAGE)
            yield page
            if len(page) < PAGE:
                return
            after = page[-1].gtin

    def put_product(self, product: Product) -> None:
        """Keeps what a product is called, measures and weighs."""
        deliveries.put_product(
            self.site, self.me(), product.gtin, product.name, product.size, product.mass
        )

    def product_picture(self, gtin: str) -> bytes:
        """Its front; empty where there is none."""
        try:
            return deliveries.get_picture(self.site, self.me(), gtin, FACE)[1]
        except NotFound:
            return b""

    def put_picture(self, gtin: str, content: bytes) -> None:
        """Keeps a product's front."""
        deliveries.put_picture(self.site, self.me(), gtin, FACE, content)

    # Requests

    def add_request(
        self,
        gtin: str | None,
        box: str | None,
        priority: float,
        due: float | None,
        repeat: str | None = None,
    ) -> None:
        """Asks for a product or a box.

        Args:
            gtin: the product.
            box: or the box.
            priority: p in [0, 1].
            due: seconds since 1970, if at all.
            repeat: the same one asks once.
        """
        wanting.add_request(
            self.site, self.me(), gtin=gtin, box=box, priority=priority, due=due, repeat=repeat
        )

    def change_request(self, key: str, priority: float) -> None:
        """Another priority; when it is due stays."""
        kept = wanting.get_request(self.site, self.me(), key)
        wanting.change_request(
            self.site, self.me(), key, version=kept.version, priority=priority, due=kept.due
        )

    def cancel_request(self, key: str) -> None:
        """Not wanted any more."""
        wanting.cancel_request(self.site, self.me(), key)

    # The past

    def runs(self) -> Sequence[RunView]:
        """The latest runs, the latest first."""
        return managing.list_runs(self.site, self.me())

    def record(self, number: int) -> Path:
        """The folder with the record of a run."""
        return managing.open_record(self.site, self.me(), number)

    # People

    def people(self) -> Sequence[PersonView]:
        """The accounts."""
        return managing.list_people(self.site, self.me())

    def add_person(self, name: str, role: Role, password: str) -> None:
        """A new account."""
        managing.add_person(self.site, self.me(), name, role.value, password)

    def change_role(self, name: str, role: Role) -> None:
        """Somebody may do more or less."""
        managing.change_person(self.site, self.me(), name, role.value)

    def set_password(self, name: str, password: str) -> None:
        """Another password."""
        managing.set_password(self.site, self.me(), name, password)

    def remove_person(self, name: str) -> None:
        """Somebody leaves."""
        managing.remove_person(self.site, self.me(), name)

    def tokens(self) -> Sequence[TokenView]:
        """The ways in for systems that are good."""
        now = self.site.chance.now()
        found = managing.list_tokens(self.site, self.me())
        return [each for each in found if each.revoked is None and each.expires > now]

    def add_token(self, name: str, days: float) -> str:
        """A new one, which is shown this once."""
        return managing.add_token(self.site, self.me(), name, days).secret

    def revoke_token(self, token: str) -> None:
        """Good no more."""
        managing.revoke_token(self.site, self.me(), token)


def desk_for(site: Site, secret: str | None) -> Desk:
    """The desk of a browser.

    Args:
        site: what the use cases work with.
        secret: of the session, from the browser's cookie.

    Raises:
        SignInNeeded: nobody is signed in.
    """
    who = site.sessions.who(secret) if secret else None
    if secret is None or who is None:
        raise SignInNeeded("sign in first")
    return Desk(site, secret, who)


async def asked(function: Callable[..., T], *arguments: object) -> T:
    """Calls a use case away from the loop, which it must not keep."""
    return await asyncio.to_thread(function, *arguments)
