"""The guard: the first that leaves a firm pile, else the firmest."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from depal.domain import BoxId
from depal.geometry import OrientedBox, prisms_of
from depal.selection.stability import (
    THRESHOLD,
    Certificate,
    Proof,
    StandingPile,
    Watch,
    guard,
)

MARGINS = st.lists(st.floats(-1.0, 0.5), max_size=8)


def certified(margin: float) -> Certificate:
    """With a margin and nothing else."""
    return Certificate(margin, Proof.EXACT, (1.0, 0.0), ())


@given(MARGINS)
def test_the_first_that_leaves_enough_is_taken(margins: list[float]) -> None:
    """And nothing behind it is looked at."""
    looked: list[int] = []

    def certify(place: int) -> Certificate:
        looked.append(place)
        return certified(margins[place])

    result = guard(range(len(margins)), certify)
    enough = [place for place, margin in enumerate(margins) if margin >= THRESHOLD]
    if enough:
        assert result.chosen == enough[0]
        assert not result.forced
        assert looked == list(range(enough[0] + 1))
        assert [low.candidate for low in result.passed_over] == looked[:-1]
    else:
        assert result.forced == bool(margins)
        assert looked == list(range(len(margins)))


@given(MARGINS.filter(lambda margins: all(margin < THRESHOLD for margin in margins) and margins))
def test_where_all_are_below_the_firmest_is_taken(margins: list[float]) -> None:
    """The first of equals; those before it are put later."""
    result = guard(range(len(margins)), lambda place: certified(margins[place]))
    assert result.chosen == margins.index(max(margins))
    assert [low.candidate for low in result.passed_over] == list(range(result.chosen))
    assert result.reason.startswith("no candidate leaves a firm pile")


def test_nothing_to_choose_from_is_said() -> None:
    """No candidates, no choice."""
    result = guard([], certified)
    assert (result.chosen, result.certificate, result.forced) == (None, None, False)
    assert result.reason == "there was nothing to choose from"


def test_reasons_name_the_margin() -> None:
    """Of what is chosen and of what is put later."""
    result = guard([0.01, 0.2], certified)
    assert (
        result.reason == "the pile that it leaves: margin exactly 0.200 g towards +x; 1 put later"
    )
    assert (
        result.passed_over[0].reason == "the pile that it leaves: margin exactly 0.010 g towards +x"
    )
    assert guard([0.2], certified).reason.endswith("0.200 g towards +x")


def test_a_watch_refuses_what_leaves_a_bridge_to_fall_and_relents_when_nothing_else_is_left() -> (
    None
):
    """A beam with a counterweight, and a box beside it."""
    cuboids = {
        "foot": ((0, 0, 0), (0.2, 0.2, 0.2)),
        "beam": ((0, 0, 0.2), (0.6, 0.2, 0.1)),
        "load": ((0, 0, 0.3), (0.2, 0.2, 0.1)),
        "other": ((2, 0, 0), (0.2, 0.2, 0.2)),
    }
    prisms = prisms_of(OrientedBox.from_corner(*cuboid) for cuboid in cuboids.values())
    names = tuple(map(BoxId, cuboids))
    load, other = BoxId("load"), BoxId("other")
    watch = Watch(StandingPile(prisms, np.array([1.0, 1.0, 3.0, 1.0]), names=names))
    assert watch.relent((load,)) is None
    assert watch.refusal(other) is None
    assert watch.refusal(BoxId("unheard of")) is None
    refused = watch.refusal(load)
    assert refused is not None
    assert "does not stand at rest, limited by beam" in refused.reason
    assert set(watch.certificates) == {load, other}
    assert watch.relent((load,)) == load
    assert watch.refusal(load) is None
