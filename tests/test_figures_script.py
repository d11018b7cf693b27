"""scripts/figures.py turns what the commands write into lines of the table."""

import importlib.util
import sys
from pathlib import Path
from types import ModuleType
from typing import Any

import pytest

SCRIPT = Path(__file__).parent.parent / "scripts" / "figures.py"

FIGURE = {
    "name": "checks",
    "value": 2.0,
    "unit": "1/s",
    "target": 1.0,
    "better": "higher",
    "n": 5,
    "peer": None,
    "peers": {},
}

SUMMARY = {
    "runs": 10,
    "boxes": 200,
    "stored": 199,
    "stored_share": 0.995,
    "lost": 0,
    "collisions": 0,
    "disagreements": 0,
    "placed_twice": 0,
    "boxes_per_hour": {"median": 450.0},
    "shares": {"arm motion": 0.9, "looking": 0.1},
    "plan_seconds": {"median": 0.02, "p95": 0.25},
}


@pytest.fixture(name="script")
def _script(monkeypatch: pytest.MonkeyPatch) -> ModuleType:
    """The script as a module; nothing of it runs."""
    spec = importlib.util.spec_from_file_location("figures_script", SCRIPT)
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    monkeypatch.setitem(sys.modules, "figures_script", module)
    spec.loader.exec_module(module)
    return module


@pytest.mark.parametrize(
    ("changes", "figure", "measured", "met"),
    [
        ({}, ">= 1 1/s", "2 1/s", True),
        ({"better": "lower"}, "<= 1 1/s", "2 1/s", False),
        ({"value": 0.0, "better": "lower", "unit": ""}, "<= 1", "0", True),
        ({"peers": {"MuJoCo": 0.5}}, ">= 1 1/s", "2 1/s (MuJoCo: 0.5)", True),
        ({"value": None}, ">= 1 1/s", "not measured", False),
        ({"target": None}, "", "2 1/s", True),
        ({"target": None, "value": 0.0}, "", "0 1/s", True),
        ({"target": None, "value": None}, "", "not measured", False),
    ],
)
def test_a_figure_of_a_bench_is_a_line(
    script: ModuleType,
    monkeypatch: pytest.MonkeyPatch,
    changes: dict[str, Any],
    figure: str,
    measured: str,
    met: object,
) -> None:
    """Met on its better side; never where it could not be measured."""
    report = {"figures": [{**FIGURE, **changes}]}
    monkeypatch.setattr(script, "depal", lambda *_: (report, 1.0))
    for lines in (script.planning(), script.simulation()):
        (line,) = lines
        assert (line.what, line.figure, line.measured) == ("checks", figure, measured)
        assert line.met is met


@pytest.mark.parametrize(
    ("changes", "missed"),
    [
        ({}, {"planning a motion, 95th percentile"}),
        ({"plan_seconds": {"median": 0.02, "p95": 0.15}}, set()),
        (
            {"stored_share": None, "lost": 2, "boxes_per_hour": {"median": None}},
            {
                "boxes stored",
                "lost; collisions; not where the books say; placed twice",
                "median rate",
                "planning a motion, 95th percentile",
            },
        ),
    ],
)
def test_the_throughput_of_the_shipped_deliveries_is_in_the_table(
    script: ModuleType,
    monkeypatch: pytest.MonkeyPatch,
    changes: dict[str, Any],
    missed: set[str],
) -> None:
    """Its finished runs are kept under the state of the sources."""
    asked: list[tuple[str, ...]] = []

    def depal(*words: str) -> tuple[dict[str, Any], float]:
        asked.append(words)
        return {"summary": {**SUMMARY, **changes}, "failures": []}, 1.0

    monkeypatch.setattr(script, "depal", depal)
    lines = list(script.throughput())
    start = "10 real deliveries in the cell: "
    assert {line.what.removeprefix(start) for line in lines if not line.met} == missed
    assert f"throughput-{script.state()}" in asked[0][-1]
    assert any(line.measured == "arm motion 90.0 %, looking 10.0 %" for line in lines)


@pytest.mark.parametrize(
    ("ended", "broken", "p95", "missed"),
    [
        (1.0, 0, 0.1, set()),
        (0.97, 0, 0.1, {"2 faults, 100 runs each: ends as named, the worst"}),
        (1.0, 1, 0.1, {"2000 pairs: an invariant broken"}),
        (1.0, 0, 5.1, {"recovery, the software's part, 95th percentile"}),
    ],
)
def test_the_faults_are_in_the_table_with_the_worst_of_them(
    script: ModuleType,
    monkeypatch: pytest.MonkeyPatch,
    ended: float,
    broken: int,
    p95: float,
    missed: set[str],
) -> None:
    """One line for all faults, one for the pairs, one for the recovery."""
    report = {
        "rows": [
            {"fault": "G1", "ended": 1.0, "invariants": 1.0},
            {"fault": "G3", "ended": ended, "invariants": 1.0},
        ],
        "pairs": {"n": 2000, "broken": [{}] * broken},
        "recovery": {"p95": p95},
    }
    monkeypatch.setattr(script, "depal", lambda *_: (report, 1.0))
    assert {line.what for line in script.faults() if not line.met} == missed


@pytest.mark.parametrize(
    ("doubled", "control", "missed"),
    [
        (0, 3, set()),
        (0, 0, {"the control, which runs begun steps again: boxes wrong"}),
        (1, 3, {"12 cuts: cuts at random moments: lost; doubled; misplaced"}),
    ],
)
def test_the_storm_is_in_the_table(
    script: ModuleType,
    monkeypatch: pytest.MonkeyPatch,
    doubled: int,
    control: int,
    missed: set[str],
) -> None:
    """A control in which nothing goes wrong shows nothing."""
    none = {"cuts": 12, "boxes": 10, "lost": 0, "doubled": 0, "misplaced": 0, "wrong": []}
    report = {
        "cuts": {
            "positions": none,
            "random": {**none, "doubled": doubled},
            "control": {**none, "lost": control},
        },
        "shift": none,
        "shift_physics": {"boxes": 1000, "lost": 0, "wrong": []},
    }
    monkeypatch.setattr(script, "depal", lambda *_: (report, 1.0))
    assert {line.what for line in script.storm() if not line.met} == missed


def test_the_checks_of_stability_are_in_the_table(
    script: ModuleType, monkeypatch: pytest.MonkeyPatch
) -> None:
    """As the study says them."""
    check = {"name": "agree", "allowed": ">= 97 %", "measured": "96.0 %", "holds": False}
    monkeypatch.setattr(script, "depal", lambda *_: ({"checks": [check]}, 1.0))
    assert list(script.stability()) == [script.Line("agree", ">= 97 %", "96.0 %", met=False)]


def test_every_measurement_has_a_name_of_its_own(script: ModuleType) -> None:
    """Kept files are named after them."""
    names = [measure.__name__ for measure in script.MEASUREMENTS]
    assert len(set(names)) == len(names)
    assert {"planning", "simulation", "throughput"} <= set(names)
