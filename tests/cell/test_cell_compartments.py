"""What stands in a compartment and is not booked: its range sensor tells, whoever has put it."""

import math

from hypothesis import given
from hypothesis import strategies as st

from depal.cell.planning.compartments import SLACK, stranger_in
from depal.domain import BoxId, Place, PlaceId
from depal.geometry import OrientedBox, Pose
from depal.logistics.placing import PlaceMap, Standing
from depal.simulation.devices.ranging import STEP, STRIP, profile_of

OFF = 0.025
"""A box stands this far from where the books say, at the most [m]."""

PLACES = st.builds(
    Place,
    st.just(PlaceId("trolley_1/level_1")),
    st.builds(Pose.from_yaw, st.just((1.0, -2.0, 0.3)), st.floats(-3.0, 3.0)),
    st.tuples(st.floats(0.4, 1.2), st.floats(0.2, 0.6)),
    st.floats(0.3, 0.9),
)


@st.composite
def booked(draw: st.DrawFn) -> PlaceMap:
    """A compartment with boxes side by side in it."""
    place = draw(PLACES)
    width, height = place.opening
    y, boxes = -width / 2, []
    for number in range(draw(st.integers(0, 4))):
        size = (
            draw(st.floats(0.1, place.depth)),
            draw(st.floats(0.05, 0.4)),
            draw(st.floats(0.05, height)),
        )
        y += draw(st.floats(0.0, 0.2))
        if y + size[1] > width / 2:
            break
        x = draw(st.floats(0.0, place.depth - size[0]))
        boxes.append(Standing(BoxId(f"b{number}"), (x, y, 0.0), size))
        y += size[1]
    return PlaceMap(place, tuple(boxes))


def as_it_stands(place: Place, box: Standing, x: float = 0.0, y: float = 0.0) -> OrientedBox:
    """A box in the cell frame, shifted from where the books have it [m]."""
    middle = [edge + size / 2 for edge, size in zip(box.corner, box.size, strict=True)]
    pose = place.cell_from_place @ Pose((middle[0] + x, middle[1] + y, middle[2]))
    return OrientedBox(pose, box.size)


@given(booked(), st.data())
def test_what_is_booked_is_no_stranger(books: PlaceMap, data: st.DataObject) -> None:
    """Wherever the boxes stand within what placing is off, whichever are promised and not there."""
    shift = st.floats(-OFF, OFF)
    promised = {box.id for box in books.boxes if data.draw(st.booleans())}
    things = [
        as_it_stands(books.place, box, data.draw(shift), data.draw(shift))
        for box in books.boxes
        if box.id not in promised
    ]
    assert stranger_in(books, profile_of(books.place, things), promised) is None


@given(booked(), st.data())
def test_what_stands_before_the_booked_boxes_is_found(books: PlaceMap, data: st.DataObject) -> None:
    """A thing that is at least two strips wide, and as far in as it is."""
    place = books.place
    width, height = place.opening
    size = (0.1, data.draw(st.floats(2.1 * STRIP, width)), data.draw(st.floats(0.05, height)))
    y = data.draw(st.floats(-width / 2, width / 2 - size[1]))
    fronts = [box.corner[0] for box in books.boxes]
    most = min([place.depth, *fronts]) - SLACK - 2 * STEP
    x = data.draw(st.floats(-0.05, max(most, -0.05)))
    things = [as_it_stands(place, box) for box in books.boxes]
    strange = as_it_stands(place, Standing(BoxId("?"), (x, y, 0.0), size))
    found = stranger_in(books, profile_of(place, [*things, strange]))
    if most >= 0.0:
        assert found is not None
        assert math.isclose(found, max(x, 0.0), abs_tol=STEP)


@given(PLACES, st.floats(0.01, 2.0), st.floats(-1.0, 1.0))
def test_what_stands_outside_is_not_seen(place: Place, away: float, along: float) -> None:
    """Before the opening, beside it, or above it."""
    size = (0.1, 0.1, 0.1)
    width, height = place.opening
    shifts = [
        (-0.051 - away, along, 0.1),
        (0.1, width / 2 + 0.051 + away, 0.1),
        (0.1, along, height + 0.051 + away),
        (place.depth + 0.051 + away, along, 0.1),
    ]
    things = [OrientedBox(place.cell_from_place @ Pose(shift), size) for shift in shifts]
    profile = profile_of(place, things)
    assert all(math.isclose(free, place.depth, abs_tol=STEP) for free in profile)
    assert math.isclose(width / len(profile), min(STRIP, width), rel_tol=0.15)
