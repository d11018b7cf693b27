"""A held box leaves a pile clear of all that unnamed neighbours may be, where there is a way."""

import math
from collections.abc import Callable
from dataclasses import replace
from unittest import mock

import numpy as np
import pytest
from cells_at_work import DECK, STORED, Cell, Remembering, note, note_of, pile
from hypothesis import given, settings
from hypothesis import strategies as st

from depal.cell.breadth import BESIDE, as_broad_as_it_may_be, room_beside
from depal.cell.planning.picking import RUBBING
from depal.cell.planning.planner import Planner
from depal.cell.planning.plans import Load, PickPlan
from depal.cell.planning.wary import with_room
from depal.domain import BoxId, Detection, Gtin, Recognition
from depal.geometry import OrientedBox, Pose
from depal.motion.collision import Scene
from depal.motion.grasping import in_a_row
from depal.motion.moves import OPEN, Berth, NoMotion, Put
from depal.ports import View

edge = st.floats(0.1, 0.5)


@given(st.tuples(edge, edge, edge), st.floats(-3, 3))
def test_the_room_beside_a_box_is_all_that_it_may_be_and_a_hand_more(
    size: tuple[float, float, float], yaw: float
) -> None:
    """No higher than it is seen; of one with a name it is the box."""
    shape = OrientedBox(Pose.from_yaw((1.8, 0.1, 0.5), yaw), size)
    box, named = Detection(BoxId("b"), shape), Recognition(BoxId("b"), shape, Gtin("g"))
    room, broad = (of(box, note(1)) for of in (room_beside, as_broad_as_it_may_be))
    assert np.allclose(np.subtract(room.size, broad.size), (2 * BESIDE, 2 * BESIDE, 0.0))
    assert room.pose == broad.pose
    assert room_beside(named, note(1)) == shape


@given(st.tuples(edge, edge, edge), st.tuples(*[st.floats(0.0, 0.2)] * 2))
def test_where_the_surface_goes_on_beside_a_box_its_room_does_too(
    size: tuple[float, float, float], far: tuple[float, float]
) -> None:
    """At either end: on which side the box is seen wrongly nobody knows (dev-021)."""
    box = Detection(BoxId("b"), OrientedBox.upright((1.8, 0.1, 0.5), size))
    room, plain = (
        room_beside(box, note(1), beside=beside) for beside in ((*far, 0.0), (0.0, 0.0, 0.0))
    )
    more = [max(each - BESIDE, 0.0) for each in far]
    assert np.allclose(np.subtract(room.size, plain.size), (*np.multiply(2, more), 0.0))


def lifted_beside(*, unnamed: bool) -> tuple[Cell, PickPlan]:
    """A low box with a name is taken from beside a higher one."""
    cell = Cell(1)
    low, seen, true = (0.29, 0.19, 0.18), (0.18, 0.25, 0.25), (0.21, 0.25, 0.27)
    cell.work.delivery = note_of(low, seen, true)
    box = Recognition(
        BoxId("b1"), OrientedBox.upright((1.6, 0.0, DECK + low[2] / 2), low), Gtin("g0")
    )
    where = OrientedBox.upright((1.8, -0.22, DECK + seen[2] / 2), seen)
    name = BoxId("b2")
    beside = Detection(name, where) if unnamed else Recognition(name, where, Gtin("g1"))
    cell.work.pile.see(View(0.0, (box, beside), remembered=True))
    plan = cell.desk.picking.try_pick(box)
    assert not isinstance(plan, str)
    return cell, plan


def test_a_box_is_lifted_clear_of_all_that_its_neighbour_may_be_before_it_goes_sideways() -> None:
    """The neighbour is larger and higher than it looks; the way on starts clear of it (dev-049)."""
    ends = []
    for unnamed in (False, True):
        cell, plan = lifted_beside(unnamed=unnamed)
        scene = with_room(BoxId("b1"), frozenset(), cell.work, cell.desk.promises)
        assert (scene is not None) is unnamed
        end = plan.pick.out.path[-1]
        if scene is not None:
            hand = cell.desk.planner.mover.checker(scene, OPEN, plan.grasp, plan.box.shape.size)
            assert hand.free(end)
        ends.append(cell.desk.planner.mover.body.kinematics.flange(end).translation[2])
    assert ends[1] > ends[0] + 0.015


def test_where_no_way_out_is_clear_of_all_that_it_may_be_a_box_goes_near() -> None:
    """It is taken all the same."""
    *_, plain = lifted_beside(unnamed=True)
    everything = OrientedBox.upright((1.6, 0.0, 1.0), (4.0, 4.0, 4.0))
    shut = mock.Mock(return_value=Scene.of([], [("all", everything)]))
    with mock.patch("depal.cell.planning.picking.with_room", shut):
        *_, near = lifted_beside(unnamed=True)
    *_, named = lifted_beside(unnamed=False)
    assert len(near.pick.out.path) == len(named.pick.out.path) < len(plain.pick.out.path)


@given(across=st.floats(0.08, 0.3), errs=st.booleans())
@settings(max_examples=15, deadline=None)
def test_what_hangs_on_one_row_of_cups_goes_slowly_out_of_a_pile_that_may_be_seen_wrongly(
    across: float, *, errs: bool
) -> None:
    """What rubs against it across the row peels it off (dev-040, dev-051)."""
    size, cell = (0.3, across, 0.2), Cell(1)
    cell.work.delivery = note_of(size)
    box = Recognition(BoxId("b1"), OrientedBox.upright((1.6, 0.0, DECK + 0.1), size), Gtin("g0"))
    cell.work.pile.see(View(0.0, (box,), remembered=errs))
    plan = cell.desk.picking.try_pick(box)
    assert not isinstance(plan, str)
    slowly = errs and in_a_row(plan.grasp, cell.work.layout.tool)
    assert plan.pick.out.most == (RUBBING if slowly else math.inf)


def puts_of(unknown: list[int], *, shut: int) -> tuple[Cell, list[Scene]]:
    """Two boxes are put away; the scenes of the first one, whose way is refused so often."""
    cell = Cell(2, unknown=unknown)
    cell.sight = Remembering([pile(2, unknown)])
    cell.work.ports = replace(cell.work.ports, sight=cell.sight)
    cell.reader.script = (("product-2",),) * 8
    scenes = list[Scene]()
    put: Callable[..., Put | NoMotion] = Planner.put

    def counted(planner: Planner, load: Load, berth: Berth, scene: Scene) -> Put | NoMotion:
        if load.box == "b1":
            scenes.append(scene)
            if len(scenes) <= shut:
                return NoMotion(("shut",))
        return put(planner, load, berth, scene)

    with mock.patch.object(Planner, "put", counted):
        cell.works().assert_whole()
    return cell, scenes


def size_in(scene: Scene, box: str) -> np.ndarray:
    """Of a solid of a scene along its own axes [m]."""
    return np.asarray(2 * scene.solids.half[scene.names.index(box)])


@pytest.mark.parametrize("shut", [0, 1])
def test_a_way_near_to_what_has_no_name_is_the_second_choice(shut: int) -> None:
    """It is taken where no other is found."""
    cell, scenes = puts_of([2], shut=shut)
    assert cell.fates["b1"] == STORED
    assert len(scenes) == 1 + shut
    wide = size_in(scenes[0], "b2")
    seen = pile(2, [2])[1].shape.size
    assert (wide[:2] >= np.array(seen[:2]) + 2 * BESIDE).all()
    if shut:
        assert size_in(scenes[1], "b2") == pytest.approx(seen)


def test_of_what_has_a_name_the_first_way_is_as_near_as_any() -> None:
    """Nothing more is kept clear."""
    _, scenes = puts_of([], shut=0)
    assert size_in(scenes[0], "b2") == pytest.approx(pile(2)[1].shape.size)
