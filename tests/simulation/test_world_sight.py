"""The sight from the truth tells what a camera could see, a little off, and no more."""

from dataclasses import replace

import numpy as np
import pytest
from simulated_layouts import delivery, layout, trolley

from depal.domain import Delivery, Recognition
from depal.executive.clock import LoopClock, run_simulated
from depal.geometry import Pose
from depal.logistics import shipped_deliveries
from depal.ports import View
from depal.simulation import SimulatedCell, build

CELL = layout()
CUBE = (0.3, 0.3, 0.3)


def a_real_delivery() -> Delivery:
    """One that ships."""
    return shipped_deliveries()[4]


def seen(cell: SimulatedCell) -> set[str]:
    """The names of the boxes that one look finds."""
    return {str(box.id) for box in cell.sight.perceived(0)}


def test_a_box_behind_others_is_not_seen_until_they_are_gone() -> None:
    """The camera looks along x; a taller wall hides the second row."""
    wall = ((0.15, 0.0, 0.0), (0.9, 0.3, 0.8), 9.0)
    hidden = ((0.5, 0.45, 0.0), (0.2, 0.2, 0.2), 2.0)
    cell = build(CELL, delivery(wall, hidden))
    assert seen(cell) == {"b1"}
    cell.world.place_box(0, Pose((40.0, 0.0, 0.4)))
    assert seen(cell) == {"b2"}


def test_a_box_of_which_a_sliver_is_visible_is_not_seen() -> None:
    """Less than a fifth of its front, and its top from below."""
    wall = ((0.15, 0.0, 0.0), (0.9, 0.3, 1.3), 9.0)
    for above, expected in ((0.02, {"b1"}), (0.5, {"b1", "b2"})):
        behind = ((0.4, 0.301, 0.0), (0.4, 0.4, 1.3 + above), 9.0)
        assert seen(build(CELL, delivery(wall, behind))) == expected


def test_only_boxes_on_the_pallet_are_told() -> None:
    """Not those on the floor, in a trolley, in the hand."""
    cell = build(CELL, delivery(((0.4, 0.2, 0.0), CUBE, 5.0), ((0.8, 0.2, 0.0), CUBE, 5.0)))
    cell.world.place_box(0, Pose((1.1, -1.0, 0.15)))
    assert seen(cell) == {"b2"}


def test_the_arm_hides_what_is_behind_it() -> None:
    """A parked arm hides little; one in the line of sight hides its box."""
    cell = build(CELL, delivery(((0.5, 0.2, 0.4), (0.1, 0.1, 0.1), 5.0)))
    cell.world.model.mj.opt.gravity[2] = 0.0
    cell.world.place_box(0, Pose((1.6, 0.3, 1.55)))
    assert seen(cell) == {"b1"}
    cell.world.data.qpos[:6] = (0.0, -0.7, 0.7, 0.0, 0.0, 0.0)
    cell.world.refresh()
    assert seen(cell) == set()


def test_what_lies_outside_the_picture_is_not_seen() -> None:
    """A camera that looks up from the same mast sees none of it."""
    up = Pose((0.2, -0.5, 1.3), ((0, -1, 0), (-1, 0, 0), (0, 0, 1)))
    blind = replace(CELL, cameras=(replace(CELL.cameras[0], cell_from_camera=up),))
    note = delivery(((0.4, 0.2, 0.0), CUBE, 5.0))
    assert seen(build(CELL, note)) == {"b1"}
    assert seen(build(blind, note)) == set()


def test_a_trolley_hides_what_is_behind_it_while_it_is_there() -> None:
    """Here it stands before the pallet."""
    before = trolley("trolley_1", 0.0, 1.0)
    turned = replace(before, cell_from_storage=Pose((0.6, 0.0, 0.0)))
    cell = build(
        replace(CELL, storages=(turned, CELL.storages[1])), delivery(((0.4, 0.2, 0.0), CUBE, 5.0))
    )
    assert seen(cell) == set()
    cell.world.show_storage("trolley_1", trolley=None)
    assert seen(cell) == {"b1"}


def test_errors_are_small_without_bias_and_new_in_every_look() -> None:
    """3 mm and 0.3 degrees, never beyond 2.5 sigmas; sizes are true."""
    cell = build(CELL, delivery(((0.4, 0.2, 0.0), CUBE, 5.0)))
    truth = cell.world.box(0)
    shifts, turns = [], []
    for number in range(400):
        (box,) = cell.sight.perceived(number)
        assert box.shape.size == CUBE
        shifts.append(np.subtract(box.shape.centre, truth.translation))
        relative = np.array(box.shape.pose.rotation) @ np.array(truth.rotation).T
        turns.append(np.arctan2(relative[1, 0], relative[0, 0]))
    assert np.abs(shifts).max() <= 0.0075
    assert np.degrees(np.abs(turns).max()) <= 0.75
    assert np.std(shifts, axis=0) == pytest.approx([0.0028] * 3, rel=0.15)
    assert np.degrees(np.std(turns)) == pytest.approx(0.28, rel=0.15)
    assert np.abs(np.mean(shifts, axis=0)).max() < 0.0006


def test_a_look_is_charged_and_later_looks_are_cheaper() -> None:
    """0.5 s of exposure, then 1.2 s, later 0.5 s; the picture is from the exposure's end."""

    async def work() -> list[tuple[float, View]]:
        cell = build(CELL, delivery(((0.4, 0.2, 0.0), CUBE, 5.0)))
        return [(LoopClock().now(), await cell.sight.look()) for _ in range(3)]

    (_, first), (second_at, second), (third_at, third) = run_simulated(work())
    assert first.taken == pytest.approx(0.5)
    assert second_at == pytest.approx(1.7)
    assert second.taken == pytest.approx(2.2)
    assert third_at == pytest.approx(2.7)
    assert third.boxes != second.boxes


def test_names_and_recognition_stay_from_look_to_look() -> None:
    """About a tenth of many boxes is never recognised."""
    unknown = total = 0
    for seed in range(8):
        cell = build(CELL, a_real_delivery(), seed)
        first, second = cell.sight.perceived(0), cell.sight.perceived(1)
        assert [(b.id, type(b)) for b in first] == [(b.id, type(b)) for b in second]
        unknown += sum(not isinstance(box, Recognition) for box in first)
        total += len(first)
    assert 0 < unknown < total / 5


def test_the_same_seed_sees_the_same() -> None:
    """To the bit; another seed does not."""
    views = [build(CELL, a_real_delivery(), seed).sight.perceived(2) for seed in (1, 1, 2)]
    assert views[0] == views[1] != views[2]
