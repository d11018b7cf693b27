"""Words on a picture stand where they can be read."""

import itertools

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from depal.app.pictures.marks import BEYOND, Spot, spots_for

ROOM = (4.0, 3.0)
WORDS = (0.45, 0.25)


def square(x: float, y: float, edge: float) -> np.ndarray:
    """An outline."""
    return np.array((x, y)) + np.array([(-1, -1), (1, -1), (1, 1), (-1, 1)]) * edge / 2


MIDDLES = st.lists(st.tuples(st.floats(0.3, 3.7), st.floats(0.3, 2.7)), min_size=0, max_size=12)


@given(MIDDLES, st.floats(0.05, 0.9))
@settings(max_examples=30)
def test_no_words_cover_others_and_none_leave_the_picture(
    middles: list[tuple[float, float]], edge: float
) -> None:
    """However crowded it is, up to a dozen."""
    spots = spots_for([square(*at, edge) for at in middles], [WORDS] * len(middles), ROOM)
    for first, second in itertools.combinations(spots, 2):
        assert first.overlap(second) == 0.0
    for spot in spots:
        assert -1e-9 <= spot.x - spot.width / 2 <= spot.x + spot.width / 2 <= ROOM[0] + 1e-9
        assert -1e-9 <= spot.y - spot.height / 2 <= spot.y + spot.height / 2 <= ROOM[1] + 1e-9


@given(st.floats(0.3, 3.7), st.floats(0.3, 2.7), st.floats(0.05, 0.9))
def test_words_stand_inside_exactly_where_they_fit(x: float, y: float, edge: float) -> None:
    """Else beside, with a line."""
    (spot,) = spots_for([square(x, y, edge)], [WORDS], ROOM)
    assert spot.inside == (edge >= BEYOND * WORDS[0])
    if spot.inside:
        assert (spot.x, spot.y) == (
            np.mean(square(x, y, edge)[:, 0]),
            np.mean(square(x, y, edge)[:, 1]),
        )
    else:
        assert abs(spot.x - x) > WORDS[0] / 2 or abs(spot.y - y) > WORDS[1] / 2


def test_where_there_is_no_room_at_all_words_stay_in_the_middle() -> None:
    """A picture smaller than its words."""
    (spot,) = spots_for([square(0.1, 0.1, 0.1)], [WORDS], (0.2, 0.2))
    assert spot == Spot(0.1, 0.1, *WORDS)
