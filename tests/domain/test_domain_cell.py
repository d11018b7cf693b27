"""The parts of a cell as values: arm, tool, grasp, layout, and how cups hold."""

import math

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from depal.domain import (
    FRONT,
    LOWER,
    Approach,
    ArmGeometry,
    CameraMount,
    CellLayout,
    Grasp,
    JointLimits,
    PalletStand,
    Place,
    PlaceId,
    ReaderMount,
    Robot,
    SpeedLimits,
    Storage,
    StorageKind,
    Suction,
    SuctionModule,
    Tool,
)
from depal.domain.cup_group import Break, CupGroup
from depal.geometry import Pose

ZERO = (0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
SUCTION = Suction(0.03, 30_000.0, 0.5, 0.01, 5000.0, 0.25, 0.2)
CUPS = tuple((y, z) for z in (-0.05, 0.05) for y in (-0.1, 0.0, 0.1))


def tool() -> Tool:
    """An L of two modules."""
    front = SuctionModule(FRONT, Pose((0.2, 0.0, 0.0)), (0.3, 0.2), CUPS)
    lower = SuctionModule(LOWER, Pose((0.1, 0.0, -0.2)), (0.3, 0.2), CUPS)
    folded = SuctionModule(LOWER, Pose((0.2, 0.0, -0.2)), (0.3, 0.2), CUPS)
    return Tool(18.0, (0.1, 0.0, 0.0), SUCTION, (front, lower), folded, (), (), 2.0, 0.6)


def layout() -> CellLayout:
    """Two storages."""

    def storage(name: str, kind: StorageKind) -> Storage:
        places = tuple(
            Place(PlaceId(f"{name}/level_{level}"), Pose(), (0.7, 0.5), 0.6) for level in (1, 2)
        )
        return Storage(name, kind, Pose(), (0.8, 0.7, 1.8), (), places)

    robot = Robot(
        "arm",
        ArmGeometry(0.35, -0.145, 0.0, 0.815, 0.85, 0.82, 0.17),
        JointLimits(ZERO, ZERO, ZERO, ZERO),
        60.0,
        (1.0,) * 7,
        (),
        ZERO,
    )
    return CellLayout(
        "cell",
        ((-2.5, -2.5), (2.5, 2.5)),
        robot,
        tool(),
        PalletStand(Pose(), (1.2, 0.8, 0.144)),
        (storage("trolley_1", StorageKind.TROLLEY), storage("shelf", StorageKind.SHELF)),
        "shelf",
        (CameraMount("front", Pose(), (1080, 1920), (720, 1280), 1.2),),
        ReaderMount(Pose(), 0.35, (0.3, 0.2), (1280, 854)),
        SpeedLimits(2.5, 0.5, 0.03),
    )


def test_the_joint_origins_of_a_stretched_arm_add_up_to_its_length() -> None:
    """CELL.md's KR 60-3 with all axes at zero."""
    origins = layout().robot.geometry.joint_origins
    assert np.sum(origins, axis=0) == pytest.approx((0.35 + 0.85 + 0.82 + 0.17, 0.0, 0.96))


def test_a_cup_pulls_by_area_times_vacuum() -> None:
    """Six of them pull about 500 N."""
    assert SUCTION.cup_force == pytest.approx(math.pi * 0.03**2 * 30_000.0)
    assert 6 * SUCTION.cup_force == pytest.approx(509, abs=1)


def test_the_lower_module_is_elsewhere_when_it_is_folded_up() -> None:
    """The front one is not."""
    both = tool()
    assert both.module(FRONT, folded=True) is both.module(FRONT)
    assert both.module(LOWER).flange_from_face.translation == (0.1, 0.0, -0.2)
    assert both.module(LOWER, folded=True).flange_from_face.translation == (0.2, 0.0, -0.2)


def test_a_grasp_seen_from_the_flange_is_its_inverse() -> None:
    """Either carries the box's origin onto the other's."""
    grasp = Grasp(Approach.VERTICAL, folded=False, box_from_flange=Pose((0.1, 0.2, 0.3)), cups=())
    assert grasp.flange_from_box.translation == (-0.1, -0.2, -0.3)


def test_places_and_storages_are_found_by_name() -> None:
    """A storage by its own name, or by that of one of its places."""
    cell = layout()
    assert list(cell.places) == [
        "trolley_1/level_1", "trolley_1/level_2", "shelf/level_1", "shelf/level_2",
    ]  # fmt: skip
    assert cell.storage("shelf").kind is StorageKind.SHELF
    assert cell.storage("trolley_1/level_2").id == "trolley_1"


def test_each_limit_of_a_group_of_cups_breaks_where_statics_say() -> None:
    """Pull by the vacuum, shear by friction, peel by the lever to the outline of the lips."""
    group, pull = CupGroup.of(np.array(CUPS), 0.03, 0.5), 600.0
    none = np.zeros(3)
    assert group.load_share(np.array([300.0, 0.0, 0.0]), none, pull) == (0.5, Break.PULL)
    assert group.load_share(np.array([700.0, 0.0, 0.0]), none, pull)[1] is Break.PULL
    assert group.load_share(np.array([1.0, 0.0, 0.0]), none, 0.0) == (math.inf, Break.PULL)
    share, why = group.load_share(np.array([0.0, 150.0, 0.0]), none, pull)
    assert (share, why) == (pytest.approx(0.5), Break.SHEAR)
    share, why = group.load_share(none, np.array([0.0, 0.08 * pull, 0.0]), pull)
    assert (share, why) == (pytest.approx(1.0), Break.PEEL)  # the lips reach 0.05 + 0.03 m


@given(
    st.tuples(*[st.floats(-300, 300)] * 3),
    st.tuples(*[st.floats(-30, 30)] * 3),
    st.floats(100, 1000),
)
def test_more_vacuum_never_holds_less(
    force: tuple[float, float, float], moment: tuple[float, float, float], pull: float
) -> None:
    """Whatever the load, as long as the cups are not pulled off straight."""
    assume(force[0] < pull)
    group = CupGroup.of(np.array(CUPS), 0.03, 0.5)
    weak, _ = group.load_share(np.array(force), np.array(moment), pull)
    strong, _ = group.load_share(np.array(force), np.array(moment), 1.1 * pull)
    assert strong <= weak + 1e-9
