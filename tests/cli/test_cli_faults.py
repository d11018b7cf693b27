"""`depal study faults`, `depal run --faults` and `depal schema faults` as commands."""

import json
import resource
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import pytest

from depal.executive.journal import SqliteJournal

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


@pytest.mark.slow
def test_pairs_are_counted_and_one_of_them_runs_again_to_the_byte(
    depal: Run, tmp_path: Path
) -> None:
    """With its record; three times the same events."""
    file, record = tmp_path / "faults.json", tmp_path / "record"
    words = ("study", "faults", "--faults", "G1,W3", "--seeds", 1, "--pairs", 2)
    status, printed, _ = depal(*words, "--json", file)
    assert status == 0
    found = json.loads(file.read_text("utf-8"))
    assert found["pairs"] == {"n": 2, "broken": []}
    assert found["runs"] == 4
    assert found["checks"] > 0
    assert found["recovery"]["n"] > 0
    assert found["recovery"]["p95"] <= 5.0
    assert "pairs: 2" in printed
    hashes = set()
    for option in ((), (), ("--record", record)):
        depal("study", "faults", "--replay", "G1+W3:4", *option, "--json", file)
        hashes.add(json.loads(file.read_text("utf-8"))["events_sha256"])
    assert len(hashes) == 1
    assert depal("replay", record)[0] == 0


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (("--replay", "G1"), "'G1' names no run; expected FAULT:SEED"),
        (("--replay", "G1+Q7:3"), "unknown fault 'Q7'"),
        (("--record", "here"), "a study keeps no records; expected --replay RUN"),
        (("--faults", "G1", "--pairs", "3"), "one fault makes no pair"),
    ],
)
def test_what_cannot_be_run_is_one_error(depal: Run, words: tuple[str, ...], message: str) -> None:
    """Before anything runs."""
    status, _, errors = depal("study", "faults", *words)
    assert status == 2
    assert message in errors


@pytest.mark.slow
def test_a_record_that_the_disk_does_not_take_is_one_error_and_what_is_written_is_whole(
    tmp_path: Path,
) -> None:
    """No file grows beyond 300 KiB: the run stops where it was, and its record can be replayed."""
    record = tmp_path / "record"
    words = ("run", "case2", "--perception", "truth", "--record", str(record))

    def little_room() -> None:
        limit = 300 * 1024
        resource.setrlimit(resource.RLIMIT_FSIZE, (limit, limit))

    ran = subprocess.run(  # noqa: S603 - our own command
        [sys.executable, "-c", "from depal.cli.main import main; main()", *words],
        capture_output=True,
        text=True,
        check=False,
        preexec_fn=little_room,
    )
    assert ran.returncode == 1
    (said,) = ran.stderr.splitlines()
    assert said.startswith("error: the cell has stopped where it was: ")
    with SqliteJournal(record / "journal.db", readonly=True) as journal:
        assert journal.verify() > 0


def test_a_shift_alone_is_run_and_what_was_found_is_written(depal: Run, tmp_path: Path) -> None:
    """Nothing but the shift where no faults are asked for."""
    path = tmp_path / "shift.json"
    status, _, told = depal("study", "faults", "--seeds", 0, "--shift", 12, "--json", path)
    assert status == 0, told
    shift = json.loads(path.read_text("utf-8"))["shift"]
    assert (shift["boxes"], shift["lost"], shift["misplaced"]) == (12, 0, 0)


def test_nothing_to_run_and_an_unknown_world_are_told(depal: Run) -> None:
    """One error each, with what there is."""
    status, _, told = depal("study", "faults", "--seeds", 0)
    assert (status, told.count("\n")) == (2, 1)
    assert "nothing is to be run" in told
    status, _, told = depal("study", "faults", "--shift", 5, "--world", "moon")
    assert status == 2
    assert "light, physics" in told


def test_a_study_goes_on_from_the_runs_that_are_kept(depal: Run, tmp_path: Path) -> None:
    """The same table, and nothing is run again; a damaged run is."""
    kept, first, second = tmp_path / "kept", tmp_path / "1.json", tmp_path / "2.json"
    words = ("study", "faults", "--faults", "W3", "--seeds", 1, "--shift", 12, "--keep", kept)
    assert depal(*words, "--json", first)[0] == 0
    files = {path.name: path.read_bytes() for path in kept.iterdir()}
    assert len(files) == 2
    assert depal(*words, "--json", second)[0] == 0
    assert {path.name: path.read_bytes() for path in kept.iterdir()} == files
    rows = [json.loads(path.read_text("utf-8"))["rows"] for path in (first, second)]
    assert rows[0] == rows[1]
    (damaged,) = (path for path in kept.iterdir() if path.name.startswith("W3"))
    damaged.write_text("{", "utf-8")
    assert depal(*words, "--json", second)[0] == 0
    again = json.loads(damaged.read_text("utf-8"))
    before = json.loads(files[damaged.name])
    assert again["events_sha256"] == before["events_sha256"]
    assert again["verdict"] == before["verdict"]
