"""A held box leaves a pile clear of all that unnamed neighbours may be, where there is a way."""

from collections.abc import Callable
from dataclasses import replace
from unittest import mock

import numpy as np
import pytest
from cells_at_work import STORED, Cell, Remembering, note, pile
from hypothesis import given
from hypothesis import strategies as st

from depal.cell.breadth import BESIDE, as_broad_as_it_may_be, room_beside
from depal.cell.planning.planner import Planner
from depal.cell.planning.plans import Load
from depal.domain import BoxId, Detection, Gtin, Recognition
from depal.geometry import OrientedBox, Pose
from depal.motion.collision import Scene
from depal.motion.moves import Berth, NoMotion, Put

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
