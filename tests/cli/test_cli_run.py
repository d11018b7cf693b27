"""`depal run` as a stranger types it."""

import json
from collections.abc import Callable
from pathlib import Path

import pytest

import depal.app.run.job
from depal.app.reports.report import Report
from depal.app.run.job import prepared
from depal.app.run.tasks import tasks_of
from depal.app.run.values import Options
from depal.cell.files import shipped_cell
from depal.cell.tasks import read_shipped_tasks
from depal.executive.language import format_repository

Run = Callable[..., tuple[int, str, str]]

SMALL = {
    "id": "small",
    "pallet": {"size": [1.2, 0.8, 0.144]},
    "lines": [
        {"gtin": "12000900000013", "name": "a", "size": [0.28, 0.25, 0.22], "mass": 4, "count": 1},
        {"gtin": "12000900000020", "name": "b", "size": [0.25, 0.3, 0.2], "mass": 6, "count": 1},
    ],
    "stack": [
        {"gtin": "12000900000013", "corner": [0.3, 0.0, 0.0], "size": [0.28, 0.25, 0.22]},
        {"gtin": "12000900000020", "corner": [0.3, 0.3, 0.0], "size": [0.25, 0.3, 0.2]},
    ],
}
"""Two cases, one behind the other."""


@pytest.fixture(name="depal")
def _depal(depal: Run) -> Run:
    """The same, of `depal run`."""
    return lambda *words: depal("run", *words)


@pytest.fixture(name="delivery")
def _delivery(tmp_path: Path) -> Path:
    path = tmp_path / "small.json"
    path.write_text(json.dumps(SMALL), encoding="utf-8")
    return path


@pytest.fixture(name="nothing_moves")
def _nothing_moves(monkeypatch: pytest.MonkeyPatch) -> None:
    """Whatever is refused is refused before the cell is built."""

    def build(*_: object, **__: object) -> None:
        raise AssertionError("a cell was built")

    monkeypatch.setattr(depal.app.run.job, "build", build)


@pytest.mark.slow
def test_a_delivery_is_emptied_and_the_result_written(
    depal: Run, delivery: Path, tmp_path: Path
) -> None:
    """Status 0; the JSON names version and command too."""
    target = tmp_path / "run.json"
    wanted = tmp_path / "wanted.yaml"
    wanted.write_text('- {at: 0 s, gtin: "12000900000020", priority: 0.8}\n', encoding="utf-8")
    status, out, err = depal(
        delivery, "--requests", wanted, "--w", "0.25", "--seed", "4", "--json", target
    )
    assert (status, err) == (0, "")
    assert "small: 2 boxes" in out
    assert "2 of 2" in out
    fields = json.loads(target.read_text("utf-8"))
    assert {"version", "command"} <= set(fields)
    assert (fields["delivery"], fields["boxes"], fields["stored"]) == ("small", 2, 2)
    assert (fields["w"], fields["seed"], fields["speed"]) == (0.25, 4, 1.0)
    assert (fields["policy"], fields["perception"]) == ("paper", "camera")
    assert [entry["stack"] for entry in fields["sequence"]] == [0, 1]
    (request,) = fields["requests"]
    assert (request["gtin"], request["boxes_before"]) == ("12000900000020", 1)
    assert len(fields["events_sha256"]) == 64


@pytest.mark.slow
def test_a_slower_arm_takes_longer(depal: Run, delivery: Path, tmp_path: Path) -> None:
    """`--speed` is a share of the axes' full speed; straight moves are slow anyway."""
    times = []
    for speed in ("1", "0.1"):
        target = tmp_path / f"{speed}.json"
        assert depal(delivery, "--speed", speed, "--json", target)[0] == 0
        times.append(json.loads(target.read_text("utf-8"))["sim_seconds"])
    assert times[1] > 2 * times[0]


@pytest.mark.parametrize("holds", [True, False])
def test_the_status_says_whether_the_run_holds(
    depal: Run, monkeypatch: pytest.MonkeyPatch, tmp_path: Path, *, holds: bool
) -> None:
    """0 where it does, 1 where something was lost; the result is written in any case."""
    asked: list[Options] = []

    def run_delivery(options: Options, *, watch: bool, say: Callable[[str], None]) -> Report:
        asked.append(options)
        assert callable(say)
        return Report({"watched": watch}, ["shown"], holds=holds)

    monkeypatch.setattr(depal_job(), "run_delivery", run_delivery)
    target = tmp_path / "r.json"
    status, out, err = depal("dev-000", "--cell", "roll_containers", "--json", target)
    assert (status, out, err) == (0 if holds else 1, "shown\n", "")
    assert json.loads(target.read_text("utf-8"))["watched"] is True
    assert asked == [Options(delivery="dev-000", cell="roll_containers", perception="camera")]


def depal_job() -> object:
    """The module whose function the command calls."""
    return depal.app.run.job


WRONG = [
    (("--w", "3"), "--w: 3.0 is out of range; expected a number in [0, 1]"),
    (("--w", "nan"), "--w: nan is not a number; expected a number in [0, 1]"),
    (("--speed", "0"), "--speed: 0.0 is out of range; expected a number in (0, 1]"),
    (("--speed", "2"), "--speed: 2.0 is out of range; expected a number in (0, 1]"),
    (("--speed", "nan"), "--speed: nan is out of range; expected a number in (0, 1]"),
    (("--policy", "papr"), "--policy: unknown policy 'papr'; did you mean 'paper'?"),
    (("--perception", "eyes"), "--perception: unknown perception 'eyes'; there is: camera, truth"),
    (
        ("--cell", "defalt"),
        (
            "neither a file nor a shipped cell is called 'defalt'; expected FILE or a shipped "
            "cell's name; did you mean 'default'? "
            "(there is: default, roll_containers, small_trolleys)"
        ),
    ),
    (
        ("dev-0000",),
        (
            "neither a file nor a shipped delivery is called 'dev-0000'; expected FILE, FILE#ID or "
            "a shipped delivery's id; did you mean 'dev-000'?"
        ),
    ),
    (("--json", "nowhere/x.json"), "--json: there is no folder 'nowhere'"),
]


@pytest.mark.usefixtures("nothing_moves")
@pytest.mark.parametrize(("words", "message"), WRONG)
def test_what_cannot_be_used_is_one_error_and_nothing_moves(
    depal: Run, words: tuple[str, ...], message: str
) -> None:
    """Exit status 2; what, where, what was expected, what exists."""
    status, out, err = depal(*words)
    assert (status, out) == (2, "")
    assert err.startswith(f"error: {message}")
    assert err.count("error:") == 1
    assert "Traceback" not in err


@pytest.mark.usefixtures("nothing_moves")
def test_task_files_that_this_cell_cannot_follow_are_refused(depal: Run, tmp_path: Path) -> None:
    """With every mistake: zones that it does not have, and tasks that it calls by itself."""
    own = tmp_path / "own.task"
    text = format_repository(read_shipped_tasks())
    own.write_text(text.replace("limit speed cell.speed", "limit tilt 5 deg avoids aisle", 1))
    status, out, err = depal("--tasks", own)
    assert (status, out) == (2, "")
    assert f"error: {own}: store(Box), avoids: the cell has no zone 'aisle'; its file" in err
    own.write_text("fact a.b : flag\naction show_it(Box) until a.b sets a.b\n")
    _, _, err = depal("--tasks", own)
    assert "no primitive is bound to 'show_it'" in err
    assert "there is no task 'depalletize', which the cell calls by itself" in err


def test_own_task_files_are_taken_in_place_of_the_shipped_ones(tmp_path: Path) -> None:
    """One or several; without any, nothing is read."""
    own = tmp_path / "own.task"
    text = format_repository(read_shipped_tasks())
    own.write_text(text.replace("limit speed cell.speed", "limit tilt 5 deg", 1))
    tasks = prepared(Options(tasks=(str(own),))).tasks
    assert tasks is not None
    (limit,) = tasks.schemata["store"].limits
    assert (limit.quantity, limit.bound, limit.unit) == ("tilt", 5.0, "deg")
    assert prepared(Options()).tasks is None
    assert tasks_of((), shipped_cell()) == read_shipped_tasks()


@pytest.mark.usefixtures("nothing_moves")
def test_requests_for_another_delivery_are_refused(
    depal: Run, delivery: Path, tmp_path: Path
) -> None:
    """With file, line and what the note has."""
    wanted = tmp_path / "wanted.yaml"
    wanted.write_text('- {at: 0 s, gtin: "12000823098180", priority: 0.8}\n', encoding="utf-8")
    status, out, err = depal(delivery, "--requests", wanted)
    assert (status, out) == (2, "")
    assert f"error: {wanted}" in err
    assert "line 1" in err
    assert "'12000823098180' is not on the note of the delivery" in err


@pytest.mark.usefixtures("nothing_moves")
def test_a_delivery_on_another_pallet_is_refused(depal: Run, tmp_path: Path) -> None:
    """Before anything moves."""
    path = tmp_path / "other.json"
    path.write_text(json.dumps({**SMALL, "pallet": {"size": [1.2, 1.0, 0.144]}}), encoding="utf-8")
    status, out, err = depal(path)
    assert (status, out) == (2, "")
    assert "delivery small in cell default: pallet: the delivery comes on a pallet of" in err
    assert "expected 1.2 x 0.8 x 0.144 m, which default takes" in err


@pytest.mark.usefixtures("nothing_moves")
def test_a_record_is_never_written_over(depal: Run, delivery: Path, tmp_path: Path) -> None:
    """A folder with a record is refused."""
    (tmp_path / "journal.db").write_bytes(b"")
    status, out, err = depal(delivery, "--record", tmp_path)
    assert (status, out) == (2, "")
    assert f"error: {tmp_path}: holds a record already; expected a new folder" in err
