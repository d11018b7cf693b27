"""An edge beyond which nothing can be seen is no edge."""

from hypothesis import given
from hypothesis import strategies as st

from depal.cell.half_seen import LESS, may_reach_behind
from depal.geometry import OrientedBox, Vector3

EYE, ABOVE = (-0.2, -0.75, 0.6), (1.55, 0.0, 3.4)
FRONT = (-1.0, 0.0, 0.0)
SEEN = OrientedBox.upright((1.862, 0.29, 0.77), (0.246, 0.211, 0.271))
"""Of a box that is 246 mm broad and was seen 211 mm broad, behind the one beside it."""

BEFORE = OrientedBox.upright((1.858, 0.02, 0.815), (0.329, 0.267, 0.36))

edge = st.floats(0.1, 0.5)
sizes = st.tuples(edge, edge, edge)


def test_a_front_that_ends_where_another_box_hides_the_rest_may_be_broader() -> None:
    """By no more than what is hidden."""
    assert may_reach_behind(SEEN, (0.246, 0.211), FRONT, [BEFORE], [EYE, ABOVE])
    assert not may_reach_behind(SEEN, (0.211,), FRONT, [BEFORE], [EYE, ABOVE])
    assert not may_reach_behind(SEEN, (0.8,), FRONT, [BEFORE], [EYE, ABOVE])


def test_what_one_camera_hides_another_may_show() -> None:
    """Only where no camera that sees fronts sees past it."""
    assert not may_reach_behind(SEEN, (0.246,), FRONT, [BEFORE], [EYE, (-0.2, 0.75, 0.6)])


@given(sizes, st.floats(-0.4, 0.4), edge)
def test_a_box_that_nothing_stands_before_is_as_broad_as_it_looks(
    size: Vector3, y: float, width: float
) -> None:
    """Alone, or flush beside others."""
    box = OrientedBox.upright((1.8, y, 0.5), size)
    beside = [OrientedBox.upright((1.8, y + side * size[1], 0.5), size) for side in (-1.0, 1.0)]
    assert not may_reach_behind(box, (width,), FRONT, beside, [EYE])


@given(sizes, st.floats(-0.4, 0.4), st.floats(2 * LESS, 0.3), st.sampled_from((-1.0, 1.0)))
def test_a_box_may_reach_behind_whatever_hides_all_of_the_rest(
    size: Vector3, y: float, more: float, side: float
) -> None:
    """A wall before one of its ends."""
    box = OrientedBox.upright((1.8, y, 0.5), size)
    wall = OrientedBox.upright(
        (1.8 - size[0] / 2 - 0.05, y + side * (size[1] / 2 + 0.5), 0.5), (0.06, 1.0, 2.0)
    )
    eye = (-0.2, y, 0.5)
    assert may_reach_behind(box, (size[1] + more,), FRONT, [wall], [eye])
