"""Laws of finding prints on a raster."""

import math

import cv2
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from printed_faces import PLAIN, SIBLING, STRANGER, A, book_of_drawings, note_of, product

from depal.domain import Product
from depal.geometry import Pose
from depal.perception.faces import Facing, Raster, Rectangle
from depal.perception.pictures import side_size
from depal.perception.rasters import Taken
from depal.perception.recognition import gallery_of, sightings
from depal.perception.recognition.sightings import Sighting
from depal.simulation.imaging.photographs import drawn

STEP = 0.003
GALLERY = gallery_of(book_of_drawings(A, SIBLING, STRANGER), note_of(A, SIBLING, STRANGER))

Placed = tuple[Product, str, float, float, float]


def raster_with(
    placed: list[Placed], facing: Facing = Facing.FRONT, gains: tuple[float, ...] = (1.0, 1.0, 1.0)
) -> Raster:
    """A raster of 1 m by 0.8 m with faces at u, v [m], turned clockwise [rad]."""
    height, width = round(0.8 / STEP), round(1.0 / STEP)
    colour = np.full((height, width, 3), 150, dtype=np.uint8)
    random = np.random.default_rng(3)
    for shown, side, u, v, turn in placed:
        picture = cv2.GaussianBlur(drawn(shown, side, random, PLAIN), (0, 0), 1.2)
        k = STEP * 1000
        c, s = k * math.cos(turn), k * math.sin(turn)
        x0, y0 = u / STEP, v / STEP
        u0, v0 = (picture.shape[1] - 1) / 2, (picture.shape[0] - 1) / 2
        warp = np.array([[c, s, u0 - c * x0 - s * y0], [-s, c, v0 + s * x0 - c * y0]])
        flags = cv2.INTER_LINEAR | cv2.WARP_INVERSE_MAP
        cv2.warpAffine(
            picture,
            warp,
            (width, height),
            dst=colour,
            flags=flags,
            borderMode=cv2.BORDER_TRANSPARENT,
        )
    noisy = colour * np.array(gains) + 2.0 * random.standard_normal(colour.shape)
    depth = np.full((height, width), 0.3, dtype=np.float32)
    known = np.ones((height, width), dtype=np.bool_)
    return Raster(facing, Pose(), STEP, np.clip(noisy, 0, 255).astype(np.uint8), depth, known)


def at(found: tuple[Sighting, ...], u: float, v: float, reach: float = 0.006) -> Sighting | None:
    """The best sighting at a place."""
    for sighting in found:
        if math.hypot(sighting.rectangle.u - u, sighting.rectangle.v - v) < reach:
            return sighting
    return None


@given(
    st.floats(0.2, 0.8),
    st.floats(0.15, 0.65),
    st.floats(-0.07, 0.07),
    st.sampled_from((A, STRANGER)),
)
@settings(max_examples=15, deadline=None)
def test_a_print_is_found_where_it_is(u: float, v: float, turn: float, shown: Product) -> None:
    """Turned by up to four degrees, to one or two millimetres, with its size and depth."""
    sighting = at(sightings(raster_with([(shown, "side", u, v, turn)]), GALLERY), u, v)
    assert sighting is not None
    assert sighting.name.gtin == shown.gtin
    assert sighting.name.side == "side"
    assert not sighting.name.certain
    box = sighting.rectangle
    assert (box.u, box.v) == pytest.approx((u, v), abs=0.002)
    assert box.turn == pytest.approx(turn, abs=0.012)
    assert (box.width, box.height) == pytest.approx(side_size(shown, "side"))
    assert box.depth == pytest.approx(0.3)
    assert sighting.seen == pytest.approx(1.0)


def test_flush_neighbours_of_one_product_are_seen_one_by_one() -> None:
    """Six in two rows without any gap."""
    width, height = side_size(A, "side")
    places = [(0.2 + i * width, 0.2 + j * height) for i in range(3) for j in range(2)]
    found = sightings(raster_with([(A, "side", u, v, 0.0) for u, v in places]), GALLERY)
    for u, v in places:
        sighting = at(found, u, v, 0.003)
        assert sighting is not None
        assert sighting.name.score > 0.85


def test_siblings_stay_rivals() -> None:
    """At a raster's resolution words are hardly told apart."""
    found = sightings(raster_with([(A, "side", 0.5, 0.4, 0.0)]), GALLERY)
    sighting = at(found, 0.5, 0.4)
    assert sighting is not None
    assert SIBLING.gtin in {sighting.name.gtin, *(rival.gtin for rival in sighting.rivals)}


@pytest.mark.parametrize("quarter", range(4))
def test_a_top_is_seen_with_its_quarter_turn(quarter: int) -> None:
    """Width and height are those of the face as it lies."""
    placed: list[Placed] = [(A, "top", 0.5, 0.4, quarter * math.pi / 2)]
    sighting = at(sightings(raster_with(placed, Facing.TOP), GALLERY), 0.5, 0.4)
    assert sighting is not None
    assert sighting.name.quarter == quarter
    size = side_size(A, "top") if quarter % 2 == 0 else side_size(A, "top")[::-1]
    assert (sighting.rectangle.width, sighting.rectangle.height) == pytest.approx(size)


@given(st.tuples(st.floats(0.6, 1.0), st.floats(0.6, 1.0), st.floats(0.6, 1.0)))
@settings(max_examples=5, deadline=None)
def test_the_light_does_not_move_a_sighting(gains: tuple[float, ...]) -> None:
    """Nor its score, much."""
    placed: list[Placed] = [(A, "end", 0.4, 0.4, 0.02)]
    plain = at(sightings(raster_with(placed), GALLERY), 0.4, 0.4)
    other = at(sightings(raster_with(placed, gains=gains), GALLERY), 0.4, 0.4)
    assert plain is not None
    assert other is not None
    assert other.name.score == pytest.approx(plain.name.score, abs=0.05)


def test_nothing_is_looked_for_where_a_face_is_known() -> None:
    """The same print beside it is found as if the other were not there."""
    raster = raster_with([(A, "side", 0.3, 0.4, 0.0), (A, "side", 0.7, 0.4, 0.0)])
    known = Rectangle(0.3, 0.4, *side_size(A, "side"), depth=0.3)
    every, rest = (sightings(raster, GALLERY, taken) for taken in (None, Taken.by(raster, [known])))
    assert at(every, 0.3, 0.4) is not None
    assert at(rest, 0.3, 0.4) is None
    assert at(rest, 0.7, 0.4) == at(every, 0.7, 0.4)


def test_an_empty_raster_shows_nothing() -> None:
    """Neither grey nor unknown."""
    grey = raster_with([])
    assert sightings(grey, GALLERY) == ()
    unknown = Raster(
        grey.facing, grey.cell_from_raster, STEP, grey.colour * 0, grey.depth * np.nan, ~grey.known
    )
    assert sightings(unknown, GALLERY) == ()


def test_a_raster_smaller_than_any_print_shows_nothing() -> None:
    """As when little of the pallet is in the picture."""
    grey = raster_with([])
    small = Raster(
        grey.facing,
        grey.cell_from_raster,
        STEP,
        np.ascontiguousarray(grey.colour[:30, :30]),
        np.ascontiguousarray(grey.depth[:30, :30]),
        np.ascontiguousarray(grey.known[:30, :30]),
    )
    assert sightings(small, GALLERY) == ()


@pytest.mark.parametrize("edge", [0.2, 0.203, 0.207, 0.211, 0.354])
def test_a_face_of_any_size_is_found(edge: float) -> None:
    """However its edges lie between the pixels in which it is searched for."""
    shown = product(int(A.gtin), (edge, edge - 0.035, 0.17))
    gallery = gallery_of(book_of_drawings(shown), note_of(shown))
    for side, facing in (("side", Facing.FRONT), ("end", Facing.FRONT), ("top", Facing.TOP)):
        found = sightings(raster_with([(shown, side, 0.45, 0.4, 0.0)], facing), gallery)
        sighting = at(found, 0.45, 0.4)
        assert sighting is not None
        assert sighting.name.side == side
        assert sighting.name.score > 0.9
