"""The benchmark of the executive measures what it says."""

import sys
from collections import Counter
from itertools import islice
from pathlib import Path

import pytest

from depal.executive.commands import Start
from depal.executive.events import decode
from depal.executive.journal import SqliteJournal
from depal.executive.restart import restored
from depal.executive.snapshot import freeze
from depal.studies.bench import Figure, bench_executive
from depal.studies.bench.executive_cpp import CppForest, behaviortree_cpp_tick
from depal.studies.bench.executive_peers import (
    Forest,
    gtpyhop_plan,
    gtpyhop_planner,
    py_trees_tick,
)
from depal.studies.bench.executive_restart import folded, recalled, write_journal
from depal.studies.bench.executive_rim import append_figures, command_figures, simulated_figure
from depal.studies.bench.executive_work import Shift, actions_of, percentile, store_tasks

ORDER = [action.name for action in actions_of(store_tasks())]


SYNCED = ("fact to command", "journal append, fully synced")
"""Figures that wait for the disk, whatever that takes."""


def _near(figures: list[Figure]) -> None:
    """Every figure is a time within five times its target; more where the disk is waited for."""
    assert len({figure.name for figure in figures}) == len(figures)
    for figure in figures:
        room = 50 if figure.name.startswith(SYNCED) else 5
        assert 0 < figure.value <= room * figure.target, figure


@pytest.mark.slow
def test_every_figure_of_the_executive_is_measured_with_room_for_noise() -> None:
    """The figures themselves are for `depal bench executive`."""
    done: list[tuple[int, int]] = []
    figures = bench_executive(lambda *at: done.append(at))
    assert len(figures) == 19
    _near(figures)
    assert done[0][0] == 0
    assert done[-1][0] == done[-1][1]


def test_the_rim_is_measured_without_the_engine_alone() -> None:
    """A few repetitions of each."""
    _near([*command_figures(stores=3), *append_figures(normal=20, synced=5)])
    assert simulated_figure(stores=25).name == "1 hours of simulated work, 25 stores"


@pytest.mark.parametrize("stores", [1, 5])
def test_a_shift_keeps_its_stores_open_and_runs_all_seven_actions(stores: int) -> None:
    """In equal shares, with facts from outside in between; all of it can be folded again."""
    shift = Shift(stores)
    steps = [timed.step for timed in islice(shift.inputs(), 300)]
    state = shift.engine.state
    started = Counter(
        start.action.name for step in steps for start in step.commands if isinstance(start, Start)
    )
    assert set(started) == set(ORDER)
    assert max(started.values()) - min(started.values()) <= 1
    assert stores - 1 <= len(state.trees) <= stores
    assert not any(key.endswith(".fault") for key in state.facts)
    folded = restored(store_tasks(), (event for step in steps for event in step.events))
    assert freeze(folded.state) == freeze(state)


def test_both_ways_of_a_restart_lead_to_the_same_engine(tmp_path: Path) -> None:
    """And to what the journal holds, to the last event."""
    path = tmp_path / "cell.journal"
    write_journal(path, 2345)
    with SqliteJournal(path) as journal:
        assert journal.last == 2345
        snapshot = journal.snapshot()
        assert snapshot is not None
        assert 1300 < snapshot.sequence < 2345
        records = list(journal.read())
    assert all(decode(record.at, record.kind, record.body) for record in records)
    assert freeze(folded(path).state) == freeze(recalled(path).state)


def test_percentiles_are_values_that_occur() -> None:
    """The smallest that enough of the values do not exceed."""
    values = [float(value) for value in range(100, 0, -1)]
    assert percentile(values, 50) == 50.0
    assert percentile(values, 99) == 99.0
    assert percentile([7.0], 99) == 7.0


def test_behaviour_trees_do_the_same_work_where_they_are_installed() -> None:
    """All seven actions of each store in their order, one store after the other."""
    forest = Forest(pytest.importorskip("py_trees"), stores=3)
    _does_two_stores(forest)
    seconds = py_trees_tick(stores=2, ticks=5)
    assert seconds is not None
    assert seconds > 0


def test_behaviour_trees_in_cpp_do_the_same_work_where_they_are_installed() -> None:
    """The same, on the library's own blackboards."""
    forest = CppForest(pytest.importorskip("behaviortreepy"), stores=3)
    _does_two_stores(forest)
    seconds = behaviortree_cpp_tick(stores=2, ticks=5)
    assert seconds is not None
    assert seconds > 0


def _does_two_stores(forest: Forest | CppForest) -> None:
    ran = []
    for _ in range(14):
        ran.append(forest.running)
        forest.end_one()
        forest.tick()
    assert ran == [(action, box) for box in ("b1", "b2") for action in ORDER]
    assert forest.stored == 2
    assert forest.running == (ORDER[0], "b3")


def test_a_planner_plans_the_same_work_where_it_is_installed() -> None:
    """All seven actions of each store."""
    pytest.importorskip("gtpyhop")
    plan = gtpyhop_planner(boxes=2)
    assert plan is not None
    assert plan() == [(action, box) for box in ("b0", "b1") for action in ORDER]
    seconds = gtpyhop_plan(boxes=1)
    assert seconds is not None
    assert seconds > 0


def test_peers_that_are_not_installed_have_no_figure(monkeypatch: pytest.MonkeyPatch) -> None:
    """None, not a guess."""
    for name in ("py_trees", "gtpyhop", "behaviortreepy"):
        monkeypatch.setitem(sys.modules, name, None)
    assert py_trees_tick(stores=1, ticks=1) is None
    assert gtpyhop_plan(boxes=1) is None
    assert behaviortree_cpp_tick(stores=1, ticks=1) is None
