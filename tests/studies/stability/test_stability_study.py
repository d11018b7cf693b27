"""The study of stability: who falls, what is drawn, and what is counted."""

import math

import numpy as np
import pytest

from depal.app.reports import stability_report
from depal.geometry import OrientedBox, prisms_of
from depal.selection.stability import EDGE, LEAST, StandingPile
from depal.studies.drawing import Agreed, Along, stability_figure
from depal.studies.stability import LOOSE, PACKED, Stability, mcnemar, stability, summed_up
from depal.studies.stability.physics import TOUCHING, let_go
from depal.studies.stability.states import Compared, compare, draw_state
from depal.studies.stability.unloading import Pair, Taken, draw_job, run_pair, take_apart


@pytest.mark.parametrize(("out", "falls"), [(0.15, False), (0.25, True)])
def test_a_box_over_an_edge_falls_in_mujoco_too(out: float, falls: bool) -> None:  # noqa: FBT001
    """Its centre inside, or out."""
    low = OrientedBox.from_corner((0, 0, 0), (0.4, 0.4, 0.2))
    high = OrientedBox.from_corner((out, 0, 0.2), (0.4, 0.4, 0.2))
    let = let_go(prisms_of([low, high]), np.array([4.0, 4.0]))
    assert let.fell == falls
    assert (let.moved > 0.01) == falls


def test_an_empty_pallet_stands() -> None:
    """Nothing moves."""
    assert not let_go(np.empty((0, 8)), np.empty(0)).fell


def test_a_state_depends_on_its_number_alone_and_leaves_nothing_hanging() -> None:
    """Every box stands on something."""
    for index in range(10):
        state, again = draw_state(3, index), draw_state(3, index)
        assert state.prisms.tolist() == again.prisms.tolist()
        assert state.masses.tolist() == again.masses.tolist()
        assert StandingPile(state.prisms, state.masses).assumed == ()


def test_the_guard_takes_every_box_as_well() -> None:
    """In another order where it must; without a threshold above what is there in the same."""
    job = draw_job(LOOSE, 0, 0, 0.03)
    pile = StandingPile(job.prisms, job.masses, rule=TOUCHING)
    plain, guarded = take_apart(job, pile, 0.2), take_apart(job, pile, 0.2, 0.03)
    assert sorted(guarded.order) == sorted(plain.order) == list(range(len(job.masses)))
    assert take_apart(job, pile, 0.2, LEAST).order == plain.order


@pytest.mark.slow
def test_pairs_and_comparisons_are_the_same_every_time() -> None:
    """But for the seconds."""

    def run() -> tuple[object, ...]:
        pair = run_pair(draw_job(LOOSE, 0, 4, 0.03), 0.2, 0.03)
        return pair.without.order, pair.guarded.order, pair.without.margins, pair.actions

    assert run() == run()
    assert compare(draw_state(0, 0)) == compare(draw_state(0, 0))


@pytest.mark.parametrize(
    ("first", "second", "p"), [(0, 0, 1.0), (1, 1, 1.0), (10, 0, 2 / 1024), (3, 1, 0.625)]
)
def test_the_test_of_mcnemar_is_exact(first: int, second: int, p: float) -> None:
    """Against the binomial sums by hand."""
    assert mcnemar(first, second) == pytest.approx(p)


def taken(fell_at: int | None, margins: list[float]) -> Taken:
    """A made-up unloading of five boxes."""
    return Taken([0, 1, 2, 3, 4], margins, fell_at, 0, 1, [0.001], [0.002])


def made_up(saved: int = 8) -> Stability:
    """So many pallets fall only without the guard, one never."""
    firm, low = taken(None, [0.3, 0.2, 0.2, 0.3]), taken(2, [0.05, -1.0])
    pairs = [Pair(LOOSE, 5, low, firm, (3, 3), 2) for _ in range(saved)]
    pairs += [Pair(LOOSE, 5, firm, firm, (2, 2), 0)]
    pairs += [Pair(name, 5, firm, firm, (1, 1), 0) for name in PACKED]
    compared = [Compared("cubic", 5, margin, margin, margin <= EDGE, 0.0) for margin in (0.1, -1.0)]
    return summed_up(compared, pairs, 0.2, 0.03)


def test_rows_pairs_and_agreement_count_what_there_is() -> None:
    """By hand."""
    result = made_up()
    loose = [row for row in result.rows if row.pallets == LOOSE]
    assert [(row.guard, row.collapse.count, row.collapse.of) for row in loose] == [
        (False, 8, 9),
        (True, 0, 9),
    ]
    assert loose[0].along[0] == pytest.approx(0.05)
    assert loose[0].along[-3] == LEAST
    assert math.isnan(loose[0].along[1])  # five boxes have four steps
    assert (result.paired[0].saved, result.paired[0].spoilt) == (8, 0)
    assert result.paired[0].p == pytest.approx(2 / 256)
    assert result.agreement.agree.value == 1.0
    assert result.agreement.highest == LEAST


def test_the_report_says_which_figures_are_met() -> None:
    """And fails only where something fell that must not."""
    report = stability_report(made_up(), 0, 1.0)
    assert report.holds
    checks = report.fields["checks"]
    assert isinstance(checks, list)
    assert all(check["holds"] for check in checks)  # type: ignore[call-overload, index]
    few = stability_report(made_up(1), 0, 1.0)
    assert few.holds
    assert not all(check["holds"] for check in few.fields["checks"])  # type: ignore[union-attr, call-overload, index]
    row = report.fields["rows"][0]  # type: ignore[index, call-overload]
    assert {"pallets", "policy", "guard", "collapse_rate", "actions", "margin"} <= set(row)  # type: ignore[arg-type]


def test_the_figure_says_what_the_guard_is_worth() -> None:
    """In its title, and beside the table."""
    figure = stability_figure(
        Along([0.05, -1.0], 0.08), Along([0.05, 0.04], 0.01), Agreed((9, 1), (0, 5)), 0.03
    )
    words = " ".join(text.get_text() for text in figure.texts)
    assert "8.0 % of unloadings collapse without a guard, 1.0 % with it" in words
    assert "agree: 93.3 % of 15 states" in words


@pytest.mark.slow
def test_a_small_study_runs_whole() -> None:
    """Every kind of pallet, all states."""
    result = stability(pallets=4, states=5, seed=1)
    assert [row.pallets for row in result.rows[::2]] == [LOOSE, *PACKED]
    assert result.agreement.states == 5
    assert stability_report(result, 1, 0.1).draw is not None
