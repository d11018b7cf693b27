"""The benchmark measures what it says."""

import math

import pytest

from depal.domain import Request
from depal.selection import EXACT, BlockingGraph
from depal.studies.bench import Figure, bench_selection
from depal.studies.bench.peers import networkx_selection
from depal.studies.bench.selection import _RULE, perceived_pallet


@pytest.mark.slow
def test_every_figure_of_the_selection_is_measured_and_met_with_room_for_noise() -> None:
    """Three times the target on any machine; the figures themselves are for `make figures`."""
    figures = bench_selection()
    assert len({figure.name for figure in figures}) == len(figures) == 7
    for figure in figures:
        assert 0 < figure.value <= 3 * figure.target, figure.name


def test_memory_is_linear_in_the_edges() -> None:
    """Ten times the boxes cost about as much an edge."""
    small, large = (BlockingGraph(perceived_pallet(n, 0), EXACT) for n in (500, 5000))
    assert large.nbytes / large.edges <= 3 * small.nbytes / small.edges


def test_the_peer_works_where_it_is_installed() -> None:
    """And takes some time."""
    pytest.importorskip("networkx")
    boxes = perceived_pallet(30, 0)
    seconds = networkx_selection(boxes, Request(priority=0.5, box=boxes[3].id), _RULE)
    assert seconds is not None
    assert seconds > 0


def test_a_peer_that_is_not_installed_has_no_figure(monkeypatch: pytest.MonkeyPatch) -> None:
    """None, not a guess."""
    monkeypatch.setitem(__import__("sys").modules, "networkx", None)
    boxes = perceived_pallet(5, 0)
    assert networkx_selection(boxes, Request(priority=0.5, box=boxes[3].id), _RULE) is None


@pytest.mark.parametrize(
    ("value", "better", "met"),
    [
        (1.0, "lower", True),
        (3.0, "lower", False),
        (3.0, "higher", True),
        (1.0, "higher", False),
        (math.nan, "lower", False),
    ],
)
def test_a_figure_is_met_on_its_better_side(value: float, better: str, met: object) -> None:
    """Lower or higher, and never when it could not be measured."""
    figure = Figure("f", value, "s", 2.0, better, 1)  # type: ignore[arg-type]
    assert figure.met is met
