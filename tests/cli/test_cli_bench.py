"""`depal bench` prints figures beside their targets and writes the fields of the contract."""

import json
import math
import sys
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import pytest

from depal.app import run_figures
from depal.app.doctor import examine
from depal.app.reports import bench_report
from depal.app.run.job import prepared, run_job
from depal.app.run.summary import Outcome
from depal.app.run.values import Options
from depal.cell.departures import Departure, Fate
from depal.domain import Approach, BoxId, PlaceId
from depal.simulation.referee import Summary
from depal.studies import paper
from depal.studies.bench import Figure, Peer

Run = Callable[..., tuple[int, str, str]]

FIGURE = Figure("checks", 2.0, "1/s", 1.0, "higher", 5)


def outcome_of(order: tuple[str, ...], **changes: object) -> Outcome:
    """A run in which some boxes left in an order, ten seconds each."""
    departures = tuple(
        Departure(BoxId(box), None, Approach.VERTICAL, PlaceId("t/1"), Fate.STORED, "", 10.0 * rank)
        for rank, box in enumerate(order, start=1)
    )
    outcome = Outcome(
        delivery="d",
        boxes=len(order),
        departures=departures,
        left=(),
        wishes=(),
        questions=(),
        referee=Summary({}, (), 0.0, (), (), ()),
        disagreements=(),
        stack={},
        differences=(),
        sim_seconds=10.0 * len(order) + 6.0,
        waiting_seconds=6.0,
        wall_seconds=3.0,
        shares={},
        plan_seconds=(0.01, 0.02, 0.03),
        policy="paper",
        w=0.5,
        seed=0,
        speed=1.0,
        events_sha256="same",
    )
    return replace(outcome, **changes)  # type: ignore[arg-type]


@pytest.mark.parametrize(
    ("peers", "first"),
    [((), None), ((Peer("a", 3.0),), 3.0), ((Peer("a", 3.0), Peer("b", 1.0)), 3)],
)
def test_a_figure_names_its_first_peers_value_and_all_peers(
    peers: tuple[Peer, ...], first: float | None
) -> None:
    """The contract's `peer`, and `peers` by name beside it."""
    (fields,) = bench_report("part", [replace(FIGURE, peers=peers)]).fields["figures"]  # type: ignore[misc, union-attr]
    assert fields == {
        "name": "checks",
        "value": 2.0,
        "unit": "1/s",
        "target": 1.0,
        "better": "higher",
        "n": 5,
        "peer": first,
        "peers": {peer.name: peer.value for peer in peers},
    }


@pytest.mark.parametrize(("value", "met"), [(2.0, True), (math.nan, False)])
def test_a_figure_without_a_target_is_met_when_it_was_measured(value: float, met: object) -> None:
    """It only stands beside its peers."""
    figure = replace(FIGURE, value=value, target=math.nan)
    assert figure.met is met
    assert bench_report("part", [figure]).holds is met


@pytest.mark.parametrize("part", ["planning", "selection", "executive"])
def test_a_bench_prints_and_writes_what_was_measured(
    depal: Run, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, part: str
) -> None:
    """One missed figure is no error."""
    missed = replace(FIGURE, name="slow", value=0.5)
    monkeypatch.setattr(f"depal.studies.bench.bench_{part}", lambda *_: [FIGURE, missed])
    status, out, err = depal("bench", part, "--json", tmp_path / "b.json")
    assert (status, err) == (0, "")
    assert f"{part}: medians" in out
    assert "met" in out
    assert "missed" in out
    fields = json.loads((tmp_path / "b.json").read_text())
    assert [figure["name"] for figure in fields["figures"]] == ["checks", "slow"]


@pytest.mark.parametrize(
    ("words", "names"), [((), ["checks", "run"]), (("--no-runs",), ["checks"])]
)
def test_whole_runs_belong_to_the_simulation_unless_they_are_left_out(
    depal: Run,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    words: tuple[str, ...],
    names: list[str],
) -> None:
    """They take a minute."""
    monkeypatch.setattr("depal.studies.bench.bench_simulation", lambda *_: [FIGURE])
    run = replace(FIGURE, name="run", target=math.nan)
    monkeypatch.setattr(run_figures, "run_figures", lambda *_: [run])
    status, _, _ = depal("bench", "simulation", *words, "--json", tmp_path / "b.json")
    assert status == 0
    figures = json.loads((tmp_path / "b.json").read_text())["figures"]
    assert [figure["name"] for figure in figures] == names
    assert figures[-1]["target"] == (None if "run" in names else 1.0)


def test_a_file_that_cannot_be_written_is_said_before_anything_is_measured(
    depal: Run, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A bench takes minutes."""
    monkeypatch.setattr("depal.studies.bench.bench_planning", lambda *_: pytest.fail("measured"))
    status, _, err = depal("bench", "planning", "--json", "nowhere/b.json")
    assert status == 2
    assert "there is no folder 'nowhere'" in err


def test_the_figures_of_a_run_are_those_of_its_outcome() -> None:
    """Counts of the first, times of the second, which has nothing to compile."""
    first = outcome_of(("b1", "b2"), wall_seconds=99.0)
    second = outcome_of(("b1", "b2"), wall_seconds=3.0)
    figures = {figure.name: figure for figure in run_figures.delivery_figures(first, second)}
    assert all(figure.met for figure in figures.values() if "rate" not in figure.name)
    assert figures["d: rate"].value == pytest.approx(360.0)
    assert figures["d: real time"].value == 3.0
    assert figures["d: planning a motion"].value == pytest.approx(20.0)
    other = replace(second, events_sha256="other")
    wrong = replace(first, disagreements=("box b1",))
    missed = [
        figure.name for figure in run_figures.delivery_figures(wrong, other) if not figure.met
    ]
    assert missed == [
        "d: not where the books say",
        "d: event logs that differ for the same seed",
        "d: rate",
    ]


def test_a_run_by_camera_is_measured_by_the_run_that_knows_the_truth() -> None:
    """Its rate and its real time as shares, its losses as they are."""
    truth = outcome_of(("b1", "b2"), wall_seconds=3.0)
    camera = outcome_of(("b1", "b2"), wall_seconds=6.0, sim_seconds=36.0)
    figures = {figure.name: figure for figure in run_figures.camera_figures(truth, camera)}
    assert figures["d by camera: boxes stored"].value == 100.0
    assert figures["d by camera: real time, of the truth's"].value == 2.0
    assert figures["d by camera: rate, of the truth's"].value == pytest.approx(200 / 3)
    missed = [figure.name for figure in figures.values() if not figure.met]
    assert missed == ["d by camera: rate, of the truth's"]


def test_the_rank_of_a_box_that_never_left_is_not_known() -> None:
    """And such a figure is missed."""
    outcome = outcome_of(("b2", "b1", "b3"))
    assert run_figures.rank_of(BoxId("b1"), outcome) == 2
    assert math.isnan(run_figures.rank_of(BoxId("b9"), outcome))
    gone = outcome_of(("b2",))
    figures = run_figures.case2_figures(gone, gone, gone)
    assert [figure.met for figure in figures] == [False, False, True, False]


@pytest.mark.slow
def test_the_request_moves_b1_from_the_tenth_place_to_the_eighth_in_the_cell() -> None:
    """Case study 2 with physics, at full speed."""
    options = Options(delivery="case2", w=paper.CASE_2_WEIGHT)
    without = run_job(prepared(replace(options, requests="none")))
    requested = run_job(prepared(options))
    figures = run_figures.case2_figures(without, requested, requested)
    assert [figure.value for figure in figures[:2]] == [10, 8]
    assert without.whole
    assert requested.whole


@pytest.mark.parametrize(
    ("module", "part"),
    [("mujoco", "physics"), ("ompl.base", "the peer of motion planning")],
)
def test_the_doctor_says_what_does_not_load(
    monkeypatch: pytest.MonkeyPatch, module: str, part: str
) -> None:
    """And goes on with the rest."""
    monkeypatch.setitem(sys.modules, module, None)
    findings = {finding.name: finding for finding in examine()}
    assert findings[part].works is False
    assert findings["barcodes"].works
    assert findings["the store's data"].works
    assert findings["cells that ship with depal"].detail.startswith("3: ")


def test_the_doctor_looks_at_every_package_that_depal_depends_on() -> None:
    """By the name that installs it."""
    found = {finding.name.lower() for finding in examine()}
    assert found >= {"mujoco-core", "ompl", "pillow", "zxing-cpp", "sqlalchemy", "numba"}
    assert "opencv-contrib-python-headless" in found
