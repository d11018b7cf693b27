"""Writing a picture book."""

import json
from pathlib import Path

from PIL import Image

from depal.perception.pictures import SIDES, PictureBook

BOOK_FILE = "book.json"
"""The file that names products and pictures."""

VERSION = 1
"""Of the format."""


def write_book(book: PictureBook, folder: Path) -> None:
    """Writes a book as a folder that `read_book` takes.

    Products stand in the order of their numbers, so the same book gives the same bytes. The
    pictures are written first: a folder without its JSON is no book yet.

    Args:
        book: what to write.
        folder: where; made where there is none.
    """
    folder.mkdir(parents=True, exist_ok=True)
    products = []
    for gtin in sorted(book.entries):
        entry, faces = book.entries[gtin], dict[str, str]()
        for side in (side for side in SIDES if side in entry.faces):
            faces[side] = f"{gtin}-{side}.png"
            Image.fromarray(entry.faces[side]).save(folder / faces[side], format="PNG")
        product = entry.product
        products.append(
            {
                "gtin": gtin,
                "name": product.name,
                "size": list(product.size),
                "mass": product.mass,
                "faces": faces,
            }
        )
    text = json.dumps({"version": VERSION, "products": products}, indent=1, ensure_ascii=False)
    (folder / BOOK_FILE).write_text(text + "\n", "utf-8")
