"""A hand keeps clear of all that a box without a name may be."""

from dataclasses import replace
from unittest import mock

import numpy as np
import pytest
from cells_at_work import DECK, Cell, Remembering, note_of, pile
from hypothesis import given
from hypothesis import strategies as st

from depal.cell.breadth import NAMED, SIDEWAYS, as_broad_as_it_may_be, astray, named_astray
from depal.cell.identity import ALIKE as EITHER_WAY
from depal.cell.sight.naming import ALIKE
from depal.cell.sight.unexplained import ALONG
from depal.cell.workplace import Held, Workplace
from depal.domain import (
    BoxId,
    Detection,
    Gtin,
    Recognition,
)
from depal.geometry import OrientedBox, Pose, Vector3
from depal.motion.collision import Margins, Scene
from depal.ports import View

TOUCHING = Margins(arm=0.0, tool=0.0, held=0.0, pile=0.0, floor=0.0)

edge = st.floats(0.1, 0.5)
sizes = st.tuples(edge, edge, edge)
off = st.floats(-0.028, 0.028)
end = st.sampled_from((-1, 1))
shifts = st.tuples(*[st.floats(-0.005, 0.005)] * 2)


@given(sizes, st.tuples(off, off, off), st.floats(-3, 3), st.tuples(end, end))
def test_a_box_lies_in_the_room_that_it_may_take_whichever_end_was_seen_right(
    size: Vector3, errors: Vector3, yaw: float, ends: tuple[int, int]
) -> None:
    """It was taken for another product, turned either way, and stands as high as it does."""
    seen = (size[0] + errors[0], size[1] + errors[1], size[2] + errors[2])
    pose = Pose.from_yaw((1.8, 0.1, 0.5), yaw)
    room = as_broad_as_it_may_be(
        Detection(BoxId("b"), OrientedBox(pose, seen)), note_of(size, seen)
    )
    shift = [way * (a - b) / 2 for way, a, b in zip(ends, seen, size, strict=False)]
    shift = [*shift, (size[2] - seen[2]) / 2]
    true = OrientedBox(pose @ Pose((shift[0], shift[1], shift[2])), size)
    local = np.array([room.pose.inverse.apply(tuple(corner)) for corner in true.corners.tolist()])
    assert (np.abs(local) <= np.array(room.size) / 2 + 1e-9).all()


@given(sizes.filter(lambda size: max(size) > 0.13), st.floats(-3, 3))
def test_what_has_the_size_of_no_product_reaches_as_far_as_its_surroundings_count_as_its_own(
    odd: Vector3, yaw: float
) -> None:
    """Two boxes, one behind the other, may be seen as one that is less deep than both together."""
    shape = OrientedBox(Pose.from_yaw((1.8, 0.1, 0.5), yaw), odd)
    room = as_broad_as_it_may_be(Detection(BoxId("b"), shape), note_of((0.09, 0.09, 0.09)))
    assert min(np.subtract(room.size, odd)[:2]) >= 2 * ALONG
    assert top_of(room) == pytest.approx(top_of(shape) + ALONG)
    assert bottom_of(room) == pytest.approx(bottom_of(shape))
    assert as_broad_as_it_may_be(Detection(BoxId("b"), shape), note_of()).size < room.size


@given(sizes, st.floats(-3, 3))
def test_what_has_a_products_size_by_a_guess_reaches_as_far(size: Vector3, yaw: float) -> None:
    """An edge was not seen: three small boxes may be one that is larger (dev-024)."""
    box = Detection(BoxId("b"), OrientedBox(Pose.from_yaw((1.8, 0.1, 0.5), yaw), size))
    guessed, seen = (
        as_broad_as_it_may_be(box, note_of(size), unsized=is_so) for is_so in (True, False)
    )
    assert min(np.subtract(guessed.size, size)[:2]) >= 2 * ALONG
    assert (np.array(guessed.size) >= seen.size).all()
    assert guessed.size[2] == seen.size[2]


@given(edge, edge, st.floats(0.0, EITHER_WAY - 0.001), st.tuples(end, end))
def test_a_nearly_square_box_lies_in_its_room_turned_either_way(
    along: float, high: float, less: float, ends: tuple[int, int]
) -> None:
    """It is seen turned by a quarter; what is clearly longer than broad is not (dev-049)."""
    size, pose = (along, along - less, high), Pose.from_yaw((1.8, 0.1, 0.5), 0.3)
    seen = (along - less, along, high)
    room = as_broad_as_it_may_be(Detection(BoxId("b"), OrientedBox(pose, seen)), note_of(size))
    assert (np.array(room.size[:2]) >= along + 2 * SIDEWAYS - 1e-9).all()
    shift = [way * (a - b) / 2 for way, a, b in zip(ends, seen, size, strict=False)]
    true = OrientedBox(pose @ Pose((shift[0], shift[1], 0.0)), size)
    local = np.array([room.pose.inverse.apply(tuple(corner)) for corner in true.corners.tolist()])
    assert (np.abs(local) <= np.array(room.size) / 2 + 1e-9).all()
    long = (along + 0.2, along, high)
    room = as_broad_as_it_may_be(Detection(BoxId("b"), OrientedBox(pose, long)), note_of(long))
    assert room.size[1] == pytest.approx(along + 2 * SIDEWAYS)


@given(st.floats(0.1, 0.2), st.floats(0.26, 0.32), st.floats(0.4, 0.5))
def test_what_would_have_to_lie_on_its_side_has_the_size_of_no_product(
    low: float, middle: float, high: float
) -> None:
    """Boxes stand upright: what looks like one on its side was seen wrongly (dev-013)."""
    lying = Detection(BoxId("b"), OrientedBox.upright((1.8, 0.1, 0.5), (high, low, middle)))
    room = as_broad_as_it_may_be(lying, note_of((middle, low, high)))
    assert min(np.subtract(room.size, lying.shape.size)[:2]) >= 2 * ALONG
    assert top_of(room) == pytest.approx(top_of(lying.shape) + ALONG)


@given(sizes, st.tuples(off, off, off), st.floats(-3, 3))
def test_what_is_roughly_as_large_as_a_product_may_be_higher_than_it_looks(
    size: Vector3, errors: Vector3, yaw: float
) -> None:
    """What has its size is as high as it looks, or as that product is (dev-026, dev-037)."""
    seen = (size[0] + errors[0], size[1] + errors[1], size[2] + errors[2])
    shape = OrientedBox(Pose.from_yaw((1.8, 0.1, 0.5), yaw), seen)
    room = as_broad_as_it_may_be(Detection(BoxId("b"), shape), note_of(size))
    turned = (size[1], size[0], size[2])
    off_by = min(np.abs(np.subtract(way, seen)).max() for way in (size, turned))
    assert bottom_of(room) == pytest.approx(bottom_of(shape))
    higher = max(size[2] - seen[2], ALONG if off_by > ALIKE else 0.0)
    assert top_of(room) == pytest.approx(top_of(shape) + higher)


def top_of(shape: OrientedBox) -> float:
    """Of an upright box [m]."""
    return shape.centre[2] + shape.size[2] / 2


def bottom_of(shape: OrientedBox) -> float:
    """Of an upright box [m]."""
    return shape.centre[2] - shape.size[2] / 2


@given(sizes, st.floats(-3, 3), st.floats(0.004, 0.05), end, shifts)
def test_a_named_box_that_seems_askew_lies_in_its_room_if_it_stands_square(
    size: Vector3, yaw: float, skew: float, side: int, errors: tuple[float, float]
) -> None:
    """Its middle seen less than a centimetre off; one that is seen square is where it seems."""
    pallet = Pose.from_yaw((1.8, 0.1, 0.5), yaw)
    more = named_astray(OrientedBox(pallet @ Pose.from_yaw((0, 0, 0), side * skew), size), pallet)
    seen = OrientedBox(
        Pose.from_yaw((0, 0, 0), side * skew), (size[0] + 2 * more[0], size[1] + 2 * more[1], 1.0)
    )
    true = OrientedBox(Pose((*errors, 0.0)), size).corners.tolist()
    local = np.array([seen.pose.inverse.apply(tuple(corner)) for corner in true])
    assert (np.abs(local[:, :2]) <= np.array(seen.size)[:2] / 2 + 1e-9).all()
    assert named_astray(OrientedBox(pallet, size), pallet) == (NAMED, NAMED, 0.0)


@given(sizes)
def test_a_named_box_that_was_tried_in_vain_may_lie_the_other_way(size: Vector3) -> None:
    """About the same middle, turned by a quarter."""
    more = named_astray(OrientedBox(Pose(), size), Pose(), tried=True)
    for k in (0, 1):
        assert size[k] + 2 * more[k] == pytest.approx(max(*size[:2], size[k] + 2 * NAMED))
    assert more[2] == 0.0


def test_what_bears_a_name_and_was_tried_in_vain_is_carried_as_if_it_lay_the_other_way() -> None:
    """Two boxes in a row are believed one that is turned, with the name that one of them bears."""
    cell = Cell(1)
    cell.gripper.breaks = {0: 0.5}
    cell.sight = Remembering([pile(1)])
    cell.work.ports = replace(cell.work.ports, sight=cell.sight)
    lifted, beyond = Workplace.lifted, list[Vector3]()

    def lifting(work: Workplace, held: Held) -> None:
        beyond.append(held.beyond)
        lifted(work, held)

    with mock.patch.object(Workplace, "lifted", lifting):
        cell.works().assert_whole()
    assert beyond == [named_astray(pile(1)[0].shape, Pose(), tried=True)]


@given(sizes)
def test_a_name_tells_how_broad_a_box_is(size: Vector3) -> None:
    """What goes by a name is as it looks."""
    box = Recognition(BoxId("b"), OrientedBox.upright((1.8, 0.0, 0.5), size), Gtin("g0"))
    assert as_broad_as_it_may_be(box, note_of(size)) == box.shape


@pytest.mark.parametrize("side", [-1, 1])
def test_a_tool_keeps_clear_of_what_a_higher_neighbour_may_be(side: int) -> None:
    """By its looks alone it would hit it."""
    cell = Cell(1)
    low, high, broad = (0.25, 0.18, 0.19), (0.25, 0.28, 0.22), (0.25, 0.3, 0.22)
    lying = OrientedBox.upright((1.5, 0.0, DECK + low[2] / 2), low)
    beside = OrientedBox.upright((1.5, side * 0.255, DECK + high[2] / 2), high)
    true = OrientedBox.upright((1.5, side * 0.245, DECK + high[2] / 2), broad)
    box = Recognition(BoxId("b1"), lying, Gtin("g0"))
    cell.work.delivery = note_of(low, high, broad)
    hits = []
    for remembered in (False, True):
        seen = (box, Detection(BoxId("b2"), beside))
        cell.work.pile.see(View(0.0, seen, remembered=remembered))
        plan = cell.desk.picking.try_pick(box)
        assert not isinstance(plan, str)
        scene = Scene.of([], [("b2", true)])
        tool = cell.desk.planner.mover.checker(scene, TOUCHING, folded=plan.grasp.folded)
        hits.append(tool.first_hit(plan.pick.approach[-1].path) is not None)
    assert hits == [True, False]


@given(st.tuples(*[st.floats(0.0, 0.2)] * 3), st.tuples(*[st.floats(-SIDEWAYS, SIDEWAYS)] * 2))
def test_a_box_that_is_off_to_the_side_lies_within_its_room(
    beyond: Vector3, off: tuple[float, float]
) -> None:
    """However well its size is known; no higher."""
    room = astray(beyond)
    assert (np.array(room) >= beyond).all()
    assert (np.abs(off) <= room[:2]).all()
    assert room[2] == beyond[2]
