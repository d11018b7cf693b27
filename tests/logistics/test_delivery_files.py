"""Files that cannot be read, JSON that is none, and what is read when all is well."""

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from depal.domain import EURO_PALLET, Delivery
from depal.errors import DeliveryError
from depal.logistics import read_deliveries

Raw = dict[str, Any]
Complaint = Callable[..., str]


def test_a_sound_file_gives_the_values_that_it_holds(toy_delivery: Delivery, tea: str) -> None:
    """Whole numbers become floats where a measure is meant."""
    line = toy_delivery.lines[1]
    assert toy_delivery.id == "toy"
    assert toy_delivery.pallet_size == EURO_PALLET
    assert (line.product.name, line.product.mass, line.count) == ("rice", 8.0, 1)
    assert isinstance(line.product.mass, float)
    assert toy_delivery.stack is not None
    assert (toy_delivery.stack[1].gtin, toy_delivery.stack[1].corner) == (tea, (0.4, 0.0, 0.0))


def test_without_a_stack_only_the_note_is_known(toy: Raw, tmp_path: Path) -> None:
    """The simulator stacks such a delivery itself."""
    del toy["stack"]
    (tmp_path / "note.json").write_text(json.dumps([toy]), encoding="utf-8")
    assert read_deliveries(tmp_path / "note.json")[0].stack is None


def test_a_byte_order_mark_is_no_mistake(toy: Raw, tmp_path: Path) -> None:
    """Some editors write one."""
    (tmp_path / "bom.json").write_text(json.dumps(toy), encoding="utf-8-sig")
    assert read_deliveries(tmp_path / "bom.json")[0].id == "toy"


def test_a_millimetre_is_tolerated_everywhere(toy: Raw, tmp_path: Path) -> None:
    """Sizes, edges of the pallet, overlaps and gaps: measured stacks are never exact."""
    toy["stack"][0]["corner"] = [-0.001, 0.0, 0.001]
    toy["stack"][1]["corner"][0] = 0.398
    toy["stack"][2]["size"] = [0.299, 0.301, 0.1]
    (tmp_path / "measured.json").write_text(json.dumps(toy), encoding="utf-8")
    assert len(read_deliveries(tmp_path / "measured.json")) == 1


@pytest.mark.parametrize(
    ("content", "message"),
    [
        ("", "line 1, column 1: is empty; expected JSON"),
        ('{"id":\n', "line 2, column 1: the file ends too early; expected JSON"),
        ('{"id": "a"\n "lines": []}', "line 2, column 2: unexpected '\"lines\":'; expected JSON"),
        ('{"id": "a', "line 1, column 8: a text that never ends: '\"a'; expected JSON"),
        ("{} {}", "line 1, column 4: more text after the end: '{}'; expected JSON"),
        ("[" * 100_000, "lists within lists, too deep to be a delivery"),
        (
            "gtin,name\n",
            (
                "line 1, column 1: unexpected 'gtin,name'; expected JSON; "
                "a note as CSV is told by the file's ending .csv"
            ),
        ),
        ("7", "7 is no delivery; expected an object, or a list of them"),
        ("null", "null is no delivery; expected an object, or a list of them"),
        ("[]", "the list has no deliveries; expected 1 to 10000 of them"),
        (f"[{'1,' * 10_000}1]", "the list has 10001 deliveries; expected 1 to 10000 of them"),
        (
            json.dumps(dict.fromkeys(map(str, range(101)))),
            "an object has 101 keys; expected a delivery, whose objects have few",
        ),
        (b'{"id":\n"\xff"}', "line 2: byte 0xff is not UTF-8; expected a text file in UTF-8"),
        (b" " * (64 * 1024 * 1024 + 1), "is larger than 64 MiB; expected a smaller file"),
    ],
    ids=lambda value: "" if len(value) > 60 else None,
)
def test_what_is_no_json_is_refused_with_its_place(
    complaint: Complaint, content: str | bytes, message: str
) -> None:
    """Line and column, in words that do not change with the version of Python."""
    assert complaint(content) == f"DeliveryError: in.json: {message}"


def test_a_key_that_stands_twice_is_refused_wherever_it_is(toy: Raw, complaint: Complaint) -> None:
    """JSON would silently keep the last value."""
    text = json.dumps(toy).replace('"name": "rice"', '"name": "rice", "name": "corn", "name": "x"')
    assert complaint(text) == (
        "DeliveryError: in.json: lines[1].name: the key stands here twice; expected every key once"
    )


def test_a_key_that_is_no_text_is_refused_in_printable_words(
    toy: Raw, complaint: Complaint
) -> None:
    """Half of a surrogate pair is valid JSON and no character."""
    text = json.dumps({**toy, "\ud800": 1})
    assert complaint(text).startswith(r"DeliveryError: in.json: ['\\ud800']: unknown key; there is")


def test_a_missing_file_names_the_files_that_exist(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Close names first, else all of the kind, else that there are none."""
    monkeypatch.chdir(tmp_path)
    (tmp_path / "monday.json").touch()
    (tmp_path / "notes.txt").touch()
    (tmp_path / "empty").mkdir()
    told = {}
    for name in ("mnday.json", "x.json", "empty/x.json", "none/x.json", "notes.txt/x.json"):
        with pytest.raises(DeliveryError) as caught:
            read_deliveries(Path(name))
        told[name] = str(caught.value)
    assert told == {
        "mnday.json": "mnday.json: no such file; did you mean 'monday.json'?",
        "x.json": "x.json: no such file; there is: monday.json",
        "empty/x.json": "empty/x.json: no such file; the folder has no .json or .csv file",
        "none/x.json": "none/x.json: no such file; there is no folder 'none' either",
        "notes.txt/x.json": (
            "notes.txt/x.json: no such file; there is no folder 'notes.txt' either"
        ),
    }


def test_a_directory_names_the_files_in_it(tmp_path: Path) -> None:
    """The file inside is probably what was meant."""
    (tmp_path / "a.json").touch()
    with pytest.raises(DeliveryError, match=r"is a directory; expected a file; there is: a\.json$"):
        read_deliveries(tmp_path)


def test_a_name_that_the_system_refuses_is_no_crash() -> None:
    """For instance one with a zero byte, or one that is too long."""
    with pytest.raises(DeliveryError, match=r"cannot be read: embedded null byte$"):
        read_deliveries(Path("a\0.json"))
    with pytest.raises(DeliveryError, match=r"cannot be read: File name too long$"):
        read_deliveries(Path("a" * 3000))


def test_a_folder_that_may_not_be_listed_is_no_crash(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The suggestion is left out then."""

    def forbidden(_: Path) -> None:
        raise PermissionError

    monkeypatch.setattr(Path, "iterdir", forbidden)
    with pytest.raises(DeliveryError, match=r"no such file; the folder has no"):
        read_deliveries(tmp_path / "x.json")
