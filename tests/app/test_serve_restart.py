"""A controller that is killed anywhere in a run: nothing lost, nothing doubled."""

from collections import Counter
from pathlib import Path

import numpy as np
import pytest
from served_runs import Served, served
from tiny_runs import THREE, gtin, tiny

from depal.cell.departures import Fate
from depal.domain import Request
from depal.executive.clock import run_simulated

WANTED = (("r-1", Request(0.9, gtin=gtin(1))), ("r-2", Request(0.3, gtin=gtin(2))))


def holds(run: Served) -> None:
    """Each case ended once, the books agree with the referee, each request ended once."""
    departures = run.session.wired.work.departures.sequence
    assert len(departures) == len({departure.box for departure in departures}) == len(THREE)
    assert {departure.fate for departure in departures} <= {Fate.STORED, Fate.BY_PERSON}
    indices = run.cell.witness.indices
    stored = [departure for departure in departures if departure.fate is Fate.STORED]
    for departure in stored:
        assert run.cell.referee.where(indices[departure.box]) == departure.place
    movements = run.store.movements()
    assert sorted(m.box for m in movements) == sorted(d.box for d in stored)
    assert run.cell.referee.summary().collisions == ()
    ends = set(run.notes.requests)  # told again after a restart, an end is the same end
    assert Counter(key for key, *_ in ends) == {"r-1": 1, "r-2": 1}
    assert [state for _, state, _ in run.notes.runs] == ["done"]


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(10))
def test_killed_at_a_random_moment_a_run_goes_on_where_it_was(seed: int, tmp_path: Path) -> None:
    """Twice in each run; the world lives on, the sensors tell the rest."""
    draw = np.random.default_rng(seed)
    cuts = (draw.uniform(1.0, 20.0), draw.uniform(1.0, 12.0))
    run = run_simulated(served(tiny(*THREE), tmp_path / "run", *cuts, requests=WANTED))
    assert run.found
    holds(run)


@pytest.mark.slow
def test_a_run_that_nobody_kills_asks_nobody_and_serves_its_requests(tmp_path: Path) -> None:
    """The control."""
    run = run_simulated(served(tiny(*THREE), tmp_path / "run", requests=WANTED))
    holds(run)
    assert run.notes.questions == []
    assert all(served for _, served, _, _ in run.notes.requests)
