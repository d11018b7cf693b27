"""Whole runs in physics: everything but the person is as in `depal run`."""

import dataclasses
import json
from pathlib import Path

import pytest
from tiny_runs import THREE, gtin, run

from depal.app.replay import replay_report
from depal.app.run.job import run_delivery
from depal.app.run.summary import run_report
from depal.app.run.values import Options
from depal.cell.departures import Fate
from depal.cell.workplace import Policy
from depal.domain import Approach, Request
from depal.simulation.truth_sight import SightSettings

HEAVY = (((0.4, 0.0, 0.0), (0.5, 0.3, 0.3), 20.0),)
"""One case that the cups only just hold."""


@pytest.mark.slow
def test_a_tiny_delivery_is_stored_and_the_referee_agrees() -> None:
    """No loss, no collision, every box where the books say, what is on top first."""
    outcome = run(THREE)
    assert outcome.whole
    assert (outcome.stored, outcome.lost, outcome.exceptions) == (3, 0, ())
    assert outcome.referee.collisions == ()
    assert outcome.disagreements == ()
    assert outcome.questions == ()
    assert outcome.waiting_seconds == 0.0
    order = [departure.box for departure in outcome.departures]
    assert order.index("b3") < order.index("b1")
    where = [str(departure.place) for departure in outcome.departures]
    assert outcome.referee.boxes == {place: where.count(place) for place in sorted(set(where))}
    assert outcome.boxes_per_hour == pytest.approx(3 * 3600 / outcome.sim_seconds)
    assert sum(outcome.shares.values()) == pytest.approx(outcome.sim_seconds)


@pytest.mark.slow
def test_the_same_seed_gives_the_same_events_and_another_seed_others() -> None:
    """To the byte; only real time differs."""
    one, same, other = (run(THREE, seed=seed) for seed in (5, 5, 6))
    assert one.events_sha256 == same.events_sha256 != other.events_sha256
    real = {"wall_seconds": 0.0, "plan_seconds": ()}
    assert dataclasses.replace(one, **real) == dataclasses.replace(same, **real)


@pytest.mark.slow
def test_boxes_that_the_camera_does_not_know_are_read_by_the_reader() -> None:
    """Its picture of the printed label is decoded: check and query really happen."""
    outcome = run(THREE, sight=SightSettings(sigma=0.001, unrecognised=1.0))
    assert outcome.whole
    assert outcome.stored == 3
    assert outcome.shares["reader"] > 0.0
    assert {d.box: d.gtin for d in outcome.departures} == {f"b{n + 1}": gtin(n) for n in range(3)}


@pytest.mark.slow
def test_a_wanted_product_comes_first_where_it_can() -> None:
    """In physics as in Algorithm 1."""
    outcome = run(THREE, Request(priority=1.0, gtin=gtin(1)), w=1.0)
    (wish,) = outcome.wishes
    assert (wish.box, wish.boxes_before) == ("b2", 0)
    assert outcome.departures[0].box == "b2"


@pytest.mark.slow
def test_access_takes_from_above_what_the_paper_waits_for() -> None:
    """Two cases one behind the other, the hidden one is wanted: nothing lies on it."""
    rows = (
        ((0.4, 0.05, 0.0), (0.35, 0.30, 0.25), 5.0),
        ((0.4, 0.36, 0.0), (0.35, 0.30, 0.25), 5.0),
    )
    first = run(rows).departures[0].gtin
    (behind,) = {gtin(0), gtin(1)} - {first}
    wish = Request(priority=1.0, gtin=behind)
    paper = run(rows, wish, w=1.0)
    access = run(rows, wish, w=1.0, policy=Policy.ACCESS)
    assert paper.whole
    assert access.whole
    assert [outcome.wishes[0].boxes_before for outcome in (paper, access)] == [1, 0]
    assert access.departures[0].grasp is Approach.VERTICAL
    assert access.referee.collisions == ()


@pytest.mark.slow
def test_with_the_guard_a_counterweight_is_taken_last() -> None:
    """A long case overhangs, one holds it down, one pulls it over: h alone would free the fall."""
    lever = (
        ((0.10, 0.05, 0.0), (0.35, 0.30, 0.30), 8.0),
        ((0.10, 0.05, 0.30), (0.65, 0.30, 0.15), 4.0),
        ((0.10, 0.10, 0.45), (0.20, 0.20, 0.20), 6.0),
        ((0.55, 0.10, 0.45), (0.20, 0.20, 0.20), 4.0),
    )
    careless, guarded = run(lever), run(lever, guard=True)
    assert careless.departures[0].box == "b3"
    assert guarded.whole
    assert [departure.box for departure in guarded.departures] == ["b4", "b3", "b2", "b1"]
    assert guarded.referee.collisions == ()


@pytest.mark.slow
def test_a_heavy_case_is_held_with_the_suction_cone_and_lost_without() -> None:
    """20 kg: the arm could be faster than the cups can bear."""
    held, lost = run(HEAVY), run(HEAVY, cone=False)
    assert held.whole
    assert (held.stored, held.referee.lost) == (1, ())
    assert not lost.whole
    assert [d.fate for d in lost.departures] == [Fate.LOST]
    assert [asked.question.about for asked in lost.questions] == ["b1"]
    assert lost.disagreements == ()


@pytest.mark.slow
def test_a_box_that_falls_back_onto_the_pile_is_not_run_into() -> None:
    """The arm stands still, though the box may tumble against it, until it is taken away."""
    on_top = ((0.4, 0.0, 0.3), (0.3, 0.2, 0.25), 20.0)
    below = ((0.4, 0.0, 0.0), (0.7, 0.45, 0.3), 8.0)
    outcome = run((on_top, below), cone=False)
    cleared = max(asked.answered or 0.0 for asked in outcome.questions)
    assert [hit for hit in outcome.referee.collisions if hit.at > cleared] == []
    assert outcome.stored == 1


@pytest.mark.slow
def test_a_record_is_decided_again_as_it_was(tmp_path: Path) -> None:
    """`depal replay` makes every decision anew; the choices stand beside the journal."""
    folder = tmp_path / "record"
    outcome = run(THREE, record=folder)
    report = replay_report(folder, every=True)
    assert report.holds
    assert report.fields["deviations"] == []
    lines = (folder / "choices.jsonl").read_text("utf-8").splitlines()
    choices = [json.loads(line) for line in lines]
    assert [choice["target"] for choice in choices] == [d.box for d in outcome.departures]
    assert all(len(choice["lines"]) for choice in choices)


@pytest.mark.slow
def test_the_reports_of_runs_say_what_the_contract_says() -> None:
    """Of a run in which all goes well and of one with a loss; as JSON they read back."""
    for outcome in (run(THREE), run(HEAVY, cone=False)):
        report = run_report(outcome, "truth")
        fields = json.loads(json.dumps(report.fields))
        assert fields["stored"] + fields["lost"] + len(fields["exceptions"]) == fields["boxes"]
        assert report.holds is (fields["lost"] == 0)


@pytest.mark.slow
@pytest.mark.parametrize(("requests", "rank"), [("", 8), ("none", 10)])
def test_case_2_takes_b1_as_the_paper_says(requests: str, rank: int) -> None:
    """8th with the request and 10th without (section III-C)."""
    report = run_delivery(Options(delivery="case2", w=0.2, requests=requests))
    assert report.holds
    order = [entry["box"] for entry in report.fields["sequence"]]
    assert order.index("b1") + 1 == rank
    assert sorted(order) == sorted(f"b{n}" for n in range(1, 11))
    wishes = report.fields["requests"]
    assert [(wish["box"], wish["boxes_before"]) for wish in wishes] == (
        [] if requests == "none" else [("b1", rank - 1)]
    )
