"""What a cell reaches: the shipped ones, and ones that cannot work."""

import dataclasses
import math

import pytest

from depal.cell.checking import (
    BoxSize,
    CellReport,
    Weight,
    check_cell,
    check_delivery_against_cell,
    sizes_of,
)
from depal.cell.checking.mover import Mover, Task
from depal.cell.files import SHIPPED, cell_of_yaml, shipped_cell, shipped_text
from depal.domain import Approach, CellLayout, Delivery
from depal.errors import CellError
from depal.geometry import OrientedBox, Pose
from depal.logistics import shipped_deliveries

MEDIAN = BoxSize("median", (0.25, 0.29, 0.23), 5.4)
TURN = ((0.0, -1.0, 0.0), (1.0, 0.0, 0.0), (0.0, 0.0, 1.0))


def edited(*changes: tuple[str, str]) -> CellLayout:
    """The default cell with passages of its file replaced."""
    text = shipped_text("default")
    for old, new in changes:
        assert old in text
        text = text.replace(old, new)
    return cell_of_yaml(text, "")


def errors(report: CellReport) -> list[str]:
    """What keeps a cell from its work."""
    return [str(one.problem) for one in report.findings if one.weight is Weight.ERROR]


@pytest.mark.parametrize("name", SHIPPED)
@pytest.mark.slow
def test_a_shipped_cell_does_its_work(name: str) -> None:
    """Every place is reached by every box, the pallet nearly whole, its whole front is in view."""
    report = check_cell(shipped_cell(name))
    assert report.holds
    assert errors(report) == []
    assert min(report.reached.values()) >= 0.5
    for reach in report.pallet:
        assert reach.either >= max(reach.horizontal, reach.vertical)
        assert reach.usual >= (0.90 if reach.size.name == "small" else 0.99)
    assert report.sights[-1].seen == 1.0
    assert all(reach.sides for reach in report.reader)


def taken(mover: Mover, layout: CellLayout, delivery: Delivery) -> list[bool]:
    """Which cases of a stack the arm takes from where they stand, nothing beside them."""
    out = layout.pallet.cell_from_pallet
    front = (-out.rotation[0][1], -out.rotation[1][1])
    results = []
    for case in delivery.stack or ():
        across, depth, height = case.size
        load = BoxSize("case", (depth, across, height), delivery.products[case.gtin].mass)
        pose = out @ Pose(case.in_pallet.centre, TURN)
        lift, forth = (0.0, 0.0, 0.03), depth + 0.02
        moves = (lift, (front[0] * forth, front[1] * forth, 0.0))
        task = Task(OrientedBox(pose, load.size), load, (), moves)
        results.append(any(mover.can(task, approach) for approach in Approach))
    return results


@pytest.mark.parametrize("name", SHIPPED)
@pytest.mark.slow
def test_cases_of_real_deliveries_are_reached_where_they_stand(name: str) -> None:
    """At least 99 of 100, by one of the two grasps."""
    layout = shipped_cell(name)
    mover = Mover(layout)
    results = [
        one for delivery in shipped_deliveries()[::3] for one in taken(mover, layout, delivery)
    ]
    assert sum(results) >= 0.99 * len(results)


def test_a_pallet_that_is_too_far_away_is_an_error() -> None:
    """And so is what its front does to the camera's view."""
    layout = edited(
        ("front: [1.4, 0.0]", "front: [2.6, 0.0]"), ("upper: [2.5, 2.5]", "upper: [4.0, 2.5]")
    )
    report = check_cell(layout, [MEDIAN])
    assert not report.holds
    assert errors(report)[0].startswith("pallet: only 0.0 % of it is reached with a median box")


def test_a_place_that_cannot_be_reached_is_an_error_and_named() -> None:
    """The others are not."""
    layout = edited(
        (
            "name: trolley_2, model: trolley, front: [0.00, 1.70]",
            "name: far, model: trolley, front: [0.00, 3.2]",
        ),
        ("upper: [2.5, 2.5]", "upper: [2.5, 4.0]"),
    )
    report = check_cell(layout, [MEDIAN])
    expected = "cannot be reached; expected a place where the arm can set a box down"
    assert errors(report) == [f"far/level_{level}: {expected}" for level in (1, 2)]
    assert report.reached["far/level_1"] == 0.0 < report.reached["trolley_1/level_1"]


def test_a_reader_out_of_reach_is_an_error() -> None:
    """Behind a trolley, for instance."""
    layout = edited(("at: [1.20, -1.20, 0.95]", "at: [2.3, -2.3, 0.2]"))
    assert errors(check_cell(layout, [MEDIAN])) == [
        "reader: no held box can be shown to it; expected a reader within reach"
    ]


def test_a_camera_that_looks_away_is_an_error() -> None:
    """Its view of the pallet's front is said."""
    layout = edited(("look_at: [1.40, 0.0, 0.92]", "look_at: [-2.0, 0.0, 0.92]"))
    layout = dataclasses.replace(layout, cameras=layout.cameras[:1])
    assert errors(check_cell(layout, [MEDIAN])) == [
        (
            "camera: 0 % of the pallet's front is in view; expected all of it up to 1.75 m, "
            "with the arm parked; before the rest: the picture's edge (100 %)"
        )
    ]


def test_an_arm_that_is_parked_in_something_is_an_error() -> None:
    """Here the floor."""
    robot = shipped_cell().robot
    low = dataclasses.replace(robot, parked=(0.0, 0.5, 0.9, 0.0, 0.3, 0.0))
    report = check_cell(dataclasses.replace(shipped_cell(), robot=low), [MEDIAN])
    assert "robot.parked: the parked arm touches something" in errors(report)[0]


def test_a_box_that_fits_nowhere_is_a_warning_at_every_place() -> None:
    """The cell may be meant for smaller ones."""
    report = check_cell(shipped_cell("small_trolleys"), [BoxSize("huge", (0.6, 0.6, 0.9), 9.0)])
    said = [str(one) for one in report.findings]
    line = "warning: trolley_1/level_1: none of the boxes fits into it; expected a larger opening"
    assert line in said
    assert report.reached["trolley_1/level_1"] == 0.0


def test_an_arm_whose_forearm_is_offset_is_refused() -> None:
    """Its kinematics have no closed form here."""
    with pytest.raises(CellError, match="no sideways offset"):
        check_cell(edited(("b: 0.0", "b: 0.05")), [MEDIAN])


def test_sizes_of_a_delivery_are_its_own_products() -> None:
    """From the smallest to the largest."""
    delivery = shipped_deliveries()[0]
    sizes = sizes_of(delivery)
    assert [one.name for one in sizes] == ["smallest", "median", "largest"]
    volumes = [math.prod(one.size) for one in sizes]
    assert volumes == sorted(volumes)
    own = {tuple(sorted(line.product.size)) for line in delivery.lines}
    assert {tuple(sorted(one.size)) for one in sizes} <= own
    assert check_delivery_against_cell(shipped_cell(), delivery) == ()
