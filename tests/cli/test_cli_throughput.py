"""`depal study throughput`: runs summed up, kept and resumed; what went wrong is said."""

import json
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from depal import __version__
from depal.app.run.values import Job
from depal.app.throughput import Asked, Failure, Row, runs, summary_of, throughput
from depal.app.throughput.runs import kept_rows
from depal.errors import SettingError
from depal.logistics import shipped_deliveries
from depal.studies.kept import key_of

Run = Callable[..., tuple[int, str, str]]
Fields = dict[str, Any]


def gone(stack: int | None, outcome: str = "stored") -> Fields:
    """A box that left the pallet."""
    return {"stack": stack, "box": "b1", "outcome": outcome, "at": 7.25}


def truth(*disagreements: str, hits: int = 0, losses: int = 0) -> Fields:
    """The referee's word."""
    return {
        "disagreements": list(disagreements),
        "collisions": [{"at": 3.0, "who": "link_3", "against": "b2", "force": 61.0}] * hits,
        "suction_losses": ["b1"] * losses,
    }


def fields_of(delivery: str = "d", seed: int = 0, **changes: object) -> Fields:
    """What a run in which four boxes were stored writes."""
    stored = [gone(number) for number in range(4)]
    fields: Fields = {
        "delivery": delivery,
        "boxes": 4,
        "stored": 4,
        "lost": 0,
        "collisions": 0,
        "exceptions": [],
        "sequence": stored,
        "requests": [{"priority": 0.5, "served": 12.0}, {"priority": 0.1, "served": None}],
        "sim_seconds": 40.0,
        "waiting_seconds": 4.0,
        "wall_seconds": 20.0,
        "boxes_per_hour": 400.0,
        "shares": {"arm motion": 36.0, "waiting for people": 4.0},
        "plan_seconds": [0.01, 0.02, 0.3],
        "referee": truth(),
        "seed": seed,
        "events_sha256": "0",
    }
    return {**fields, **changes}


def ran(job: Job) -> Fields:
    """A run that takes no time."""
    return fields_of(job.delivery.id, job.seed)


@pytest.fixture(name="done")
def _done(monkeypatch: pytest.MonkeyPatch) -> list[str]:
    """Runs take no time, and are written down."""
    done: list[str] = []

    def run_one(job: Job) -> Fields:
        done.append(f"{job.delivery.id}/{job.seed}")
        return ran(job)

    monkeypatch.setattr(runs, "run_one", run_one)
    return done


def two_boxes(path: Path) -> Path:
    """A file of two deliveries, each of two large cases of a shipped one, side by side."""
    delivery = shipped_deliveries()[0]
    large = [case for case in delivery.stack or () if min(case.size) > 0.28][:2]
    lines = [
        {
            "gtin": line.product.gtin,
            "name": line.product.name,
            "size": list(line.product.size),
            "mass": line.product.mass,
            "count": sum(case.gtin == line.product.gtin for case in large),
        }
        for line in delivery.lines
    ]
    stack = [
        {"gtin": case.gtin, "corner": [0.1 + 0.5 * number, 0.0, 0.0], "size": list(case.size)}
        for number, case in enumerate(large)
    ]
    entry = {
        "pallet": {"size": list(delivery.pallet_size)},
        "lines": [line for line in lines if line["count"]],
        "stack": stack,
    }
    path.write_text(json.dumps([{"id": "one", **entry}, {"id": "other", **entry}]))
    return path


@pytest.mark.parametrize(
    ("changes", "holds"),
    [
        ({}, True),
        ({"lost": 1, "stored": 3}, False),
        ({"collisions": 1}, False),
        ({"stored": 3}, False),
        (
            {"stored": 3, "exceptions": [{"box": "b1", "outcome": "set aside", "reason": "big"}]},
            True,
        ),
        ({"referee": truth("box b1")}, False),
        ({"referee": truth(losses=1)}, True),
        ({"sequence": [gone(2), gone(2)]}, False),
        ({"sequence": [gone(2), gone(2, "set aside")]}, True),
        ({"sequence": [gone(None), gone(None)]}, True),
    ],
)
def test_a_run_holds_when_nothing_was_lost_hit_or_booked_wrongly(
    changes: Fields, holds: object
) -> None:
    """And every box is accounted for once."""
    assert Row.of(fields_of(**changes)).holds is holds


@given(st.lists(st.tuples(st.integers(0, 9), st.floats(1, 900)), min_size=1, max_size=8))
def test_a_summary_adds_up(runs_of: list[tuple[int, float]]) -> None:
    """Counts are sums, shares are of all time together and add up to it."""
    rows = [
        Row.of(
            fields_of(
                boxes=stored + 1,
                stored=stored,
                lost=1,
                sim_seconds=seconds,
                boxes_per_hour=3600 * stored / seconds,
                shares={"arm motion": 0.75 * seconds, "nothing": 0.25 * seconds},
            )
        )
        for stored, seconds in runs_of
    ]
    summary = summary_of(rows)
    assert summary.boxes == summary.stored + summary.lost
    assert summary.stored == sum(stored for stored, _ in runs_of)
    assert summary.shares == pytest.approx({"arm motion": 0.75, "nothing": 0.25})
    rates = sorted(row.boxes_per_hour for row in rows)
    assert rates[0] <= summary.boxes_per_hour.median <= rates[-1]
    assert summary.planning.n == 3 * len(rows)
    assert summary.within_charge == pytest.approx(2 / 3)


def test_every_delivery_is_run_with_every_seed_the_longest_first(done: list[str]) -> None:
    """The rows come delivery by delivery all the same."""
    told: list[tuple[int, int]] = []
    result = throughput(Asked(seeds=2, seed=3), progress=lambda *now: told.append(now))
    ids = [delivery.id for delivery in shipped_deliveries()]
    assert [(row.delivery, row.seed) for row in result.rows] == [
        (name, seed) for name in ids for seed in (3, 4)
    ]
    assert done[:2] == [f"{ids[-1]}/3", f"{ids[-1]}/4"]
    assert done[-2:] == [f"{ids[0]}/3", f"{ids[0]}/4"]
    boxes = 2 * sum(len(delivery.boxes) for delivery in shipped_deliveries())
    assert (told[0], told[-1]) == ((0, boxes), (boxes, boxes))


def test_an_interrupted_study_goes_on_where_it_stopped(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """What is done is not done again, and the result is that of a study without interruption."""
    done: list[str] = []

    def interrupted(job: Job) -> Fields:
        if len(done) == 4:
            raise KeyboardInterrupt
        done.append(job.delivery.id)
        return ran(job)

    def the_rest(job: Job) -> Fields:
        assert job.delivery.id not in done
        return ran(job)

    monkeypatch.setattr(runs, "run_one", interrupted)
    with pytest.raises(KeyboardInterrupt):
        throughput(Asked(), tmp_path / "new" / "kept")
    monkeypatch.setattr(runs, "run_one", the_rest)
    result = throughput(Asked(), tmp_path / "new" / "kept")
    monkeypatch.setattr(runs, "run_one", ran)
    assert result.resumed == 4
    assert [row.fields for row in result.rows] == [row.fields for row in throughput(Asked()).rows]


def test_a_kept_run_is_of_one_delivery_seed_version_and_set_of_options(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Anything else is run anew."""
    asked = Asked(deliveries="dev-035")
    (job,) = asked.jobs()
    kept = kept_rows(tmp_path)
    kept.keep(job, Row.of(ran(job)))
    (same,) = asked.jobs()
    assert kept.get(same) == Row.of(ran(job))
    others = [
        *replace(asked, deliveries="dev-024").jobs(),
        *replace(asked, seed=1).jobs(),
        *replace(asked, w=0.4).jobs(),
        *replace(asked, cell="roll_containers").jobs(),
        *replace(asked, requests=2).jobs(),
        replace(job, delivery=replace(job.delivery, stack=(job.delivery.stack or ())[1:])),
    ]
    assert [kept.get(other) for other in others] == [None] * len(others)
    assert len({key_of(each) for each in (job, *others)}) == len(others) + 1
    monkeypatch.setattr("depal.studies.kept.__version__", "0.0.0")
    assert kept.get(job) is None


@pytest.mark.parametrize("damage", ["", "{", "[]", "{}", "nul\0"])
def test_a_damaged_kept_run_is_run_again(done: list[str], tmp_path: Path, damage: str) -> None:
    """And replaced."""
    asked = Asked(deliveries="dev-035")
    throughput(asked, tmp_path)
    (file,) = tmp_path.iterdir()
    whole = file.read_text()
    file.write_text(damage)
    assert throughput(asked, tmp_path).resumed == 0
    assert len(done) == 2
    assert file.read_text() == whole


def test_names_of_deliveries_are_no_paths(tmp_path: Path) -> None:
    """Whatever an id holds, the file is in the folder."""
    (job,) = Asked(deliveries="dev-035").jobs()
    odd = replace(job, delivery=replace(job.delivery, id="../../b/" + "x" * 300))
    kept = kept_rows(tmp_path / "kept")
    kept.keep(odd, Row.of(ran(odd)))
    assert kept.get(odd) is not None
    assert [path.name for path in tmp_path.iterdir()] == ["kept"]


def test_a_run_that_breaks_down_is_reported_and_the_others_go_on(
    depal: Run, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """It is not kept, so that it is tried again."""

    def broken(job: Job, **_: object) -> object:
        raise RuntimeError(f"no [end] of {job.delivery.id}")

    monkeypatch.setattr(runs, "run_job", broken)
    file = two_boxes(tmp_path / "two.json")
    report = tmp_path / "t.json"
    words = ("--deliveries", file, "--keep", tmp_path / "kept", "--json", report)
    status, out, _ = depal("study", "throughput", *words)
    assert status == 1
    assert "other, seed 0: no end: RuntimeError: no [end] of other" in out
    fields = json.loads(report.read_text())
    assert fields["rows"] == []
    assert [failure["delivery"] for failure in fields["failures"]] == ["one", "other"]
    assert list((tmp_path / "kept").iterdir()) == []


def test_a_failure_is_beside_the_rows() -> None:
    """A study with one does not hold, nor does one without a row."""
    row = Row.of(fields_of())
    assert runs.Throughput((row,), (), 0).holds
    assert not runs.Throughput((row,), (Failure("d", 0, "why"),), 0).holds
    assert not runs.Throughput((), (), 0).holds


LOST: Fields = {"lost": 1, "stored": 3, "sequence": [gone(0, "lost")]}
HIT: Fields = {"collisions": 1, "referee": truth(hits=1)}


@pytest.mark.parametrize(
    ("changes", "status", "said"),
    [
        ({}, 0, "whole"),
        (LOST, 1, "dev-035, seed 0: b1: lost; it left the pallet at 7.2 s"),
        (HIT, 1, "dev-035, seed 0: 3.0 s: link_3 against b2, 61 N"),
        ({"referee": truth("box [b1]")}, 1, "dev-035, seed 0: box [b1]"),
    ],
)
def test_the_exit_status_says_whether_something_was_lost_hit_or_booked_wrongly(
    depal: Run, monkeypatch: pytest.MonkeyPatch, changes: Fields, status: int, said: str
) -> None:
    """A low rate alone is no failure."""
    monkeypatch.setattr(
        runs, "run_one", lambda job: fields_of(job.delivery.id, boxes_per_hour=90.0, **changes)
    )
    done, out, _ = depal("study", "throughput", "--deliveries", "dev-035")
    assert done == status
    assert ("WRONG" in out) is bool(status)
    assert said in out


@pytest.mark.usefixtures("done")
def test_the_report_has_the_fields_of_the_contract(depal: Run, tmp_path: Path) -> None:
    """Rows are those of `depal run --json`; the summary and a picture beside them."""
    report, plot = tmp_path / "t.json", tmp_path / "t.png"
    status, out, err = depal("study", "throughput", "--json", report, "--plot", plot)
    assert (status, err) == (0, "")
    assert "40 of 40 (100.0 %)" in out
    fields = json.loads(report.read_text())
    assert fields["version"] == __version__
    assert len(fields["rows"]) == 10
    assert fields["rows"][0] == fields_of(fields["rows"][0]["delivery"])
    summary = fields["summary"]
    assert (summary["boxes"], summary["stored"], summary["stored_share"]) == (40, 40, 1.0)
    names = ("lost", "collisions", "disagreements", "placed_twice", "suction_losses")
    assert [summary[name] for name in names] == [0] * len(names)
    assert summary["boxes_per_hour"]["median"] == 400.0
    assert summary["shares"] == {"arm motion": 0.9, "waiting for people": 0.1}
    assert summary["wall_seconds"] == {"median": 20.0, "max": 20.0}
    assert summary["plan_seconds"]["median"] == 0.02
    assert (summary["requests"], summary["served"]) == (20, 10)
    assert plot.read_bytes().startswith(b"\x89PNG")


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (("--deliveries", "dev-999"), "neither a file nor a shipped delivery is called 'dev-999'"),
        (("--w", "1.5"), "--w: 1.5 is out of range; expected a number in [0, 1]"),
        (("--cell", "defualt"), "did you mean 'default'"),
        (("--json", "nowhere/t.json"), "there is no folder 'nowhere'"),
        (("--plot", "t.gif"), "'t.gif' is no picture's name"),
    ],
)
def test_bad_input_is_one_error_before_anything_runs(
    depal: Run, done: list[str], words: tuple[str, ...], said: str
) -> None:
    """On the error output, exit status 2."""
    status, _, err = depal("study", "throughput", *words)
    assert status == 2
    assert said in " ".join(err.split())
    assert done == []


def test_a_delivery_on_another_pallet_stops_the_study_before_it_begins(
    depal: Run, done: list[str], tmp_path: Path
) -> None:
    """Whichever of the deliveries it is."""
    file = two_boxes(tmp_path / "two.json")
    entries = json.loads(file.read_text())
    entries[1]["pallet"]["size"] = [1.0, 0.6, 0.12]
    file.write_text(json.dumps(entries))
    status, _, err = depal("study", "throughput", "--deliveries", file)
    assert status == 2
    assert "delivery other in cell default" in err
    assert done == []


def test_a_folder_that_cannot_be_made_is_refused(tmp_path: Path, done: list[str]) -> None:
    """A file is in its place."""
    (tmp_path / "file").write_text("")
    with pytest.raises(SettingError, match="--keep: cannot make the folder"):
        throughput(Asked(), tmp_path / "file")
    assert done == []


def test_numbers_of_runs_and_requests_are_checked() -> None:
    """For callers without a command line too."""
    with pytest.raises(SettingError, match="--seeds: 0 is out of range; expected 1 or more"):
        Asked(seeds=0).jobs()
    with pytest.raises(SettingError, match="--requests-per-delivery: -1 is out of range"):
        Asked(requests=-1).jobs()


@pytest.mark.slow
def test_real_runs_in_worker_processes_are_those_of_this_process(
    depal: Run, tmp_path: Path
) -> None:
    """To the byte of their event logs; every box is accounted for, nothing is hit."""
    file = two_boxes(tmp_path / "two.json")
    reports = []
    for workers in (1, 2):
        report = tmp_path / f"{workers}.json"
        words = ("--deliveries", file, "--seed", 1, "--workers", workers, "--json", report)
        status, _, err = depal("study", "throughput", *words)
        assert (status, err) == (0, "")
        reports.append(json.loads(report.read_text()))
    alone, together = reports
    for rows in zip(alone["rows"], together["rows"], strict=True):
        first, second = (
            {name: row[name] for name in row.keys() - {"wall_seconds", "plan_seconds"}}
            for row in rows
        )
        assert first == second
    summary = alone["summary"]
    assert summary["boxes"] == summary["stored"] + summary["exceptions"] == 4
    assert summary["stored"] > 0
    assert sum(summary["shares"].values()) == pytest.approx(1.0)
    assert len(alone["rows"][0]["requests"]) == 2
