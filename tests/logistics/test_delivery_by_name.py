"""One delivery by its file, by FILE#ID or by the id of one that ships."""

import json
from pathlib import Path
from typing import Any

import pytest

from depal.errors import DeliveryError
from depal.logistics import read_delivery, shipped_deliveries

Raw = dict[str, Any]

SHIPPED = (
    "there is: dev-000, dev-002, dev-017, dev-018, dev-024, dev-026, dev-030, dev-035, dev-041, "
    "dev-056"
)


@pytest.fixture
def week(toy: Raw, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> str:
    """A file with two deliveries in the current folder."""
    monkeypatch.chdir(tmp_path)
    Path("week.json").write_text(json.dumps([toy, {**toy, "id": "toy#2"}]), encoding="utf-8")
    return "week.json"


def test_the_shipped_deliveries_go_from_small_to_large() -> None:
    """Ten real ones, the smallest with 20 cases, the largest with 51, one 1.5 m high."""
    deliveries = shipped_deliveries()
    sizes = [len(delivery.boxes) for delivery in deliveries]
    tops = [case.corner[2] + case.size[2] for d in deliveries for case in d.stack or ()]
    assert sizes == sorted(sizes)
    assert (len(sizes), sizes[0], sizes[-1]) == (10, 20, 51)
    assert max(tops) == pytest.approx(1.517)
    assert max(len(delivery.lines) for delivery in deliveries) == 14


def test_every_shipped_delivery_is_found_by_its_id() -> None:
    """And is the same value."""
    assert all(read_delivery(delivery.id) == delivery for delivery in shipped_deliveries())


def test_an_existing_file_wins_over_a_shipped_delivery(toy: Raw, week: str) -> None:
    """A directory of that name does not: it holds no delivery itself."""
    assert week
    Path("dev-000").mkdir()
    assert read_delivery("dev-000").id == "dev-000"
    Path("dev-000").rmdir()
    Path("dev-000").write_text(json.dumps(toy), encoding="utf-8")
    assert read_delivery("dev-000").id == "toy"


def test_one_of_several_is_picked_by_its_id(week: str) -> None:
    """Also where the id or the file's name holds the mark itself."""
    assert read_delivery(f"{week}#toy").id == "toy"
    assert read_delivery(f"{week}#toy#2").id == "toy#2"
    Path(week).rename("week#47.json")
    assert read_delivery("week#47.json#toy#2").id == "toy#2"


def test_a_file_with_one_delivery_needs_no_id(toy: Raw, week: str) -> None:
    """Though its id may be named."""
    Path(week).write_text(json.dumps([toy]), encoding="utf-8")
    assert read_delivery(week) == read_delivery(f"{week}#toy")


@pytest.mark.parametrize(
    ("reference", "message"),
    [
        ("week.json", "week.json: has 2 deliveries; expected week.json#ID; there is: toy, toy#2"),
        (
            "week.json#tyo#2",
            (
                "week.json: no delivery is called 'tyo#2'; did you mean 'toy#2'? "
                "(there is: toy, toy#2)"
            ),
        ),
        ("week.json#", "week.json: no delivery is called ''; there is: toy, toy#2"),
        ("wek.json#toy", "wek.json: no such file; did you mean 'week.json'?"),
        ("wek.json", "wek.json: no such file; did you mean 'week.json'?"),
        ("./x/y", "x/y: no such file; there is no folder 'x' either"),
        (
            "dev-0000",
            (
                "neither a file nor a shipped delivery is called 'dev-0000'; "
                "expected FILE, FILE#ID or a shipped delivery's id; "
                f"did you mean 'dev-000'? ({SHIPPED})"
            ),
        ),
        (
            "#\0",
            (
                "neither a file nor a shipped delivery is called '#\\x00'; "
                f"expected FILE, FILE#ID or a shipped delivery's id; {SHIPPED}"
            ),
        ),
    ],
)
def test_a_name_that_means_no_single_delivery_is_refused(
    week: str, reference: str, message: str
) -> None:
    """With what is close and what there is."""
    assert Path(week).exists()
    with pytest.raises(DeliveryError) as caught:
        read_delivery(reference)
    assert str(caught.value) == message


def test_a_name_that_is_too_long_for_the_system_is_no_crash() -> None:
    """It is not repeated in full."""
    with pytest.raises(DeliveryError, match=r"is called 'x{60}\.\.\.'"):
        read_delivery("x" * 5000)
