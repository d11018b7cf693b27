"""A box that is seen across the seam between two is left to a person, if no look explains it."""

from dataclasses import replace

import numpy as np
import pytest
from cells_at_work import STORED, Cell, Remembering, pile
from hypothesis import assume, given
from hypothesis import strategies as st

from depal.cell.choosing import STRADDLES
from depal.cell.departures import Fate
from depal.cell.straddling import BESIDE, FARTHER, HALF, LEVEL, MOST, STACKED, goes_on_beside
from depal.geometry import OrientedBox, Pose, Vector3
from depal.ports import View

SIZE = (0.25, 0.28, 0.22)
POSE = Pose.from_yaw((1.6, 0.1, 0.5), 0.7)
BOX = OrientedBox(POSE, SIZE)

far = st.floats(FARTHER + 0.001, 0.3)
near = st.floats(-0.05, BESIDE - 0.001)
flush = st.floats(-LEVEL + 0.001, LEVEL - 0.001)
axes = st.sampled_from((0, 1))
sides = st.sampled_from((-1, 1))


def strip(
    axis: int, side: int, gap: float, far: float, *, above: float = 0.0, along: float = 1.0
) -> OrientedBox:
    """From `gap` to `far` beyond one side of the box, along so much of it, as high as it."""
    middle, size = np.zeros(3), np.array((*SIZE[:2], 0.05))
    middle[axis] = side * (SIZE[axis] / 2 + (gap + far) / 2)
    size[axis] = far - gap
    size[1 - axis] *= along
    middle[2] = SIZE[2] / 2 + above - 0.025
    return OrientedBox(POSE @ Pose(tuple(middle.tolist())), tuple(size.tolist()))


@given(axes, sides, near, far, flush)
def test_a_surface_as_high_as_a_box_beside_it_goes_on_as_far_as_it_is_seen(
    axis: int, side: int, gap: float, reach: float, above: float
) -> None:
    """But no farther than half of the box: what is beyond that would not have been held."""
    found = goes_on_beside(BOX, [strip(axis, side, gap, reach, above=above)])
    assert found[axis] == pytest.approx(min(reach, HALF * SIZE[axis]))
    assert found[1 - axis] == found[2] == 0.0


@given(axes, sides, far, st.floats(LEVEL + 0.001, 0.3), sides)
def test_what_is_higher_or_lower_is_another_box(
    axis: int, side: int, reach: float, off: float, up: int
) -> None:
    """So is what begins farther off, or is seen along less than half of the side."""
    assert not any(goes_on_beside(BOX, [strip(axis, side, 0.0, reach, above=up * off)]))
    assert not any(goes_on_beside(BOX, [strip(axis, side, BESIDE + off, 0.4 + reach)]))
    short = strip(axis, side, 0.0, reach, along=MOST - 0.01)
    assert not any(goes_on_beside(BOX, [short, short]))
    assert not any(goes_on_beside(BOX, [strip(axis, side, -0.1, FARTHER - 0.001)]))


@given(axes, sides, near, far, st.floats(LEVEL + 0.001, STACKED - 0.001))
def test_for_a_hand_that_passes_it_may_be_joined_with_something_higher(
    axis: int, side: int, gap: float, reach: float, above: float
) -> None:
    """A box's own surface goes on, and where that ends is told as one with what is behind."""
    found = [strip(axis, side, gap, reach, above=above)]
    level = [strip(axis, side, gap, reach)]
    assert goes_on_beside(BOX, found, above=STACKED) == pytest.approx(goes_on_beside(BOX, level))
    assert goes_on_beside(BOX, found) == (0.0, 0.0, 0.0)


@given(axes, sides, far, st.integers(2, 6))
def test_a_surface_that_is_told_in_columns_is_one(
    axis: int, side: int, reach: float, columns: int
) -> None:
    """Each of them is seen along a part of the side alone."""
    whole, parts = strip(axis, side, 0.0, reach), []
    for k in range(columns):
        shift, size = np.zeros(3), np.array(whole.size)
        shift[1 - axis] = ((k + 0.5) / columns - 0.5) * SIZE[1 - axis]
        size[1 - axis] /= columns
        shape: Vector3 = tuple(size.tolist())
        parts.append(OrientedBox(whole.pose @ Pose(tuple(shift.tolist())), shape))
    assert goes_on_beside(BOX, parts) == pytest.approx(goes_on_beside(BOX, [whole]))


@given(st.lists(st.tuples(axes, sides, near, far, flush), max_size=4))
def test_what_more_is_seen_makes_a_box_no_surer(
    strips: list[tuple[int, int, float, float, float]],
) -> None:
    """And nothing makes it certain."""
    assume(strips)
    solids = [strip(axis, side, gap, reach, above=up) for axis, side, gap, reach, up in strips]
    fewer, more = goes_on_beside(BOX, solids[1:]), goes_on_beside(BOX, solids)
    assert all(a <= b for a, b in zip(fewer, more, strict=True))
    assert goes_on_beside(BOX, []) == (0.0, 0.0, 0.0)


class Puzzled(Remembering):
    """A sight that sees something beside the first box which no box explains, for some looks."""

    puzzled = 99

    async def look(self) -> View:
        """All that is believed, and that."""
        view = await Remembering.look(self)
        first = next((box for box in view.boxes if box.id == "b1"), None)
        self.puzzled -= 1
        if first is None or self.puzzled < 0:
            return replace(view, obstacles=())
        x, y, z = first.shape.centre
        a, b, c = first.shape.size
        beside = OrientedBox.from_corner(
            (x - a / 2, y - b / 2 - 0.08, z + c / 2 - 0.05), (a, 0.08, 0.05)
        )
        return replace(view, obstacles=(beside,))


@pytest.mark.parametrize(("looks", "fate"), [(99, Fate.BY_PERSON), (3, STORED)])
def test_such_a_box_waits_for_a_look_that_explains_it_and_then_a_person_takes_it(
    looks: int, fate: Fate
) -> None:
    """Where it hangs in the hand nobody would know (dev-056, dev-021)."""
    cell = Cell(2, unknown=[1])
    cell.sight = Puzzled([pile(2, [1])])
    cell.sight.puzzled = looks
    cell.work.ports = replace(cell.work.ports, sight=cell.sight)
    cell.reader.script = (("product-1",),) * 8
    cell.works().assert_whole()
    assert cell.fates == {"b1": fate, "b2": STORED}
    assert list(cell.fates) == ["b2", "b1"]
    reasons = [each.reason for each in cell.work.departures.sequence if each.box == "b1"]
    assert reasons == [STRADDLES if fate is Fate.BY_PERSON else ""]
    assert cell.started.count("kr60_reach(b1)") == (fate is STORED)
