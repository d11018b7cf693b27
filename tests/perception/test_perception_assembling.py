"""Boxes are put together from their faces, whatever of them was seen."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from depal.domain import EURO_PALLET, Gtin, PalletStand, Product, cell_from_pallet
from depal.geometry import OrientedBox, Pose, Vector3
from depal.perception.assembling import boxes_of
from depal.perception.assembling.sizing import Seen, sized
from depal.perception.faces import Errors, Face, Facing, Name, SeenBox
from depal.perception.rasters import Region

REGION = Region.above(PalletStand(cell_from_pallet(EURO_PALLET), EURO_PALLET))
SMALL = Product(Gtin("00000000000017"), "small", (0.30, 0.20, 0.15), 3.0)
LARGE = Product(Gtin("00000000000024"), "large", (0.40, 0.25, 0.22), 6.0)
PRODUCTS = (SMALL, LARGE)
EXACT = Errors(tuple(tuple(row) for row in (np.eye(4) * 1e-14).tolist()), 0, (0.0,) * 4)


def faces_of(
    size: Vector3, centre: Vector3, yaw: float, name: Name | None = None
) -> tuple[Face, Face]:
    """Front and top of a box in the region: depth, width, height; middle; turn [m, rad]."""
    depth, width, height = size
    box = REGION.cell_from_region @ Pose.from_yaw(centre, yaw)
    front = Pose((-depth / 2, 0.0, 0.0), ((0.0, 0.0, 1.0), (-1.0, 0.0, 0.0), (0.0, -1.0, 0.0)))
    top = Pose((0.0, 0.0, height / 2), ((0.0, -1.0, 0.0), (-1.0, 0.0, 0.0), (0.0, 0.0, -1.0)))
    return (
        Face(Facing.FRONT, box @ front, (width, height), 0.9, name=name, errors=EXACT),
        Face(Facing.TOP, box @ top, (width, depth), 0.9, errors=EXACT),
    )


def close(box: SeenBox, size: Vector3, centre: Vector3, yaw: float) -> None:
    """Fails unless a box is where and how it should be."""
    expected = OrientedBox(REGION.cell_from_region @ Pose.from_yaw(centre, yaw), size)
    assert box.shape.centre == pytest.approx(expected.centre, abs=1e-6)
    assert box.shape.size == pytest.approx(size, abs=1e-6)
    assert np.allclose(box.shape.pose.rotation, expected.pose.rotation, atol=1e-6)


places = st.tuples(st.floats(0.3, 0.6), st.floats(-0.4, 0.4), st.floats(0.3, 1.2))
turns = st.floats(-math.radians(8), math.radians(8))
lying = st.sampled_from(("end", "side"))


@given(places, turns, st.sampled_from(PRODUCTS), lying)
def test_a_box_of_which_both_faces_are_seen_is_found_whole(
    centre: Vector3, yaw: float, product: Product, shown: str
) -> None:
    """Its pose and its size, whichever side it shows."""
    length, width, height = product.size
    size = (length, width, height) if shown == "end" else (width, length, height)
    (box,) = boxes_of(faces_of(size, centre, yaw), REGION, PRODUCTS)
    close(box, size, centre, yaw)
    assert box.sized
    assert len(box.faces) == 2


@given(places, turns, st.sampled_from(PRODUCTS), lying)
def test_a_face_that_fits_one_product_alone_tells_the_whole_box(
    centre: Vector3, yaw: float, product: Product, shown: str
) -> None:
    """The edge that nobody has seen is the product's."""
    length, width, height = product.size
    size = (length, width, height) if shown == "end" else (width, length, height)
    front, _ = faces_of(size, centre, yaw)
    (box,) = boxes_of([front], REGION, PRODUCTS)
    close(box, size, centre, yaw)
    assert box.sized


@given(places, st.sampled_from(PRODUCTS))
def test_a_name_that_is_certain_is_the_boxs_and_one_that_is_not_is_not(
    centre: Vector3, product: Product
) -> None:
    """Only what may be believed makes a recognition."""
    length, width, height = product.size
    for certain in (True, False):
        name = Name(product.gtin, "side", 0.95, certain)
        faces = faces_of((width, length, height), centre, 0.0, name)
        (box,) = boxes_of(faces, REGION, PRODUCTS)
        assert box.gtin == (product.gtin if certain else None)


@given(places, st.floats(0.16, 0.3))
def test_faces_that_do_not_meet_are_of_two_boxes(centre: Vector3, apart: float) -> None:
    """A top far behind a front belongs to somebody else."""
    front, top = faces_of((0.2, 0.3, 0.15), centre, 0.0)
    moved = Pose((0.0, 0.0, apart), ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)))
    other = Face(Facing.TOP, moved @ top.cell_from_face, top.size, 0.9)
    assert len(boxes_of([front, other], REGION, PRODUCTS)) == 2


def test_a_size_that_two_products_leave_open_is_not_certain() -> None:
    """Both fit the face, and they differ behind it."""
    twin = Product(Gtin("00000000000031"), "deep", (0.30, 0.28, 0.15), 4.0)
    found = sized(Seen(None, 0.30, 0.15), (SMALL, twin), None)
    assert not found.certain
    assert sized(Seen(0.28, 0.30, 0.15), (SMALL, twin), None).gtins == {twin.gtin}
    assert sized(Seen(None, 0.30, 0.15), (SMALL, twin), SMALL.gtin).certain
    supposed = sized(Seen(None, 0.30, 0.15), (SMALL, twin), None, (), SMALL.gtin)
    assert supposed.depth == sized(Seen(None, 0.30, 0.15), (SMALL,), None).depth
    assert not supposed.certain  # a name that is only likely makes nothing certain


def test_what_fits_no_product_keeps_its_measures() -> None:
    """An unknown box is as large as it looks."""
    found = sized(Seen(0.5, 0.111, 0.09), PRODUCTS, None)
    assert (found.depth, found.width, found.height) == (0.5, 0.111, 0.09)
    assert found.certain
    assert not sized(Seen(None, 0.111, 0.09), PRODUCTS, None).certain


def test_the_height_of_a_top_is_that_at_which_it_stands_on_something() -> None:
    """Two products have this top; only one of them would stand on the box below."""
    tall = Product(Gtin("00000000000048"), "tall", (0.30, 0.20, 0.32), 5.0)
    assert sized(Seen(0.2, 0.3, None), (SMALL, tall), None, (0.32,)).height == 0.32
    assert sized(Seen(0.2, 0.3, None), (SMALL, tall), None, (0.15,)).height == 0.15
