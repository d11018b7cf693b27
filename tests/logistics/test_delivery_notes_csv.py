"""Delivery notes as CSV."""

from collections.abc import Callable
from pathlib import Path

import pytest

from depal.domain import EURO_PALLET
from depal.logistics import read_deliveries

Complaint = Callable[..., str]

HEADER = "gtin,name,length_m,width_m,height_m,mass_kg,count"
TEA = "12000823098180,tea,0.4,0.3,0.2,5.5,2"
RICE = "12000807013116,rice,0.3,0.3,0.1,8,1"
SIDE = "metres, from 0.001 to 2.5"


def test_a_note_is_a_delivery_on_the_default_pallet(tmp_path: Path) -> None:
    """Its id is the file's name; how it is stacked is not known; blank lines do not matter."""
    path = tmp_path / "monday.csv"
    path.write_text(
        f'\n{HEADER}\r\n{TEA}\n\n , \n"12000807013116","rice, ""long""", .3,3e-1,.1,8,1'
    )
    (delivery,) = read_deliveries(path)
    assert (delivery.id, delivery.pallet_size, delivery.stack) == ("monday", EURO_PALLET, None)
    assert [line.count for line in delivery.lines] == [2, 1]
    assert delivery.lines[1].product.name == 'rice, "long"'
    assert delivery.lines[1].product.size == (0.3, 0.3, 0.1)


def test_a_spreadsheets_byte_order_mark_is_no_mistake(tmp_path: Path) -> None:
    """Excel writes one in front of CSV in UTF-8."""
    (tmp_path / "a.CSV").write_text(f"{HEADER}\n{TEA}", encoding="utf-8-sig")
    assert len(read_deliveries(tmp_path / "a.CSV")[0].boxes) == 2


@pytest.mark.parametrize(
    ("content", "message"),
    [
        ("", f"no header; expected {HEADER}"),
        (HEADER, "the note has no lines; expected one line per product"),
        (
            HEADER.replace(",", ";"),
            (
                "line 1: the cells are separated by semicolons; "
                f"expected commas, and points in numbers: {HEADER}"
            ),
        ),
        (
            HEADER.replace(",", "\t"),
            (
                f"line 1: the cells are separated by tabs; expected commas, and points in numbers: "
                f"{HEADER}"
            ),
        ),
        (
            f"gtin,name\n{TEA}",
            f"line 1: the header is 'gtin,name'; expected exactly {HEADER}",
        ),
        (
            f'"{HEADER}\n{TEA}',
            (
                "line 1: its quotes do not match, or a cell is endless; "
                'expected a quote inside a quoted cell is doubled: "12"" tray"'
            ),
        ),
        (
            f"{HEADER}\n{TEA}\n{RICE},1",
            (
                f"line 3: 8 cells; expected 7: {HEADER}; "
                "numbers take a decimal point, and a name with a comma takes quotes"
            ),
        ),
        (f"{HEADER}\n{TEA}\nx", f"line 3: 1 cell; expected 7: {HEADER}"),
        (
            f"{HEADER}\n{TEA}\n{RICE.replace(',', ';')}",
            f"line 3: 1 cell; expected 7: {HEADER}; the cells are separated by semicolons",
        ),
        (
            f'{HEADER}\n{TEA}\n"12" tray",rice',
            (
                "line 3: its quotes do not match, or a cell is endless; "
                'expected a quote inside a quoted cell is doubled: "12"" tray"'
            ),
        ),
        (
            f"{HEADER}\n\n{TEA.replace('0.3', 'three')}",
            f"line 3, width_m: 'three' is text, not a number; expected {SIDE}",
        ),
        (
            f"{HEADER}\n{TEA.replace('0.2', chr(34) + '0,2' + chr(34))}",
            f"line 2, height_m: '0,2' is text, not a number; expected {SIDE}",
        ),
        (
            f"{HEADER}\n{TEA.replace('0.4', '400')}",
            f"line 2, length_m: 400 is above 2.5 m: millimetres?; expected {SIDE}",
        ),
        (
            f"{HEADER}\n{TEA.replace('5.5', 'nan')}",
            (
                "line 2, mass_kg: 'nan' is text, not a number; "
                "expected mass of one full case [kg], above 0 and at most 1000"
            ),
        ),
        (
            f"{HEADER}\n{TEA[:-1]}2.0",
            (
                "line 2, count: 2.0 is not a whole number; "
                "expected how many cases of the product came, a whole number from 1 to 10000"
            ),
        ),
        (
            f"{HEADER}\n1.20008E+13{TEA[14:]}",
            (
                "line 2, gtin: '1.20008E+13' was rounded by a spreadsheet; "
                "expected 8, 12, 13 or 14 digits, from a column formatted as text"
            ),
        ),
        (
            f"{HEADER}\n{TEA.replace('tea', '')}",
            "line 2, name: is empty; expected what people call the product",
        ),
        (
            f"{HEADER}\nlines[9]{TEA[14:]}",
            (
                "line 2, gtin: 'lines[9]' is not made of digits alone; "
                "expected 8, 12, 13 or 14 digits"
            ),
        ),
        (
            f"{HEADER}\n{RICE}\n\n{TEA}\n{TEA}",
            (
                "line 5, gtin: '12000823098180' is already on line 4; "
                "expected each product on one line"
            ),
        ),
        (
            HEADER + f"\n{TEA}" * 10_001,
            "has 10001 lines; expected 1 to 10000 of them",
        ),
        (
            HEADER + "\nx" * 20_000,
            "has more than 20000 lines; expected a note of up to 10000 lines",
        ),
    ],
    ids=lambda value: value[-60:],
)
def test_a_mistake_in_a_note_is_named_by_line_and_column(
    complaint: Complaint, content: str, message: str
) -> None:
    """A spreadsheet's user finds the cell."""
    assert complaint(content, "note.csv") == f"DeliveryError: note.csv: {message}"


def test_all_mistakes_of_a_note_are_reported_by_line(complaint: Complaint) -> None:
    """Cells, rows and quotes alike; a row that cannot be split does not hide the next."""
    content = f'{HEADER}\n{TEA},\n{RICE.replace(",8,", ",-8,")}\n"a"b\n{TEA.replace("0.4", "4")}\n'
    assert [
        line.split(":")[0].strip() for line in complaint(content, "n.csv").splitlines()[1:]
    ] == [
        "line 2",
        "line 3, mass_kg",
        "line 4",
        "line 5, length_m",
    ]


def test_a_file_whose_name_is_no_name_is_refused(complaint: Complaint) -> None:
    """The id of a note is the name of its file."""
    assert complaint(f"{HEADER}\n{TEA}", " .csv") == (
        "DeliveryError:  .csv: the file's name: is empty; "
        "expected the delivery's name, unique in its file"
    )
