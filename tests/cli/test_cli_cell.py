"""`depal cell` as a stranger types it."""

import json
from collections.abc import Callable
from pathlib import Path

import pytest

from depal.cell.files import SHIPPED, shipped_text
from depal.logistics import shipped_deliveries

Run = Callable[..., tuple[int, str, str]]


@pytest.mark.slow
def test_the_shipped_default_is_checked_written_and_drawn(depal: Run, tmp_path: Path) -> None:
    """Without an argument, in one command."""
    report, plot = tmp_path / "c.json", tmp_path / "c.png"
    status, out, err = depal("cell", "check", "--json", report, "--plot", plot)
    assert (status, err) == (0, "")
    assert "trolley_1/level_1" in out
    assert "sees 100.0 % of the pallet's front" in out
    fields = json.loads(report.read_text())
    assert {"version", "command", "cell", "holds", "pallet", "places", "cameras"} <= set(fields)
    assert fields["holds"] is True
    assert len(fields["places"]) == 14 * 3 * 2
    assert {row["grasp"] for row in fields["places"]} == {"horizontal", "vertical"}
    assert plot.read_bytes().startswith(b"\x89PNG")


def test_a_delivery_brings_its_own_boxes(depal: Run, tmp_path: Path) -> None:
    """Smallest, median and largest of its products; nothing is wrong with it."""
    name = shipped_deliveries()[0].id
    report = tmp_path / "c.json"
    status, out, _ = depal("cell", "check", "small_trolleys", "--delivery", name, "--json", report)
    assert status == 0
    assert f"small_trolleys: boxes of {name} on the pallet" in out
    fields = json.loads(report.read_text())
    assert fields["delivery"] == name
    assert [size["name"] for size in fields["sizes"]] == ["smallest", "median", "largest"]


def test_a_cell_that_cannot_work_is_said_with_status_1(depal: Run, tmp_path: Path) -> None:
    """Everything that is wrong with it, after the tables."""
    path = tmp_path / "mine.yaml"
    text = shipped_text("roll_containers").replace("front: [-1.90, -0.30]", "front: [-0.2, -0.3]")
    path.write_text(text, encoding="utf-8")
    status, out, err = depal("cell", "check", path)
    assert (status, err) == (1, "")
    assert "error: robot: overlaps container_3" in out


def test_a_file_that_is_no_cell_is_refused_with_status_2(depal: Run, tmp_path: Path) -> None:
    """With its line, before anything is checked."""
    path = tmp_path / "mine.yaml"
    path.write_text(shipped_text("default").replace("payload: 60", "payload: heavy"), "utf-8")
    status, out, err = depal("cell", "check", path)
    assert (status, out) == (2, "")
    assert "robot.payload: 'heavy' is text, not a number" in err


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (("cell", "check", "defalt"), "did you mean 'default'?"),
        (("cell", "check", "default", "--plot", "x.bmp"), "'x.bmp' is no picture's name"),
        (("cell", "check", "default", "--delivery", "dev-00"), "did you mean"),
        (("cell", "show", "trolleys"), "no shipped cell is called 'trolleys'"),
    ],
)
def test_bad_input_to_cell_teaches(depal: Run, words: tuple[str, ...], said: str) -> None:
    """One error, exit status 2."""
    status, _, err = depal(*words)
    assert status == 2
    assert said in err


@pytest.mark.parametrize("name", SHIPPED)
def test_a_shipped_cell_can_be_shown_and_saved(depal: Run, name: str) -> None:
    """To begin one's own from."""
    assert depal("cell", "show", name) == (0, shipped_text(name), "")
