"""`depal learn` and `depal study learning` as a stranger types them."""

import json
from collections.abc import Callable
from pathlib import Path

import pytest

Run = Callable[..., tuple[int, str, str]]


@pytest.mark.slow
def test_orders_are_drawn_written_and_learned_from(depal: Run, tmp_path: Path) -> None:
    """With JSON and a picture."""
    orders, report, plot = tmp_path / "o.jsonl", tmp_path / "l.json", tmp_path / "l.png"
    status, out, _ = depal(
        *("study", "learning", "--pallets", 20, "--seeds", 2, "--orders", orders),
        *("--json", tmp_path / "s.json"),
    )
    assert status == 0
    assert "The policy took the best-scored box" in out
    study = json.loads((tmp_path / "s.json").read_text())
    assert (study["of"], len(study["rows"]), len(study["runs"])) == (2, 4, 2)
    status, out, _ = depal("learn", orders, "--json", report, "--plot", plot, "--bootstrap", 3)
    assert status == 0
    assert "20 pallets: estimated" in " ".join(out.split())
    fields = json.loads(report.read_text())
    assert fields["finding"] == "estimated"
    for name in ("w", "side", "depth", "height", "temperature"):
        low, high = fields[name]["ci95"]
        assert low <= fields[name]["value"] <= high
    assert fields["held_out"]["pallets"] == 4
    assert plot.read_bytes().startswith(b"\x89PNG")


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (("learn", "nowhere.jsonl"), "nowhere.jsonl: no such file"),
        (("learn",), "Missing argument"),
        (("study", "learning", "--weights", "1,2"), "--weights: '1,2' is no list of weights"),
        (("study", "learning", "--w", 2), "w: 2"),
        (("study", "learning", "--generators", "guilotine"), "did you mean 'guillotine'?"),
        (("schema", "order"), "did you mean 'orders'?"),
        (("replay", "nowhere", "--why", "all"), "expected a record of `depal run`"),
    ],
)
def test_what_cannot_be_used_is_said_once(depal: Run, words: tuple[object], said: str) -> None:
    """Exit status 2, before anything is worked on."""
    status, _, err = depal(*words)
    assert status == 2
    assert said in " ".join(err.split())


def test_the_schema_of_orders_is_printed(depal: Run) -> None:
    """As that of every format."""
    status, out, _ = depal("schema", "orders")
    assert status == 0
    assert json.loads(out)["title"] == "OrderEntry"
