"""Where faces are known already nothing else is looked for, and everything beside them is."""

import math
from dataclasses import replace

import cv2
import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from depal.geometry import Pose
from depal.perception.faces import Facing, Raster, Rectangle
from depal.perception.rasters import Taken, filled
from depal.perception.rasters.taken import DEEP, RIM

STEP = 0.003
HIGH, WIDE = 160, 200


def raster(depth: float = 0.5) -> Raster:
    """A flat surface."""
    shape = (HIGH, WIDE)
    colour = np.zeros((*shape, 3), dtype=np.uint8)
    depths = np.full(shape, depth, dtype=np.float32)
    return Raster(Facing.TOP, Pose(), STEP, colour, depths, np.ones(shape, dtype=np.bool_))


anywhere = st.builds(
    Rectangle,
    st.floats(-0.1, 0.7),
    st.floats(-0.1, 0.6),
    st.floats(0.02, 0.4),
    st.floats(0.02, 0.4),
    st.floats(-0.8, 0.8),
    st.just(0.5),
)


def pixels(rectangle: Rectangle) -> np.ndarray[tuple[int, int], np.dtype[np.int64]]:
    """(1, 4) left, top, right, bottom of a rectangle that is not turned."""
    (left, top), (right, bottom) = (
        np.round(edge / STEP)
        for edge in (rectangle.corners.min(axis=0), rectangle.corners.max(axis=0))
    )
    return np.array([(left, top, right, bottom)], dtype=np.int64)


@given(anywhere)
@settings(max_examples=60)
def test_a_rectangle_is_filled_as_in_the_whole_raster(rectangle: Rectangle) -> None:
    """Whatever of it leaves the raster."""
    whole = np.zeros((HIGH, WIDE), dtype=np.uint8)
    cv2.fillConvexPoly(whole, np.round(rectangle.corners / STEP).astype(np.int32), (1,))
    part = np.zeros((HIGH, WIDE), dtype=np.bool_)
    rows, columns, inside = filled(rectangle, STEP, part.shape)
    part[rows, columns] = inside
    assert np.array_equal(part, whole > 0)


@given(st.floats(0.1, 0.4), st.floats(0.1, 0.3), st.floats(0.1, 0.2), st.floats(0.1, 0.2))
@settings(max_examples=40)
def test_a_known_face_is_not_looked_for_and_its_neighbours_are(
    u: float, v: float, width: float, height: float
) -> None:
    """Neighbours may even reach into it, by as much as faces may."""
    face = Rectangle(u, v, width, height, depth=0.5)
    taken = Taken.by(raster(), [face])
    assert not taken.leaves(pixels(face)).any()
    wider = replace(face, width=1.5 * width, height=1.5 * height)
    assert not taken.leaves(pixels(wider)).any()
    for du, dv in ((1, 0), (-1, 0), (0, 1), (0, -1)):
        beside = replace(face, u=u + du * (width - RIM), v=v + dv * (height - RIM))
        assert taken.leaves(pixels(beside)).all()
    assert Taken.by(raster(), []).leaves(pixels(face)).all()


def test_what_hides_a_known_face_is_looked_for() -> None:
    """A box that stands on another hides a part of its top."""
    face = Rectangle(0.25, 0.25, 0.2, 0.2, depth=0.5)
    above = raster(0.5 - 2 * DEEP)
    assert Taken.by(above, [face]).leaves(pixels(face)).all()
    nothing = raster(math.nan)
    assert not Taken.by(nothing, [face]).leaves(pixels(face)).any()


@given(st.floats(-0.7, 0.7))
def test_a_turned_raster_has_the_same_places(turn: float) -> None:
    """A rectangle along a turned raster's rows is taken there as it is here."""
    face = Rectangle(0.3, 0.24, 0.2, 0.15, turn, 0.5)
    taken = Taken.by(raster(), [face])
    c, s = math.cos(turn), math.sin(turn)
    middle = np.array((WIDE - 1, HIGH - 1)) / 2
    back = np.column_stack(((c, s), (-s, c), middle - np.array(((c, -s), (s, c))) @ (150, 150)))
    turned = taken.turned(back, (300, 300))
    u, v = (np.array(((c, s), (-s, c))) @ (np.array((0.3, 0.24)) / STEP - middle) + 150) * STEP
    there = Rectangle(float(u), float(v), 0.2, 0.15)
    assert not turned.leaves(pixels(there)).any()
    assert turned.leaves(pixels(replace(there, u=there.u + 0.2))).all()
    assert abs(int(turned.places.sum()) - int(taken.places.sum())) < 0.05 * taken.places.sum()
