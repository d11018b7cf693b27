"""The studies beyond the paper, as a stranger types them."""

import json
from collections.abc import Callable
from pathlib import Path

import pytest

Run = Callable[..., tuple[int, str, str]]


@pytest.mark.slow
def test_retrieval_writes_the_fields_of_the_contract(depal: Run, tmp_path: Path) -> None:
    """And the figure, with a row per share and policy."""
    report, plot = tmp_path / "r.json", tmp_path / "r.png"
    status, out, _ = depal(
        *("study", "retrieval", "--pallets", 40, "--cell-pallets", 2, "--referee", 5),
        *("--deliveries", "dev-035", "--side-only", "0,0.5", "--json", report, "--plot", plot),
    )
    assert status == 0
    assert "proves the same minimum on 5 of 5 pallets" in " ".join(out.split())
    fields = json.loads(report.read_text())
    for row in fields["rows"]:
        assert {"pallets", "side_only", "clearance", "policy", "actions", "limit", "gap"} <= set(
            row
        )
        low, high = row["actions"]["ci95"]
        assert low <= row["actions"]["mean"] <= high
        assert row["actions"]["mean"] == pytest.approx(row["limit"] + row["gap"])
    kinds = [(row["pallets"], row["side_only"], row["clearance"]) for row in fields["rows"][::2]]
    assert kinds == [
        ("guillotine", 0.0, False),
        ("guillotine", 0.5, False),
        ("guillotine", 0.0, True),
        ("real", 0.0, False),
        ("real", 0.0, True),
    ]
    assert [each["above"] for each in fields["deliveries"]] == [0, 0]
    assert plot.read_bytes().startswith(b"\x89PNG")


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (("--side-only", "0,much"), "'much' is not a number"),
        (("--side-only", "1.5"), "out of range"),
        (("--generators", "guilotine"), "guillotine"),
        (("--cell", "nowhere"), "default"),
    ],
)
def test_bad_options_of_a_study_are_said_once(depal: Run, words: tuple[str], said: str) -> None:
    """Before anything is worked on."""
    status, _, err = depal("study", "retrieval", "--pallets", 1, *words)
    assert status == 2
    assert said in " ".join(err.split())


@pytest.mark.slow
def test_the_benchmark_writes_its_table_into_a_page(depal: Run, tmp_path: Path) -> None:
    """Between the marks; the rest of the page stays."""
    page, report = tmp_path / "page.md", tmp_path / "b.json"
    page.write_text("before\n<!-- benchmark: begin -->\nold\n<!-- benchmark: end -->\nafter\n")
    words = ("study", "benchmark", "--pallets", 2, "--generators", "layered,dropped")
    status, _, _ = depal(*words, "--into", page, "--json", report)
    assert status == 0
    text = page.read_text()
    assert text.startswith("before\n")
    assert text.endswith("<!-- benchmark: end -->\nafter\n")
    assert "old" not in text
    rows = json.loads(report.read_text())["rows"]
    assert [row["policy"] for row in rows[:4]] == [
        "paper",
        "paper, guarded",
        "access",
        "access, guarded",
    ]
    for row in rows:
        assert text.count(f"| {row['pallets']} | {row['policy']} |") == 1
        assert row["actions"]["mean"] >= 0
        assert 0 <= row["collapse_rate"]["mean"] <= 1
    for kind in ("layered", "dropped"):
        paper, _, access, _ = [row for row in rows if row["pallets"] == kind]
        assert access["gap"] == 0
        assert access["actions"]["mean"] <= paper["actions"]["mean"]


@pytest.mark.slow
def test_a_page_without_marks_is_refused_and_left_alone(depal: Run, tmp_path: Path) -> None:
    """The error says which marks it needs."""
    page = tmp_path / "page.md"
    page.write_text("nothing\n")
    words = ("study", "benchmark", "--pallets", 1, "--generators", "cubic", "--into")
    status, _, err = depal(*words, page)
    assert status == 2
    assert "benchmark: begin" in err
    assert page.read_text() == "nothing\n"
    status, _, err = depal(*words, tmp_path / "none.md")
    assert status == 2
    assert "No such file" in err
