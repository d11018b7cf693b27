"""Pictures of products, face by face."""

from dataclasses import dataclass

from sqlalchemy import select

from depal.errors import Problem
from depal.logistics.store import Database
from depal.logistics.store.served_tables import PictureRow
from depal.logistics.store.tables import ProductRow
from depal.server.chance import Chance
from depal.server.problems import NotFound, TooLarge, Unusable, WrongType

FACES = ("front", "back", "left", "right", "top", "bottom")

LARGEST = 5 * 2**20
"""Of a picture [byte]."""

KINDS = {b"\x89PNG\r\n\x1a\n": "image/png", b"\xff\xd8\xff": "image/jpeg"}
"""How files begin that are taken."""


@dataclass(frozen=True, slots=True)
class PictureView:
    """A picture without its bytes.

    Attributes:
        gtin: of the product.
        face: which.
        type: "image/png" or "image/jpeg".
        size: [byte].
        by: who uploaded it.
        at: seconds since 1970.
    """

    gtin: str
    face: str
    type: str
    size: int
    by: str
    at: float


class Pictures:
    """Over the store's database."""

    def __init__(self, database: Database, chance: Chance) -> None:
        """The pictures in it."""
        self._database, self._chance = database, chance

    def put(self, gtin: str, face: str, body: bytes, by: str) -> PictureView:
        """A picture for one face, in place of the one before.

        Raises:
            NotFound: there is no such product.
            Unusable: there is no such face.
            TooLarge: the file is too large.
            WrongType: it is no PNG and no JPEG.
        """
        if face not in FACES:
            raise Unusable("no such face", [Problem("face", f"{face[:20]!r}", ", ".join(FACES))])
        if len(body) > LARGEST:
            raise TooLarge(f"the picture has {len(body)} bytes; expected at most {LARGEST}")
        kind = next((kind for head, kind in KINDS.items() if body.startswith(head)), None)
        if kind is None:
            raise WrongType("the picture is no PNG and no JPEG")
        with self._database.session() as session:
            if session.get(ProductRow, gtin) is None:
                raise NotFound(f"there is no product {gtin!r}")
            at = self._chance.now()
            row = PictureRow(gtin=gtin, face=face, type=kind, body=body, by=by, at=at)
            session.merge(row)
            return _view(row)

    def get(self, gtin: str, face: str) -> tuple[PictureView, bytes]:
        """A picture with its bytes.

        Raises:
            NotFound: there is none.
        """
        with self._database.session() as session:
            row = session.get(PictureRow, (gtin, face))
            if row is None:
                raise NotFound(f"there is no picture of the {face[:20]} of product {gtin!r}")
            return _view(row), row.body

    def list(self, gtin: str) -> tuple[PictureView, ...]:
        """Those of a product."""
        with self._database.session() as session:
            query = select(PictureRow).where(PictureRow.gtin == gtin).order_by(PictureRow.face)
            return tuple(_view(row) for row in session.scalars(query))


def _view(row: PictureRow) -> PictureView:
    return PictureView(row.gtin, row.face, row.type, len(row.body), row.by, row.at)
