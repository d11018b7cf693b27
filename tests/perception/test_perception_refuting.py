"""What a gripper or a person has refuted is not proposed again; whatever else may be there is."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from depal.geometry import OrientedBox, Pose
from depal.perception.detecting import Refuted, RefutedFaces
from depal.perception.faces import Facing, Raster, Rectangle
from depal.perception.proposals.candidates import Candidates
from depal.perception.proposals.kernels import FEATURES

FRONT = Pose((1.0, 1.0, 2.0), ((0.0, 0.0, 1.0), (-1.0, 0.0, 0.0), (0.0, -1.0, 0.0)))
TOP = Pose((2.0, 1.0, 2.0), ((0.0, -1.0, 0.0), (-1.0, 0.0, 0.0), (0.0, 0.0, -1.0)))

near = st.floats(-0.01, 0.01)
part = st.floats(0.2, 0.8)


def raster(facing: Facing, pose: Pose) -> Raster:
    """Of nothing."""
    empty = np.zeros((2, 2), dtype=np.float32)
    colour = np.zeros((2, 2, 3), dtype=np.uint8)
    return Raster(facing, pose, 0.004, colour, empty, empty > 0)


def refuted(faces: RefutedFaces, *rectangles: Rectangle) -> list[bool]:
    """Which of them."""
    values = np.array(
        [(r.u, r.v, r.width, r.height, r.turn, r.depth) for r in rectangles], dtype=float
    )
    return faces.among(Candidates(values, np.zeros((len(values), FEATURES)))).tolist()


def halves(whole: Rectangle, share: float) -> tuple[Rectangle, Rectangle]:
    """Two faces side by side where one was believed."""
    left = share * whole.width
    right = whole.width - left
    return (
        Rectangle(whole.u - right / 2, whole.v, left, whole.height, 0.0, whole.depth),
        Rectangle(whole.u + left / 2, whole.v, right, whole.height, 0.0, whole.depth),
    )


@given(near, near, part)
def test_a_refuted_face_is_known_again_and_its_parts_are_not_it(
    u: float, v: float, share: float
) -> None:
    """Though it is seen a bit beside where it was; one far behind is another."""
    face = Rectangle(0.5, 0.5, 0.36, 0.2, 0.0, 0.4)
    again = Rectangle(0.5 + u, 0.5 + v, 0.36, 0.2, 0.0, 0.41)
    behind = Rectangle(0.5, 0.5, 0.36, 0.2, 0.0, 0.6)
    found = refuted(RefutedFaces((face,)), again, behind, *halves(face, share))
    assert found == [True, False, False, False]


@given(part, st.floats(0.0, 0.2), st.floats(0.0, 0.2))
def test_nothing_that_reaches_over_a_seam_is_believed_and_what_ends_at_it_is(
    share: float, wider: float, higher: float
) -> None:
    """Of whatever size; but a face that ends at the rim of a cup may have let that one leak."""
    span = Rectangle(0.5, 0.5, 0.3, 0.16, 0.0, 0.4)
    over = Rectangle(0.5, 0.5, 0.32 + wider, 0.18 + higher, 0.0, 0.4)
    tight = Rectangle(0.5, 0.5, 0.3 + wider, 0.165, 0.0, 0.4)
    faces = RefutedFaces(spans=(span,))
    assert refuted(faces, over, tight, *halves(over, 0.5)) == [True, False, False, False]
    assert refuted(faces, *halves(span, share)) == [False, False]


def test_a_place_counts_on_the_raster_from_which_it_is_seen() -> None:
    """A front is at the depth where it is; from above nothing of it is seen."""
    flat = OrientedBox.upright((1.5, 0.2, 0.7), (0.002, 0.3, 0.2))
    seen = Refuted(spans=(flat,))
    (front,) = seen.on(raster(Facing.FRONT, FRONT)).spans
    assert (front.u, front.v) == pytest.approx((0.8, 1.3))
    assert (front.width, front.height, front.depth) == pytest.approx((0.3, 0.2, 0.499))
    assert seen.on(raster(Facing.TOP, TOP)).spans == ()


def test_of_a_box_its_front_and_its_top_are_refuted() -> None:
    """Each at its own depth."""
    box = Refuted((OrientedBox.upright((1.5, 0.2, 0.7), (0.4, 0.3, 0.2)),))
    (front,) = box.on(raster(Facing.FRONT, FRONT)).faces
    (top,) = box.on(raster(Facing.TOP, TOP)).faces
    assert (front.width, front.height, front.depth) == pytest.approx((0.3, 0.2, 0.3))
    assert (top.width, top.height, top.depth) == pytest.approx((0.3, 0.4, 1.2))
