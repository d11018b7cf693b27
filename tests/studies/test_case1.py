"""Case study 1 reproduces the paper's table, and its invariants hold on every pallet."""

import dataclasses

import numpy as np
import pytest

from depal.errors import SettingError
from depal.studies import paper
from depal.studies.case1 import STUCK, Case1, run_case1
from depal.studies.pallets import GENERATORS
from depal.studies.table1 import Table1, table1


@pytest.fixture(scope="module")
def sampled() -> Table1:
    """A quarter of the full size."""
    return table1(2500)


def test_every_check_holds_on_a_sample(sampled: Table1) -> None:
    """Means, deviations, reductions and invariants, within three standard errors."""
    assert [check for check in sampled.checks if not check.holds] == []
    assert len(sampled.checks) == 6 + 5 * len(paper.WEIGHTS)


def test_the_h_only_mean_is_half_of_the_others(sampled: Table1) -> None:
    """(E[n] - 1) / 2 = 12.75 for n uniform in 9..44."""
    h = sampled.rows[0].h
    assert abs(h.mean - 12.75) <= 3 * h.error


def test_the_reductions_rise_with_the_weight(sampled: Table1) -> None:
    """Fig. 8's curve."""
    means = [row.reduction.mean for row in sampled.rows]
    assert means == sorted(means)


@pytest.mark.slow
def test_the_table_is_the_papers_at_full_size() -> None:
    """10,000 pallets at the default seed: within SELECTION's tolerances, nothing added."""
    full = table1()
    assert full.pallets == 10_000
    assert [check for check in full.checks if not check.holds] == []
    for row in full.rows:
        printed = paper.TABLE_1[row.w]
        assert abs(row.h.mean - printed.h_mean) <= 0.5
        assert abs(row.hl.mean - printed.hl_mean) <= 0.5
        assert abs(row.h.std - printed.h_std) <= 1.0
        assert abs(row.hl.std - printed.hl_std) <= 1.0
        assert abs(row.reduction.mean - printed.reduction) <= 0.35


@pytest.mark.parametrize("generator", sorted(GENERATORS))
def test_the_invariants_hold_for_every_generator(generator: str) -> None:
    """Equal beta, w rising, the limit."""
    result = table1(200, seed=9, generator=generator)
    assert all(check.holds for check in result.checks)
    assert result.stuck < 200


def test_a_broken_invariant_is_noticed(monkeypatch: pytest.MonkeyPatch) -> None:
    """The checks can fail: counts that rise, undercut the limit, and differ at equal beta."""
    case = run_case1("guillotine", paper.WEIGHTS, 50, seed=0)
    worse = case.hl.copy()
    worse[0] = (5, 6, 7, 8, 9)
    worse[1] = -3
    broken: Case1 = dataclasses.replace(case, hl=worse, twin=case.twin + 1)
    monkeypatch.setattr("depal.studies.table1.run_case1", lambda *_: broken)
    failed = {check.name for check in table1(50).checks if not check.holds}
    assert {
        "equal beta gives equal runs",
        "no count rises when w rises",
        "no count is below |T(r)| - 1",
    } <= failed


def test_stuck_trials_are_counted_and_left_out(monkeypatch: pytest.MonkeyPatch) -> None:
    """A cycle of blockers is no count."""
    case = run_case1("guillotine", (0.5,), 50, seed=0)
    hl = case.hl.copy()
    hl[:10] = STUCK
    stuck = dataclasses.replace(case, hl=hl)
    monkeypatch.setattr("depal.studies.table1.run_case1", lambda *_: stuck)
    result = table1(50, weights=(0.5,))
    assert result.stuck == 10
    assert result.rows[0].h.n == 40
    assert result.rows[0].hl.mean == np.mean(case.hl[10:, 0])


def test_an_unknown_generator_is_answered_with_what_exists() -> None:
    """Before any work."""
    with pytest.raises(SettingError, match=r"'guillotine'"):
        table1(10, generator="gilotine")
