"""`depal tasks` as a stranger types it."""

import json
from collections.abc import Callable
from pathlib import Path
from xml.etree import ElementTree as ET

import pytest
import typer
from typer.testing import CliRunner

from depal.cell.files import shipped_text
from depal.cli.tasks import tasks
from depal.errors import InputError

Run = Callable[..., tuple[int, str]]

BROKEN = """\
fact Box.done : flag
task work(Box) until Box.done
  - actt(Box)
action act(Box) until Box.done sets Box.done
"""

STUCK = """\
fact Box.a    : flag
fact Box.done : flag

task work(Box) until Box.done
  - first(Box)
  - last(Box)  when not Box.a

action first(Box) until Box.a sets Box.a

action last(Box) until Box.done sets Box.done
"""


@pytest.fixture(name="run")
def _run() -> Run:
    """A command's exit status and what it says; 2 for an input that cannot be used."""
    app = typer.Typer()
    app.add_typer(tasks, name="tasks")

    def run(*words: object) -> tuple[int, str]:
        result = CliRunner().invoke(app, ["tasks", *map(str, words)])
        if isinstance(result.exception, InputError):
            return 2, str(result.exception)
        if result.exception is not None and not isinstance(result.exception, SystemExit):
            raise result.exception
        return result.exit_code, result.output

    return run


def test_the_shipped_files_are_checked_by_name(run: Run, tmp_path: Path) -> None:
    """And the findings are written."""
    report = tmp_path / "check.json"
    for name in ("store", "cell"):
        status, out = run("check", name, "--json", report)
        assert status == 0
        assert "no mistakes" in out
    fields = json.loads(report.read_text())
    assert fields["mistakes"] == 0
    assert {"kind", "serious", "where", "what", "exists"} == set(fields["findings"][0])


def test_a_mistake_is_said_and_ends_with_status_1(run: Run, tmp_path: Path) -> None:
    """With what was meant."""
    file = tmp_path / "broken.task"
    file.write_text(BROKEN)
    status, out = run("check", file)
    assert status == 1
    assert "unknown subtask 'actt'; did you mean 'act'?" in out


LIMITED = """\
fact Box.done : flag
task work(Box) until Box.done limit tilt 5 deg, margin at least 0.03 g avoids aisle
  - act(Box)
action act(Box) until Box.done sets Box.done
"""


def test_limits_are_checked_always_and_zones_with_their_cell(run: Run, tmp_path: Path) -> None:
    """Quantities, units and sides are the same in every cell."""
    file, cell = tmp_path / "limited.task", tmp_path / "mine.yaml"
    file.write_text(LIMITED)
    zone = "zones:\n  - {name: isle, centre: [1.0, 0.5, 1.0], size: [0.1, 0.1, 0.1]}\n"
    cell.write_text(shipped_text("default") + zone)
    assert run("check", file)[0] == 0
    status, out = run("check", file, "--cell", cell)
    assert status == 1
    assert "the cell has no zone 'aisle'; did you mean 'isle'?" in out
    cell.write_text(cell.read_text().replace("isle", "aisle"))
    assert run("check", file, "--cell", cell)[0] == 0
    file.write_text(LIMITED.replace("margin at least", "margin").replace("5 deg", "5 m"))
    status, out = run("check", file)
    assert status == 1
    assert "tilt is measured in rad, not in m" in out
    assert "margin is bounded from below: write 'limit margin at least'" in out


@pytest.mark.parametrize("command", ["show", "explore"])
def test_what_has_mistakes_is_neither_drawn_nor_explored(
    run: Run, tmp_path: Path, command: str
) -> None:
    """Its tree would mean nothing."""
    file = tmp_path / "broken.task"
    file.write_text(BROKEN)
    status, out = run(command, file, "work")
    assert status == 2
    assert "did you mean 'act'?" in out


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (("check", "nothing"), "there is no file 'nothing'"),
        (("show", "store", "stroe"), "store has no task 'stroe'; did you mean 'store'?"),
        (("show", "cell"), "several tasks to choose from; there is: ask_person, bring"),
        (("show", "store", "store(a, b)"), "store takes 1 arguments, 2 given"),
        (("show", "store", "store(a"), "'store(a' is no call of a task"),
        (
            ("show", "store", "--format", "sgv"),
            "unknown format 'sgv'; there is: mermaid, svg, text",
        ),
        (("show", "store", "--facts", "Box.taken"), "'Box.taken' has no value"),
        (("show", "store", "--facts", "Box.tkn=true"), "did you mean 'Box.taken'?"),
        (("explore", "store", "--disturb", "Box.tkn"), "did you mean 'Box.taken'?"),
        (("show", "store", "--out", "no/such/folder.svg"), "there is no folder"),
    ],
)
def test_what_cannot_be_used_is_refused_with_what_exists(
    run: Run, words: tuple[str, ...], said: str
) -> None:
    """Exit status 2."""
    status, out = run(*words)
    assert status == 2
    assert said in out


def test_a_task_is_shown_with_its_states(run: Run) -> None:
    """The only task that nobody calls needs no name."""
    status, out = run("show", "store", "--facts", "Box.taken=true,kr60.at=Box")
    assert status == 0
    assert "▶ enabled, may run" in out
    assert "enabled" not in run("show", "store", "take")[1]


def test_a_task_is_drawn_into_a_file(run: Run, tmp_path: Path) -> None:
    """As SVG, and as Mermaid to the terminal."""
    file = tmp_path / "store.svg"
    status, out = run("show", "store", "store(b1)", "--format", "svg", "--out", file)
    assert (status, out) == (0, "")
    root = ET.fromstring(file.read_text())  # noqa: S314 - our own text
    assert root.tag.endswith("svg")
    assert run("show", "store", "--format", "mermaid")[1].startswith("flowchart TD\n")


def test_a_task_is_explored_and_its_hazards_end_with_status_1(run: Run, tmp_path: Path) -> None:
    """None in the store as it is; one where changes are split."""
    report = tmp_path / "explored.json"
    assert run("explore", "store", "store(b1)", "--disturb", "Box.taken=false")[0] == 0
    status, out = run("explore", "store", "store(b1)", "--split", "--json", report)
    assert status == 1
    assert "acts on half a change: kr60_reach(b1) starts before" in out
    hazards = json.loads(report.read_text())["hazards"]
    assert hazards[0]["trace"][-1]["what"] == "kr60_reach(b1) starts"
    assert run("explore", "store", "--limit", 10)[1].count("the limit was reached") == 1
    status, out = run("explore", "store", "store(b1)", "store(b2)")
    assert status == 0
    assert "together(store(b1), store(b2)): all " in out


def test_an_exploration_may_start_from_given_facts(run: Run, tmp_path: Path) -> None:
    """From the middle of a task."""
    file = tmp_path / "stuck.task"
    file.write_text(STUCK)
    status, out = run("explore", file, "--facts", "Box.a=true")
    assert status == 1
    assert "dead end: first(Box) is accomplished; last(Box) needs not Box.a" in out
    assert "idle: last(Box) never starts" in out


def test_a_file_is_laid_out(run: Run, tmp_path: Path) -> None:
    """Printed, compared, written."""
    file = tmp_path / "work.task"
    file.write_text(STUCK.replace("\n\n", "\n").replace("Box.a    :", "Box.a:"))
    printed = run("format", file)[1]
    assert run("format", file, "--check")[0] == 1
    assert run("format", file, "--write")[0] == 0
    assert file.read_text() == printed
    assert run("format", file, "--check")[0] == 0
    assert run("format", "cell", "--check")[0] == 0
