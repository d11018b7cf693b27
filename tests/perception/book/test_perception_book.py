"""Laws of the product database."""

import json
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from depal.domain import Gtin, Product
from depal.errors import BookError, SettingError
from depal.perception.book import BOOK_FILE, read_book, write_book
from depal.perception.pictures import (
    SIDES,
    PictureBook,
    ProductPictures,
    extended,
    pixels,
    side_size,
)

CASE = Product(Gtin("12000823098180"), "article", (0.365, 0.202, 0.254), 5.4)
OTHER = Product(Gtin("12000807013116"), "Käse", (0.261, 0.231, 0.188), 5.787)


def picture_of(product: Product, side: str, seed: int) -> np.ndarray:
    """Any picture of the right shape."""
    width, height = pixels(side_size(product, side))
    random = np.random.default_rng(seed)
    return random.integers(0, 256, (height, width, 3), dtype=np.uint8)


def book_of_noise(seed: int = 0) -> PictureBook:
    """Two products, one of them with a single face."""
    faces = {side: picture_of(CASE, side, seed) for side in SIDES}
    return PictureBook(
        {
            CASE.gtin: ProductPictures(CASE, faces),
            OTHER.gtin: ProductPictures(OTHER, {"top": picture_of(OTHER, "top", seed)}),
        }
    )


def raw_of(folder: Path) -> dict[str, list[dict[str, object]]]:
    """The JSON of a book."""
    raw: dict[str, list[dict[str, object]]] = json.loads((folder / BOOK_FILE).read_text("utf-8"))
    return raw


def test_a_book_that_was_written_is_read_back_whole(tmp_path: Path) -> None:
    """Products and pictures survive the folder."""
    book = book_of_noise()
    write_book(book, tmp_path / "new" / "book")
    back = read_book(tmp_path / "new" / "book")
    assert set(back.entries) == set(book.entries)
    for gtin, entry in book.entries.items():
        assert back.entries[gtin].product == entry.product
        assert list(back.entries[gtin].faces) == list(entry.faces)
        for side, face in entry.faces.items():
            np.testing.assert_array_equal(back.entries[gtin].faces[side], face)


def test_the_same_book_gives_the_same_bytes(tmp_path: Path) -> None:
    """The order of the entries does not show."""
    book = book_of_noise()
    write_book(book, tmp_path / "a")
    write_book(PictureBook(dict(reversed(book.entries.items()))), tmp_path / "b")
    files = sorted(path.name for path in (tmp_path / "a").iterdir())
    assert files == sorted(path.name for path in (tmp_path / "b").iterdir())
    for name in files:
        assert (tmp_path / "a" / name).read_bytes() == (tmp_path / "b" / name).read_bytes()


@given(st.sampled_from(SIDES), st.integers(0, 5), st.floats(0.3, 2.0))
@settings(max_examples=20, deadline=None)
def test_a_shown_face_is_kept_at_one_pixel_per_millimetre(
    side: str, seed: int, scale: float
) -> None:
    """Whatever the resolution in which it was seen; the old book stays as it was."""
    width, height = pixels(side_size(OTHER, side))
    shown = np.full((round(height * scale), round(width * scale), 3), seed * 40, dtype=np.uint8)
    book = book_of_noise()
    larger = extended(book, OTHER, side, shown)
    assert larger.entries[OTHER.gtin].faces[side].shape == (height, width, 3)
    assert (larger.entries[OTHER.gtin].faces[side] == seed * 40).all()
    assert set(larger.entries[OTHER.gtin].faces) == {"top", side}
    assert larger.entries[CASE.gtin] is book.entries[CASE.gtin]
    assert set(book.entries[OTHER.gtin].faces) == {"top"}


def test_an_unknown_product_enters_an_empty_book() -> None:
    """The first picture makes the entry."""
    book = extended(PictureBook(), CASE, "end", picture_of(CASE, "end", 1))
    assert CASE.gtin in book
    assert OTHER.gtin not in book


def test_a_face_that_no_case_has_is_refused() -> None:
    """The error lists the faces."""
    with pytest.raises(SettingError, match=r"no face is called 'front'; there is: end, side, top"):
        extended(PictureBook(), CASE, "front", picture_of(CASE, "end", 1))


def test_a_picture_of_another_shape_is_refused() -> None:
    """It is probably another face."""
    with pytest.raises(SettingError, match="is 365 pixels wide and 202 high; expected"):
        extended(PictureBook(), CASE, "end", picture_of(CASE, "top", 1))


def test_a_grey_picture_is_refused() -> None:
    """Pictures have three channels."""
    with pytest.raises(SettingError, match=r"an array \(9, 9\) of uint8 is no colour picture"):
        extended(PictureBook(), CASE, "end", np.zeros((9, 9), dtype=np.uint8))


def test_a_folder_without_a_book_says_what_is_there(tmp_path: Path) -> None:
    """A wrong folder is noticed by its content."""
    (tmp_path / "holiday.png").write_bytes(b"")
    with pytest.raises(BookError, match=r"holds no picture book; .*; there is: holiday\.png"):
        read_book(tmp_path)
    with pytest.raises(BookError, match="there is nothing"):
        read_book(tmp_path / "nowhere")


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"gtin": "12000823098181"}, r"\[1\]\.gtin: 12000823098181 ends in the wrong check digit"),
        ({"gtin": 12000823098180}, "is no trade item number; expected 8, 12, 13 or 14 digits"),
        ({"gtin": "12000807013116"}, "12000807013116 stands here twice"),
        ({"size": [365, 202, 254]}, r"\[365, 202, 254\] is no size of a case; expected length"),
        ({"size": [0.3, 0.2]}, "is no size of a case"),
        ({"mass": -1}, "-1 is no mass; expected up to 100"),
        ({"mass": True}, "True is no mass"),
        ({"name": None}, "None is no text"),
        ({"maas": 1}, "maas: is no field; did you mean 'mass'?"),
        ({"faces": []}, r"\[\] is no object"),
        ({"faces": {"tip": "a.png"}}, r"faces\.tip: is no face of a case"),
        ({"faces": {"top": "../a.png"}}, "is no file's name"),
        ({"faces": {"top": "12000823098180-tip.png"}}, r"did you mean '12000823098180-top\.png'"),
        ({"faces": {"top": "12000823098180-end.png"}}, "the picture is 202 x 254 pixels; expected"),
        ({"faces": {"top": "book.json"}}, r"book\.json is no picture"),
    ],
)
def test_what_is_wrong_with_an_entry_is_named(
    tmp_path: Path, change: dict[str, object], message: str
) -> None:
    """Every field has its own sentence."""
    write_book(book_of_noise(), tmp_path)
    raw = raw_of(tmp_path)
    raw["products"][1].update(change)
    (tmp_path / BOOK_FILE).write_text(json.dumps(raw), "utf-8")
    with pytest.raises(BookError, match=message):
        read_book(tmp_path)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("{", "is not JSON"),
        ("[]", "version: None cannot be read; expected 1"),
        ('{"version": 1, "products": {}}', "products: is no list of objects"),
    ],
)
def test_a_json_that_is_no_book_is_named(tmp_path: Path, text: str, message: str) -> None:
    """The file's frame is read before its entries."""
    (tmp_path / BOOK_FILE).write_text(text, "utf-8")
    with pytest.raises(BookError, match=message):
        read_book(tmp_path)
