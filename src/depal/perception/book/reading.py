"""Reading a picture book; everything that is wrong with it is said at once."""

import json
from collections.abc import Iterator
from pathlib import Path

import numpy as np
from biip.checksums import gs1_standard_check_digit
from PIL import Image, UnidentifiedImageError

from depal.domain import Gtin, Product
from depal.errors import BookError, Problem, did_you_mean
from depal.perception.book.writing import BOOK_FILE, VERSION
from depal.perception.pictures import (
    LARGEST,
    SIDES,
    SMALLEST,
    Picture,
    PictureBook,
    ProductPictures,
    pixels,
    side_size,
)

LENGTHS = (8, 12, 13, 14)
"""Digits of a GTIN (GS1 General Specifications, section 7.9.1)."""

HEAVIEST = 100.0
"""Of a case [kg]."""

ODD = 2
"""A picture's edges may differ from the product's by so many pixels."""

FIELDS = ("gtin", "name", "size", "mass", "faces")


def read_book(folder: Path) -> PictureBook:
    """Reads the folder of a picture book.

    Args:
        folder: as `write_book` leaves it.

    Raises:
        BookError: no such folder, no JSON in it, or anything wrong with products and pictures.
    """
    problems = list[Problem]()
    entries = dict[Gtin, ProductPictures]()
    for number, raw in enumerate(_products(folder)):
        where = f"products[{number}]"
        product = _product(raw, where, problems)
        if product is None:
            continue
        if product.gtin in entries:
            problems.append(Problem(f"{where}.gtin", f"{product.gtin} stands here twice"))
            continue
        faces = raw.get("faces", {})
        entries[product.gtin] = _pictures(product, faces, folder, f"{where}.faces", problems)
    if problems:
        raise BookError(str(folder / BOOK_FILE), problems)
    return PictureBook(entries)


def _products(folder: Path) -> list[dict[str, object]]:
    """The raw entries."""
    file = folder / BOOK_FILE
    try:
        raw = json.loads(file.read_text("utf-8"))
    except (FileNotFoundError, NotADirectoryError):
        there = sorted(path.name for path in folder.iterdir())[:5] if folder.is_dir() else []
        exists = f"there is: {', '.join(there)}" if there else "there is nothing"
        wanted = f"a folder with {BOOK_FILE} and pictures"
        raise BookError(
            str(folder), [Problem("", "holds no picture book", wanted, exists)]
        ) from None
    except (json.JSONDecodeError, UnicodeDecodeError) as error:
        raise BookError(str(file), [Problem("", f"is not JSON: {error}")]) from None
    version = raw.get("version") if isinstance(raw, dict) else None
    if version != VERSION:
        problem = Problem("version", f"{version!r} cannot be read", f"{VERSION}")
        raise BookError(str(file), [problem])
    products = raw.get("products")
    if not isinstance(products, list) or not all(isinstance(entry, dict) for entry in products):
        raise BookError(str(file), [Problem("products", "is no list of objects")])
    return products


def _product(raw: dict[str, object], where: str, problems: list[Problem]) -> Product | None:
    """The product of an entry; None and a problem where it cannot be used."""
    found = [*_unknown(raw, where), *_gtin_faults(raw.get("gtin"), f"{where}.gtin")]
    size, mass, name = raw.get("size"), raw.get("mass"), raw.get("name")
    if not isinstance(name, str):
        found.append(Problem(f"{where}.name", f"{name!r} is no text"))
    edges = [float(edge) for edge in size if _number(edge)] if isinstance(size, list) else []
    bounds = f"length, width and height from {SMALLEST} to {LARGEST} m"
    if len(edges) != len(SIDES) or not all(SMALLEST <= edge <= LARGEST for edge in edges):
        found.append(Problem(f"{where}.size", f"{size!r} is no size of a case", bounds))
    if not _number(mass) or not 0 < float(str(mass)) <= HEAVIEST:
        found.append(Problem(f"{where}.mass", f"{mass!r} is no mass", f"up to {HEAVIEST} kg"))
    problems += found
    if found:
        return None
    length, width, height = edges
    return Product(Gtin(str(raw["gtin"])), str(name), (length, width, height), float(str(mass)))


def _pictures(
    product: Product, faces: object, folder: Path, where: str, problems: list[Problem]
) -> ProductPictures:
    """The pictures that an entry names."""
    if not isinstance(faces, dict):
        problems.append(Problem(where, f"{faces!r} is no object", "faces with their files"))
        return ProductPictures(product)
    kept = dict[str, Picture]()
    for side, name in faces.items():
        at = f"{where}.{side}"
        if side not in SIDES:
            problems.append(Problem(at, "is no face of a case", exists=did_you_mean(side, SIDES)))
        elif not isinstance(name, str) or Path(name).name != name:
            problems.append(Problem(at, f"{name!r} is no file's name", "a PNG beside the JSON"))
        else:
            picture = _picture(folder / name, at, problems)
            if picture is not None and _fits(picture, product, side, at, problems):
                kept[side] = picture
    return ProductPictures(product, {side: kept[side] for side in SIDES if side in kept})


def _picture(file: Path, where: str, problems: list[Problem]) -> Picture | None:
    try:
        with Image.open(file) as image:
            return np.array(image.convert("RGB"))
    except FileNotFoundError:
        others = [path.name for path in file.parent.glob("*.png")]
        exists = did_you_mean(file.name, others)
        problems.append(Problem(where, f"there is no {file.name}", exists=exists))
    except (UnidentifiedImageError, OSError, SyntaxError):
        problems.append(Problem(where, f"{file.name} is no picture", "a PNG"))
    return None


def _fits(
    picture: Picture, product: Product, side: str, where: str, problems: list[Problem]
) -> bool:
    """Whether a picture has the face's shape."""
    (height, width), (wide, high) = picture.shape[:2], pixels(side_size(product, side))
    if abs(width - wide) <= ODD and abs(height - high) <= ODD:
        return True
    what = f"the picture is {width} x {height} pixels"
    wanted = f"{wide} x {high}, one per millimetre"
    problems.append(Problem(where, what, wanted))
    return False


def _unknown(raw: dict[str, object], where: str) -> Iterator[Problem]:
    """Fields that nobody knows."""
    for name in sorted(set(raw) - set(FIELDS)):
        yield Problem(f"{where}.{name}", "is no field", exists=did_you_mean(name, FIELDS))


def _gtin_faults(gtin: object, where: str) -> Iterator[Problem]:
    """What is wrong with a number."""
    if not (isinstance(gtin, str) and gtin.isascii() and gtin.isdigit() and len(gtin) in LENGTHS):
        yield Problem(
            where, f"{gtin!r} is no trade item number", "8, 12, 13 or 14 digits in quotes"
        )
    elif gtin[-1] != (right := str(gs1_standard_check_digit(gtin[:-1]))):
        yield Problem(where, f"{gtin} ends in the wrong check digit", right)


def _number(value: object) -> bool:
    return isinstance(value, int | float) and not isinstance(value, bool)
