"""`depal replay` as a stranger types it."""

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

pytestmark = pytest.mark.slow  # a process each

ROOT = Path(__file__).resolve().parent.parent.parent


@pytest.fixture(scope="module", name="record")
def _record(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The record that the example makes."""
    folder = tmp_path_factory.mktemp("run") / "record"
    script = ROOT / "examples" / "store_three_boxes.py"
    subprocess.run([sys.executable, script, folder], check=True, capture_output=True)  # noqa: S603
    return folder


def replay(*words: object) -> subprocess.CompletedProcess[str]:
    """The command in a process of its own."""
    command = [str(Path(sys.executable).parent / "depal"), "replay", *map(str, words)]
    return subprocess.run(  # noqa: S603 - our own command
        command, capture_output=True, text=True, check=False, env={**os.environ, "COLUMNS": "200"}
    )


def test_a_run_is_told_and_decided_again(record: Path, tmp_path: Path) -> None:
    """Every start and end, and the verdict."""
    done = replay(record, "--all", "--json", tmp_path / "r.json")
    assert (done.returncode, done.stderr) == (0, "")
    assert "kr60_release(b3) done" in done.stdout
    assert "Every decision is made again as recorded." in done.stdout
    fields = json.loads((tmp_path / "r.json").read_text())
    assert fields["deviations"] == []
    assert [event["sequence"] for event in fields["events"]] == list(range(1, 46))


def test_a_tree_is_drawn_as_it_stood(record: Path, tmp_path: Path) -> None:
    """As text with reasons, as SVG and as Mermaid."""
    text = replay(record, "--at", 12).stdout
    assert "store(b1)" in text
    assert "kr60_show(b1) is disabled: b1.known is set" in text
    assert replay(record, "--at", 12, "--format", "svg", "--out", tmp_path / "t.svg").stdout == ""
    assert (tmp_path / "t.svg").read_text().startswith("<svg")
    assert "flowchart" in replay(record, "--at", 12, "--format", "mermaid").stdout


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (("--at", "999"), "there is no event 999; the record has 1 .. 45"),
        (("--at", "45"), "no tree stands after event 45; there is none"),
        (("--at", "12", "--tree", "9"), "no tree 9 stands after event 12; there is: 1, 2, 3"),
        (("--at", "12", "--format", "gif"), "--format: unknown format 'gif'"),
        (("--json", "nowhere/x.json"), "--json: there is no folder 'nowhere'"),
    ],
)
def test_what_does_not_exist_is_answered_with_what_does(
    record: Path, words: tuple[str, ...], message: str
) -> None:
    """One error, exit status 2."""
    done = replay(record, *words)
    assert done.returncode == 2
    assert message in done.stderr
    assert "Traceback" not in done.stderr
