"""What the referee takes for the truth."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from perception_truths import CAMERAS, SIZE, wall_of

from depal.domain import CameraMount, Gtin
from depal.geometry import OrientedBox, Pose
from depal.perception.faces import Facing
from depal.simulation.imaging.lens import aimed
from depal.studies.perception import TrueBox, truth_of
from depal.studies.perception.truth import front_and_top

YAWS = st.floats(-math.pi, math.pi)


@given(YAWS)
def test_front_and_top_are_faces_of_their_box(yaw: float) -> None:
    """Their corners are corners of the box; the front looks to the robot, the top up."""
    shape = OrientedBox.upright((1.6, 0.2, 0.5), SIZE, yaw)
    front, top = front_and_top(0, shape)
    for face, outward in ((front, (-1, 0, 0)), (top, (0, 0, 1))):
        apart = np.linalg.norm(face.corners[:, None] - shape.corners[None], axis=2)
        assert apart.min(axis=1) == pytest.approx(np.zeros(4), abs=1e-9)
        turn = np.array(face.cell_from_face.rotation)
        assert np.linalg.det(turn) == pytest.approx(1.0)
        assert -turn[:, 2] @ outward > 0.7
    assert np.array(front.cell_from_face.rotation)[2, 1] == pytest.approx(-1.0)
    assert top.size[0] == pytest.approx(front.size[0])


def test_which_edge_is_up_does_not_matter() -> None:
    """A box that lies on its side has a front and a top like any other."""
    lying = OrientedBox(
        Pose((1.6, 0.0, 0.5), ((0.0, 0.0, 1.0), (0.0, -1.0, 0.0), (1.0, 0.0, 0.0))), (0.2, 0.3, 0.4)
    )
    front, top = front_and_top(0, lying)
    assert front.size == pytest.approx((0.3, 0.2))
    assert top.size == pytest.approx((0.3, 0.4))
    assert front.cell_from_face.translation == pytest.approx((1.4, 0.0, 0.5))
    assert top.cell_from_face.translation == pytest.approx((1.6, 0.0, 0.6))


def test_a_block_of_boxes_shows_its_fronts_and_its_lids() -> None:
    """And nothing of what stands within."""
    truth = wall_of(3, 2, 2)
    seen = {(face.box, face.facing): face.visible for face in truth.faces}
    for box, true in enumerate(truth.boxes):
        x, _, z = true.shape.centre
        assert (seen[box, Facing.FRONT] > 0.99) == (x < 1.7)
        assert (seen[box, Facing.TOP] > 0.99) == (z > 0.4)
    assert {value for value in seen.values() if value < 0.99} == {0.0}


def test_what_one_camera_does_not_see_another_may() -> None:
    """A face counts with what all of them see together."""
    shapes = [
        OrientedBox.upright((1.6, 0.0, 0.5), SIZE),
        OrientedBox.upright((1.2, 0.1, 0.5), (0.05, 0.2, 1.0)),
    ]
    boxes = [TrueBox(shape, Gtin("1")) for shape in shapes]
    sides = [
        CameraMount("c", aimed((0.0, y, 0.5), (1.6, 0.0, 0.5)), (640, 480), (640, 480), 1.2)
        for y in (-0.9, 0.9)
    ]
    left, right, both = (truth_of(boxes, cameras).faces[0].visible for cameras in
                         (sides[:1], sides[1:], sides))  # fmt: skip
    assert min(left, right) > 0.1
    assert max(left, right) < both


@pytest.mark.parametrize(("angle", "seen"), [(60, 1.0), (68, 1.0), (72, 0.0), (85, 0.0)])
def test_a_face_that_is_seen_too_flatly_is_not_seen(angle: float, seen: float) -> None:
    """Seventy degrees from its normal."""
    turn = math.radians(angle)
    eye = (1.45 - 4 * math.cos(turn), 4 * math.sin(turn), 0.5)
    camera = CameraMount("c", aimed(eye, (1.45, 0.0, 0.5)), (640, 480), (640, 480), 1.0)
    box = TrueBox(OrientedBox.upright((1.6, 0.0, 0.5), (0.3, 0.1, 0.1)), Gtin("1"))
    assert truth_of([box], [camera]).faces[0].visible == seen


def test_what_lies_outside_the_picture_is_not_seen() -> None:
    """Nor what lies behind the camera."""
    box = TrueBox(OrientedBox.upright((1.6, 0.0, 0.5), SIZE), Gtin("1"))
    narrow = CameraMount("c", aimed((0.0, 0.0, 0.5), (1.45, 0.2, 0.5)), (480, 640), (480, 640), 0.3)
    behind = CameraMount("c", aimed((1.0, 0.0, 0.5), (0.0, 0.0, 0.5)), (480, 640), (480, 640), 1.0)
    half, none = (truth_of([box], [camera]).faces[0].visible for camera in (narrow, behind))
    assert 0.2 < half < 0.8
    assert none == 0.0
    assert truth_of([box], CAMERAS).faces[0].visible == 1.0
