"""A face that was found twice is one face; others stay, in their order."""

from dataclasses import replace

from hypothesis import given
from hypothesis import strategies as st

from depal.geometry import Pose
from depal.perception.faces import Face, Facing
from depal.perception.observing import distinct

places = st.lists(st.integers(0, 5), min_size=1, max_size=8)


def face_at(place: int, score: float) -> Face:
    """One of faces that are 15 cm apart."""
    return Face(Facing.FRONT, Pose((0.0, 0.15 * place, 0.3)), (0.15, 0.2), score)


@given(places, st.randoms(use_true_random=False))
def test_at_every_place_the_likeliest_stays(where: list[int], random: object) -> None:
    """Whatever the order; what stays keeps it."""
    faces = [face_at(place, 0.1 + 0.1 * k) for k, place in enumerate(where)]
    random.shuffle(faces)  # type: ignore[attr-defined]
    left = distinct(faces)
    assert len(left) == len(set(where))
    assert list(left) == [face for face in faces if face in left]
    for face in left:
        assert all(o.score <= face.score for o in faces if o.cell_from_face == face.cell_from_face)


@given(places)
def test_what_was_known_before_stays(where: list[int]) -> None:
    """Though it be less likely."""
    known = [face_at(place, 0.05) for place in where]
    again = [replace(face, score=0.9) for face in known]
    assert distinct(again, known) == ()
    assert len(distinct([face_at(6, 0.9)], known)) == 1
