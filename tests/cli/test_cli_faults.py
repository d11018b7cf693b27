"""`depal study faults`, `depal run --faults` and `depal schema faults` as commands."""

import json
from collections.abc import Callable
from pathlib import Path

import pytest

Run = Callable[..., tuple[int, str, str]]


@pytest.mark.slow
def test_the_study_writes_a_row_for_each_fault(depal: Run, tmp_path: Path) -> None:
    """With the fields of the contract."""
    file, picture = tmp_path / "faults.json", tmp_path / "faults.png"
    words = ("study", "faults", "--faults", "G1,W3", "--seeds", 1)
    status, _, _ = depal(*words, "--json", file, "--plot", picture)
    assert status == 0
    rows = json.loads(file.read_text("utf-8"))["rows"]
    assert [row["fault"] for row in rows] == ["G1", "W3"]
    for row in rows:
        assert (row["seeds"], row["ended"], row["invariants"], row["without_person"]) == (
            1,
            1,
            1,
            1,
        )
    assert picture.stat().st_size > 0


def test_an_unknown_fault_is_one_error(depal: Run) -> None:
    """Before anything runs, and with what there is."""
    status, _, errors = depal("study", "faults", "--faults", "G9x")
    assert status == 2
    assert "unknown fault 'G9x'" in errors


def test_a_bad_file_of_faults_is_one_error(depal: Run, tmp_path: Path) -> None:
    """With everything that is wrong with it; nothing moves."""
    file = tmp_path / "faults.yaml"
    file.write_text("- {fault: Q1}\n- {fault: G3, when: {p: 2}}\n", "utf-8")
    status, _, errors = depal("run", "--faults", file)
    assert status == 2
    assert "unknown fault 'Q1'" in errors
    assert "2 is above 1" in errors


def test_the_schema_of_faults_names_them_all(depal: Run) -> None:
    """As JSON."""
    status, printed, _ = depal("schema", "faults")
    assert status == 0
    assert "G3" in json.loads(printed)["$defs"]["FaultEntry"]["properties"]["fault"]["enum"]
