"""Commands as a stranger types them: good input, bad input, and what is written."""

import json
import os
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import jsonschema
import pytest

from depal import __version__
from depal.logistics import shipped_deliveries

Run = Callable[..., tuple[int, str, str]]


def test_table1_writes_the_fields_of_the_contract(depal: Run, tmp_path: Path) -> None:
    """And the figure."""
    report, plot = tmp_path / "t.json", tmp_path / "t.png"
    status, out, _ = depal("study", "table1", "--pallets", 300, "--json", report, "--plot", plot)
    assert status == 0
    assert "h(x)+l(x)" in out
    fields = json.loads(report.read_text())
    assert {"pallets", "seed", "seconds", "rows", "limit", "version", "command"} <= set(fields)
    assert fields["version"] == __version__
    assert fields["command"].startswith("depal study table1 --pallets 300")
    assert fields["pallets"] == 300
    for row in fields["rows"]:
        assert set(row["h"]) == set(row["hl"]) == {"mean", "std"}
        low, high = row["reduction"]["ci95"]
        assert low <= row["reduction"]["mean"] <= high
        assert row["limit"] == fields["limit"]
    assert [row["w"] for row in fields["rows"]] == [0.1, 0.3, 0.5, 0.7, 0.9]
    assert plot.read_bytes().startswith(b"\x89PNG")


def test_every_generator_has_its_table(depal: Run) -> None:
    """Several at once, by name."""
    status, out, _ = depal(
        "study", "table1", "--pallets", 60, "--generators", "layered,cubic,dropped"
    )
    assert status == 0
    assert "60 layered pallets" in " ".join(out.split())


@pytest.mark.parametrize(
    ("words", "fields"),
    [
        (("fig8", "--pallets", "300"), {"rows", "pallets", "seed"}),
        (("fig9", "--pallets", "10"), {"rows", "steps", "w"}),
        (("case2", "--draws", "5"), {"layouts"}),
        (("due", "--pallets", "2", "--small", "1"), {"due", "pallets", "small", "seed"}),
        (("hidden", "--pallets", "1", "--generators", "cubic,columns"), {"hidden", "pallets"}),
        (("stability", "--pallets", "2", "--states", "3"), {"rows", "agreement", "checks"}),
        (("fig4",), {"highest", "lowest"}),
        (("fig5",), {"reachable", "edges"}),
    ],
)
def test_every_study_prints_writes_and_draws(
    depal: Run,
    tmp_path: Path,
    words: tuple[str, ...],
    fields: set[str],
) -> None:
    """In one command."""
    report, plot = tmp_path / "r.json", tmp_path / "p.svg"
    status, out, err = depal("study", *words, "--json", report, "--plot", plot)
    assert (status, err) == (0, "")
    assert out
    assert fields <= set(json.loads(report.read_text()))
    assert "<svg" in plot.read_text()


def test_case2_has_the_ranks_of_the_contract(depal: Run, tmp_path: Path) -> None:
    """10th without and 8th with."""
    depal("study", "case2", "--draws", 20, "--json", tmp_path / "c.json")
    layouts = json.loads((tmp_path / "c.json").read_text())["layouts"]
    assert {entry["layout"] for entry in layouts} >= {"5-5", "3-3-2-2"}
    assert all((entry["without"], entry["with"]) == (10, 8) for entry in layouts)
    assert all(0 <= entry["robust"] <= 1 for entry in layouts)


def test_shipped_deliveries_are_unloaded(depal: Run, tmp_path: Path) -> None:
    """All of them, and one by its name with a request."""
    status, _, _ = depal("study", "unload")
    assert status == 0
    gtin = shipped_deliveries()[0].lines[0].product.gtin
    requests = tmp_path / "requests.yaml"
    requests.write_text(f'- {{at: 0 s, gtin: "{gtin}", priority: 0.8}}\n')
    name = shipped_deliveries()[0].id
    status, _, _ = depal(
        "study",
        "unload",
        "--deliveries",
        name,
        "--requests",
        requests,
        "--json",
        tmp_path / "u.json",
    )
    assert status == 0
    (entry,) = json.loads((tmp_path / "u.json").read_text())["deliveries"]
    assert entry["taken"] == entry["boxes"]
    (request,) = entry["requests"]
    assert request["gtin"] == gtin
    assert 0 <= request["boxes_before"] < entry["boxes"]


def test_a_delivery_is_checked(depal: Run, tmp_path: Path) -> None:
    """A valid one is summed up."""
    status, out, _ = depal("delivery", "check", "dev-000", "--json", tmp_path / "d.json")
    assert status == 0
    assert "1 valid delivery" in out
    (entry,) = json.loads((tmp_path / "d.json").read_text())["deliveries"]
    assert entry["boxes"] == 30


def test_everything_wrong_with_a_delivery_is_said_at_once(depal: Run, tmp_path: Path) -> None:
    """On the error output, with exit status 2, and nothing written."""
    file = tmp_path / "bad.json"
    line = {"gtin": "12000823098181", "name": "x", "size": [0.3, -0.2, 0.2], "mass": 1, "count": 1}
    file.write_text(json.dumps({"id": "d", "pallet": {"size": [1.2, 0.8, 0.144]}, "lines": [line]}))
    status, out, err = depal("delivery", "check", file, "--json", tmp_path / "d.json")
    assert status == 2
    assert out == ""
    assert "bad.json: 2 problems" in err
    assert "lines[0].gtin" in err
    assert "lines[0].size[1]" in err
    assert not (tmp_path / "d.json").exists()


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (("study", "fig9", "--w", "1.5", "--pallets", "5"), "w: 1.5 is out of range"),
        (("study", "case2", "--w", "nan", "--draws", "1"), "w: nan is not a number"),
        (("study", "table1", "--generators", "cubik"), "did you mean 'cubic'?"),
        (("study", "table1", "--plot", "nowhere/t.png"), "--plot: there is no folder 'nowhere'"),
        (("study", "table1", "--json", "."), "--json: '.' is a folder"),
        (("study", "fig5", "--plot", "x.jpeg"), "--plot: 'x.jpeg' is no picture's name"),
        (("study", "fig5", "--plot", "x.png", "--json", "x.png"), "two different files"),
        (("study", "table1", "--generators", "layered,xxx"), "xxx"),
        (("study", "table1", "--generators", "layered,"), "''"),
        (
            ("study", "table1", "--generators", "layered,cubic", "--plot", "x.png"),
            "one name in --generators",
        ),
        (("study", "table1", "--dask", "nonsense"), "--dask: 'nonsense' is no address"),
        (("delivery", "check", ""), "no file named"),
        (("study", "unload", "--deliveries", "dev-00"), "did you mean"),
        (("delivery", "check", "nowhere.json"), "nowhere.json"),
        (("schema", "delivry"), "did you mean 'delivery'?"),
        (("schema",), "there is: cell, delivery, faults, orders, requests"),
    ],
)
def test_bad_input_is_one_error_that_teaches(
    depal: Run,
    words: tuple[str, ...],
    message: str,
) -> None:
    """Exit status 2, no traceback."""
    status, _, err = depal(*words)
    assert status == 2
    assert message in err
    assert "Traceback" not in err


def test_a_request_for_a_product_that_is_not_on_the_note_is_refused(
    depal: Run, tmp_path: Path
) -> None:
    """By the check and by the study."""
    requests = tmp_path / "requests.yaml"
    requests.write_text('- {at: 0 s, gtin: "12000823126456", priority: 0.8}\n')
    for words in (("delivery", "check", "dev-000"), ("study", "unload", "--deliveries", "dev-000")):
        status, _, err = depal(*words, "--requests", requests)
        assert status == 2
        assert "12000823126456" in err
        assert "note" in err


@pytest.mark.parametrize("name", ["cell", "delivery", "requests"])
def test_a_schema_is_a_json_schema(depal: Run, name: str) -> None:
    """That other programs can use."""
    status, out, _ = depal("schema", name)
    assert status == 0
    jsonschema.Draft202012Validator.check_schema(json.loads(out))


def test_a_link_is_followed_and_a_pipe_is_not_replaced(depal: Run, tmp_path: Path) -> None:
    """What stands at the target stays what it is."""
    real, link, pipe = tmp_path / "real.json", tmp_path / "link.json", tmp_path / "pipe"
    real.write_text("old")
    link.symlink_to(real)
    depal("study", "fig5", "--json", link)
    assert link.is_symlink()
    assert "requested" in real.read_text()
    os.mkfifo(pipe)
    with subprocess.Popen(["cat", pipe], stdout=subprocess.PIPE, text=True) as reader:  # noqa: S603, S607
        assert depal("study", "fig5", "--json", pipe)[0] == 0
        assert reader.stdout is not None
        assert "requested" in reader.stdout.read()
    assert pipe.is_fifo()
    assert sorted(tmp_path.iterdir()) == sorted([real, link, pipe])


def test_names_from_files_are_no_mark_up(depal: Run, tmp_path: Path) -> None:
    """Brackets in a delivery's id are brackets."""
    file = tmp_path / "d.json"
    line = {"gtin": "12000823098180", "name": "x", "size": [0.3, 0.2, 0.2], "mass": 1, "count": 1}
    pallet = {"size": [1.2, 0.8, 0.144]}
    file.write_text(json.dumps({"id": "a[/red]b", "pallet": pallet, "lines": [line]}))
    status, out, _ = depal("delivery", "check", file)
    assert status == 0
    assert "a[/red]b" in out
    assert "mass [kg]" in out


def test_the_doctor_finds_this_machine_well(depal: Run, tmp_path: Path) -> None:
    """Otherwise these tests would not run."""
    status, out, _ = depal("doctor", "--json", tmp_path / "d.json")
    assert status == 0
    assert "numba" in out
    findings = json.loads((tmp_path / "d.json").read_text())["findings"]
    assert all(finding["works"] in {True, None} for finding in findings)


def test_the_version_is_said(depal: Run) -> None:
    """And help for a bare command."""
    assert depal("--version")[1] == f"depal {__version__}\n"
    assert "study" in depal("--help")[1]


def test_the_installed_command_starts() -> None:
    """Through its entry point, in a process of its own."""
    command = Path(sys.executable).parent / "depal"
    done = subprocess.run([command, "--version"], capture_output=True, text=True, check=True)  # noqa: S603
    assert done.stdout == f"depal {__version__}\n"
