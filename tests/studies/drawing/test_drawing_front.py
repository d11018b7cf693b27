"""The front elevation, and where the graph goes on it."""

import networkx as nx
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from depal.studies.drawing.free_place import Obstacles, free_place
from depal.studies.drawing.front import Face, SeenBox, around, face_of, roomiest
from depal.studies.drawing.graph_layout import (
    Vertex,
    bend_of,
    covers_of,
    curve,
    direct,
    overlap,
    rows_of_depth,
    vertices_of,
)
from depal.studies.drawing.lettering import typeset

coordinates = st.floats(-2.0, 2.0)
sides = st.floats(0.05, 1.0)
faces = st.builds(Face, coordinates, coordinates, sides, sides)


def seen(x: float, y: float, z: float) -> SeenBox:
    """A cube of 0.2 m."""
    return SeenBox("b1", (x, y, z), (0.2, 0.2, 0.2))


def test_the_robots_left_is_the_left_of_the_picture() -> None:
    """A box at +y is drawn left of one at -y."""
    assert face_of(seen(1.5, 0.5, 0.1)).right < face_of(seen(1.5, -0.5, 0.1)).left


def test_a_step_moves_a_face_to_the_right_and_up() -> None:
    """What stands behind shows beside and above what stands before it."""
    face = face_of(seen(1.5, 0.0, 0.1), step=0.05)
    assert (face.left, face.bottom) == pytest.approx((-0.05, 0.05))


@given(faces, st.lists(faces, max_size=4))
def test_the_roomiest_point_is_clear_of_everything(face: Face, covers: list[Face]) -> None:
    """The circle that is promised lies in the face and outside of all covers."""
    spot, room = roomiest(face, covers)
    if room > 0:
        assert face.clearance(np.array([spot]))[0] >= room - 1e-9
        assert all(cover.clearance(np.array([spot]))[0] <= -room + 1e-9 for cover in covers)


@given(faces)
def test_the_roomiest_point_of_a_free_square_is_its_middle(face: Face) -> None:
    """Nothing in the way: the vertex stands in the middle."""
    assert roomiest(face, [])[0] == pytest.approx(face.middle)


@given(st.lists(faces, min_size=1, max_size=5))
def test_what_is_around_faces_holds_them_all(several: list[Face]) -> None:
    """The rulers measure the whole load."""
    whole = around(several)
    assert whole.clearance(np.array([face.middle for face in several])).min() > 0


def test_boxes_in_nearly_one_plane_stand_in_one_row() -> None:
    """Two centimetres are no row of depth; forty are."""
    boxes = [seen(1.92, 0, 0), seen(1.5, 0, 0), seen(1.52, 0.3, 0)]
    assert rows_of_depth(boxes) == [1, 0, 0]


def test_only_nearer_boxes_that_overlap_cover() -> None:
    """Neighbours that touch hide nothing of each other."""
    several = [Face(0, 0, 1, 1), Face(1, 0, 1, 1), Face(0.5, 0.5, 1, 1)]
    assert covers_of(several, [0, 0, 1]) == [[], [], several[:2]]


def test_the_vertex_of_a_hidden_box_lies_on_top_and_clear_of_the_others() -> None:
    """It says that it is hidden, and covers no other vertex."""
    several = [Face(0, 0, 1, 1), Face(0.02, 0.02, 0.9, 0.9)]
    vertices = vertices_of(several, covers_of(several, [0, 1]), 0.1)
    assert [vertex.hidden for vertex in vertices] == [False, True]
    assert np.hypot(*np.subtract(vertices[0].spot, vertices[1].spot)) > 0.2


@given(st.sets(st.tuples(st.integers(0, 7), st.integers(0, 7)).filter(lambda e: e[0] < e[1])))
def test_direct_arrows_are_the_fewest_that_say_the_same(edges: set[tuple[int, int]]) -> None:
    """Without cycles: the transitive reduction."""
    expected = nx.transitive_reduction(nx.DiGraph(sorted(edges))).edges
    assert direct(edges) == sorted(expected)


def test_all_arrows_of_a_cycle_are_direct() -> None:
    """A cycle has no one reduction; nothing is left out."""
    edges = [(0, 1), (1, 2), (2, 0), (0, 2)]
    assert direct(edges) == sorted(edges)


@pytest.mark.parametrize(
    ("others", "bent"), [([], False), ([(0.5, 0.4)], False), ([(0.5, 0.0)], True)]
)
def test_an_arrow_bends_only_around_a_vertex_in_its_way(
    others: list[tuple[float, float]], *, bent: bool
) -> None:
    """Straight where it can be."""
    spots = [(0.0, 0.0), (1.0, 0.0), *others]
    assert (bend_of((0, 1), spots, 0.1) != 0.0) == bent


@given(st.floats(-0.5, 0.5))
def test_a_curve_runs_from_its_start_to_its_end(bend: float) -> None:
    """Whatever its bend, which is half of the way to the side at the middle."""
    points = curve(np.array((0.0, 0.0)), np.array((0.0, 2.0)), bend)
    np.testing.assert_allclose(points[[0, -1]], ((0, 0), (0, 2)), atol=1e-12)
    assert points[12] == pytest.approx((bend, 1.0))


def test_words_stand_in_a_free_corner_of_their_box() -> None:
    """The upper right one, when nothing is in the way; else the next."""
    home, vertex = Face(0, 0, 1, 1), Vertex((0.5, 0.5), hidden=False)
    nothing = Obstacles(np.array([vertex.spot]), 0.1, np.empty((0, 2)), [])
    place, trouble = free_place(home, vertex, (0.3, 0.1), [], nothing)
    assert trouble == 0
    assert place.left > 0.5 < place.bottom
    taken = Obstacles(np.array([vertex.spot]), 0.1, np.empty((0, 2)), [place])
    other, trouble = free_place(home, vertex, (0.3, 0.1), [], taken)
    assert trouble == 0
    assert not overlap(place, other)


def test_words_of_a_hidden_box_stand_beside_its_vertex() -> None:
    """Its corners lie on other boxes: they would name the wrong one."""
    vertex = Vertex((0.5, 0.5), hidden=True)
    nothing = Obstacles(np.array([vertex.spot]), 0.1, np.empty((0, 2)), [])
    home = Face(0, 0, 2, 2)
    place, _ = free_place(home, vertex, (0.3, 0.1), [home], nothing)
    assert place.left == pytest.approx(0.63)
    assert place.middle[1] == pytest.approx(0.5)


@pytest.mark.parametrize(
    ("label", "set_as"),
    [("b4", "$b_{4}$"), ("b_12", "$b_{12}$"), ("lemonade", "lemonade"), ("5 $", r"5 \$")],
)
def test_a_number_after_a_letter_becomes_an_index(label: str, set_as: str) -> None:
    """As the paper writes b_4; other names stay as they are."""
    assert typeset(label) == set_as
