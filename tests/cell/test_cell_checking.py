"""Whether things stand apart, what cameras see, and what a delivery asks that a cell cannot do."""

import dataclasses

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from depal.cell.checking.delivery import check_delivery_against_cell, fits
from depal.cell.checking.findings import Weight
from depal.cell.checking.posture import link_poses, posture
from depal.cell.checking.sight import check_sight
from depal.cell.checking.standing import check_standing
from depal.cell.files import SHIPPED, cell_of_yaml, shipped_cell, shipped_text
from depal.domain import CellLayout, Delivery, DeliveryLine, Gtin, Product
from depal.geometry import OrientedBox, Pose
from depal.logistics import shipped_deliveries

CELL = shipped_cell()
Point = tuple[float, float, float]


def edited(old: str, new: str) -> CellLayout:
    """The default cell with one passage of its file replaced."""
    text = shipped_text("default")
    assert old in text
    return cell_of_yaml(text.replace(old, new), "")


def by_one_camera(layout: CellLayout) -> CellLayout:
    """The cell with the first of its cameras alone."""
    return dataclasses.replace(layout, cameras=layout.cameras[:1])


def a_delivery(size: Point, mass: float = 5.0, pallet: Point = (1.2, 0.8, 0.144)) -> Delivery:
    """One case on a pallet, without a stack."""
    product = Product(Gtin("12000823098180"), "tea", size, mass)
    return Delivery("d", pallet, (DeliveryLine(product, 1),))


@pytest.mark.parametrize("name", SHIPPED)
def test_shipped_cells_stand_well(name: str) -> None:
    """Nothing overlaps, nothing is outside of the fence, every opening faces the robot."""
    assert list(check_standing(shipped_cell(name))) == []


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ("front: [0.00, 1.70]", "front: [0.10, 1.70]", "trolley_1: overlaps trolley_2 by 0.070 m"),
        ("front: [-1.70, 0.0]", "front: [-0.30, 0.0]", "robot: overlaps shelf"),
        ("front: [1.4, 0.0]", "front: [0.5, 1.3]", "pallet: overlaps trolley_1 by 0.200 m"),
        ("front: [1.4, 0.0]", "front: [1.8, 0.0]", "pallet: stands 0.100 m outside the floor"),
        ("centre: [1.26, -1.26, 0.44]", "centre: [1.5, -0.4, 0.44]", "pallet: overlaps fixture 3"),
        (
            "front: [-1.70, 0.0], turn: 180",
            "front: [-2.40, 0.0], turn: 0",
            "shelf: its opening does not face the robot",
        ),
    ],
)
def test_what_stands_in_something_else_is_named(old: str, new: str, said: str) -> None:
    """Both of them, and how deep."""
    findings = [finding.problem for finding in check_standing(edited(old, new))]
    assert any(str(problem).startswith(said) for problem in findings)


@pytest.mark.parametrize("name", SHIPPED)
def test_shipped_cameras_see_every_front_face_up_to_the_highest_load(name: str) -> None:
    """With the arm parked."""
    assert check_sight(shipped_cell(name))[-1].seen == 1.0


def test_a_camera_that_looks_away_sees_nothing_and_says_why() -> None:
    """The edge of its picture is before the pallet."""
    layout = edited("look_at: [1.40, 0.0, 0.92]", "look_at: [-2.0, 0.0, 0.92]")
    (sight,) = check_sight(by_one_camera(layout))
    assert sight.seen == 0
    assert sight.hidden_by[0] == ("the picture's edge", 1.0)


def test_a_wall_before_the_camera_hides_what_is_behind_it() -> None:
    """Of the lower half of the front, here."""
    wall = OrientedBox(Pose((1.2, 0.0, 0.25)), (0.02, 2.0, 0.5))
    (sight,) = check_sight(dataclasses.replace(by_one_camera(CELL), fixtures=(wall,)))
    assert 0.2 < 1 - sight.seen < 0.4
    assert sight.hidden_by == (("fixture 1", pytest.approx(1 - sight.seen)),)
    assert sight.bands[0][2] < sight.bands[-1][2] == 1.0


def test_an_arm_before_the_camera_is_named() -> None:
    """When it is parked in the view."""
    robot = dataclasses.replace(CELL.robot, parked=(0.2, -1.6, 1.9, 0.0, 1.0, 0.0))
    (sight,) = check_sight(dataclasses.replace(by_one_camera(CELL), robot=robot))
    assert [name for name, _ in sight.hidden_by] == ["the parked arm"]


def test_two_cameras_see_together_what_neither_sees_alone() -> None:
    """The last sight is all of them."""
    camera = CELL.cameras[0]
    narrow = dataclasses.replace(camera, vertical_view=0.8)
    low = dataclasses.replace(narrow, name="low")
    pose = Pose(
        (camera.cell_from_camera.translation[0], 0.75, 0.6), camera.cell_from_camera.rotation
    )
    other = dataclasses.replace(narrow, name="other", cell_from_camera=pose)
    sights = check_sight(dataclasses.replace(CELL, cameras=(low, other)))
    assert [sight.camera for sight in sights] == ["low", "other", "all"]
    assert sights[2].seen >= max(sights[0].seen, sights[1].seen)


def test_with_all_axes_at_zero_both_arms_point_forward() -> None:
    """As the geometry is defined, and the flange ends them."""
    links, flange = link_poses(CELL.robot, (0.0,) * 6)
    assert flange.translation == pytest.approx((0.35 + 0.85 + 0.82 + 0.17, 0.0, 0.15 + 0.96))
    assert links[2].translation == pytest.approx((0.35, 0.0, 0.965))


@given(st.tuples(*[st.floats(-2, 2)] * 6))
def test_capsules_are_as_long_in_every_posture(angles: tuple[float, ...]) -> None:
    """Links are rigid, and joined at their axes."""
    angles6 = (angles[0], angles[1], angles[2], angles[3], angles[4], angles[5])
    arm = posture(CELL.robot, CELL.tool, angles6)
    lengths = np.linalg.norm(arm.ends - arm.starts, axis=1)
    own = [np.linalg.norm(np.subtract(s.end, s.start)) for s in CELL.robot.shapes]
    assert lengths == pytest.approx(own)
    bones = np.linalg.norm(np.diff(arm.joints, axis=0), axis=1)
    assert bones == pytest.approx([0, np.hypot(0.35, 0.965), 0.85, 0.145, 0.82, 0, 0.17])


@pytest.mark.parametrize("name", SHIPPED)
def test_a_real_delivery_can_be_taken_by_every_shipped_cell(name: str) -> None:
    """As far as its note tells."""
    for delivery in shipped_deliveries()[::4]:
        assert check_delivery_against_cell(shipped_cell(name), delivery) == ()


@pytest.mark.parametrize(
    ("delivery", "said"),
    [
        (
            a_delivery((0.3, 0.2, 0.2), pallet=(1.0, 1.2, 0.16)),
            (
                "pallet: the delivery comes on a pallet of 1 x 1.2 x 0.16 m; "
                "expected 1.2 x 0.8 x 0.144 m, which default takes"
            ),
        ),
        (
            a_delivery((0.4, 0.3, 0.3), 45.0),
            (
                "'12000823098180' tea: cannot be held: "
                "45 kg is more than the arm carries beside its tool (42 kg)"
            ),
        ),
        (
            a_delivery((0.8, 0.8, 0.8)),
            (
                "'12000823098180' tea: 0.8 x 0.8 x 0.8 m fits no opening; "
                "the largest is shelf/level_1: 1.74 x 0.8, 0.67 m deep"
            ),
        ),
        (
            a_delivery((0.5, 0.06, 0.06), 1.0),
            (
                "'12000823098180' tea: cannot be held: "
                "no side is wide enough for a cup of 70 mm with its rim"
            ),
        ),
        (
            a_delivery((0.15, 0.1, 0.1), 12.0),
            (
                "'12000823098180' tea: cannot be held: "
                "12 kg is more than the cups hold on its sides with safety 2"
            ),
        ),
    ],
)
def test_what_a_cell_cannot_take_is_said_before_anything_moves(
    delivery: Delivery, said: str
) -> None:
    """One error, which names the product."""
    (finding,) = check_delivery_against_cell(CELL, delivery)
    assert finding.weight is Weight.ERROR
    assert str(finding) == f"error: {said}"
    assert finding.gtin == ("" if said.startswith("pallet") else "12000823098180")


@given(st.tuples(*[st.floats(0.05, 0.9)] * 3), st.floats(0.0, 0.1))
def test_a_smaller_box_fits_where_a_larger_one_does(size: Point, less: float) -> None:
    """In every place."""
    smaller = (size[0] - less / 3, size[1] - less / 3, size[2] - less / 3)
    for place in CELL.places.values():
        assert fits(place, smaller) or not fits(place, size)
