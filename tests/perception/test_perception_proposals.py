"""Rectangles are proposed where edges are, in whatever direction they run."""

import math
from collections.abc import Sequence

import cv2
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from depal.geometry import Pose
from depal.perception.detecting import Expected, Finder, Found, Printed, RefutedFaces
from depal.perception.faces import Facing, Name, Raster, Rectangle
from depal.perception.proposals.candidates import Candidates, best, by_lines, placed
from depal.perception.proposals.kernels import FEATURES
from depal.perception.scoring import NAMES, described
from depal.perception.scoring.features import edge_misfits, misfits
from depal.perception.seams import directions_of, seams_of

STEP = 0.003
WIDE, HIGH, FINE = 260, 220, 4


def raster_with(rectangles: list[Rectangle], seed: int = 0, contrast: float = 0.8) -> Raster:
    """Brown faces with darker outlines on a board of the same depth, with noise."""
    random = np.random.default_rng(seed)
    picture = np.full((HIGH * FINE, WIDE * FINE, 3), (150, 120, 90), dtype=np.float32)
    for rectangle in rectangles:
        corners = np.round((rectangle.corners / STEP + 0.5) * FINE * 16 - 8).astype(np.int32)
        brown = (190, 150, 105)
        cv2.fillConvexPoly(picture, corners, brown, shift=4)
        dark = tuple(contrast * value for value in brown)
        cv2.polylines(picture, [corners], isClosed=True, color=dark, thickness=FINE, shift=4)
    picture = cv2.resize(picture, (WIDE, HIGH), interpolation=cv2.INTER_AREA)
    noisy = picture + random.normal(0.0, 3.0, picture.shape)
    colour = np.clip(noisy, 1, 255).astype(np.uint8)
    depth = np.full((HIGH, WIDE), 0.3, dtype=np.float32)
    known = np.ones((HIGH, WIDE), dtype=np.bool_)
    return Raster(Facing.TOP, Pose(), STEP, colour, depth, known)


def overlap(first: Rectangle, second: Rectangle) -> float:
    """Intersection over union, by counting points."""
    u, v = np.meshgrid(np.arange(0, WIDE * STEP, 0.004), np.arange(0, HIGH * STEP, 0.004))
    inside = []
    for each in (first, second):
        c, s = math.cos(each.turn), math.sin(each.turn)
        along = np.abs((u - each.u) * c + (v - each.v) * s) < each.width / 2
        across = np.abs((v - each.v) * c - (u - each.u) * s) < each.height / 2
        inside.append(along & across)
    return float((inside[0] & inside[1]).sum() / (inside[0] | inside[1]).sum())


lone = st.builds(
    Rectangle,
    st.floats(0.3, 0.48),
    st.floats(0.26, 0.4),
    st.floats(0.12, 0.4),
    st.floats(0.12, 0.35),
    st.floats(math.radians(-20), math.radians(20)),
)


@given(lone)
@settings(max_examples=15)
def test_the_direction_of_edges_is_found(rectangle: Rectangle) -> None:
    """Within a degree, whatever it is."""
    turns = directions_of(raster_with([rectangle]), 2)
    away = [
        abs((turn - rectangle.turn + math.pi / 4) % (math.pi / 2) - math.pi / 4) for turn in turns
    ]
    assert min(away) < math.radians(1.0)


@given(lone, st.sampled_from(("told", "")))
@settings(max_examples=15)
def test_a_face_is_among_the_proposals_with_its_size_known_or_not(
    rectangle: Rectangle, told: str
) -> None:
    """Some candidate covers it: no side is more than two pixels off."""
    raster = raster_with([rectangle])
    seams = [seams_of(raster, turn) for turn in directions_of(raster, 2)]
    sizes = [(rectangle.width, rectangle.height)] if told else []
    found = by_lines(seams, sizes)
    near = np.hypot(found.values[:, 0] - rectangle.u, found.values[:, 1] - rectangle.v) < 0.02
    some = [Rectangle(*row) for row in found.values[near][:400].tolist()]
    off = 4 * STEP * (1 / rectangle.width + 1 / rectangle.height)
    assert max(overlap(each, rectangle) for each in some) > 1 - off


def test_evidence_lies_on_edges_and_along_them() -> None:
    """An upright edge is none along rows."""
    raster = raster_with([Rectangle(0.4, 0.33, 0.3, 0.3)])
    seams = seams_of(raster, 0.0)
    left, middle = round(0.25 / STEP), round(0.33 / STEP)
    assert seams.upright[middle, left - 1 : left + 2].max() > 0.8
    assert seams.level[middle, left - 1 : left + 2].max() < 0.5
    assert seams.upright[middle, round(0.4 / STEP)] < 0.4


def test_what_something_else_suggests_is_measured_like_the_others() -> None:
    """A placed rectangle has the same numbers as one that lines suggest."""
    seams = [seams_of(raster_with([Rectangle(0.4, 0.33, 0.3, 0.3)]), 0.0)]
    found = by_lines(seams, [])
    some = range(0, len(found), max(len(found) // 20, 1))
    again = placed(seams, [found.rectangles[k] for k in some])
    assert again.values == pytest.approx(found.values[some])
    assert again.measured == pytest.approx(found.measured[some])


@given(st.lists(st.floats(-3.0, 3.0), min_size=1, max_size=30), st.integers(1, 8))
def test_the_best_come_first_and_none_is_like_another(odds: list[float], most: int) -> None:
    """And no more than are asked for."""
    count = len(odds)
    values = np.column_stack(
        [np.arange(count) % 5 * 0.2, np.zeros(count)]
        + [np.full(count, 0.1)] * 2
        + [np.zeros(count)] * 2
    )
    candidates = Candidates(values, np.zeros((count, FEATURES)))
    rows = best(candidates, np.array(odds), most)
    assert len(rows) <= most
    chosen = [odds[row] for row in rows]
    assert chosen == sorted(chosen, reverse=True)
    assert len({values[row, 0] for row in rows}) == len(rows)
    assert max(odds) == chosen[0]


@given(st.floats(0.1, 0.5), st.floats(0.1, 0.5))
def test_what_has_an_expected_size_does_not_misfit(width: float, height: float) -> None:
    """Another size does, by the distance, up to four centimetres."""
    sizes = np.array([[width, height], [width + 0.02, height], [width + 1.0, height + 1.0]])
    assert misfits(sizes, [(width, height)]) == pytest.approx([0.0, 2.0, 4.0])
    assert edge_misfits(sizes, [(width, height)]) == pytest.approx([0.0, 0.0, 4.0])


def test_every_feature_has_a_name() -> None:
    """And none is missing where nothing is known."""
    raster = raster_with([Rectangle(0.4, 0.33, 0.3, 0.3)])
    found = by_lines([seams_of(raster, 0.0)], [])
    features = described(found.measured, found.sizes, [], np.full(len(found), -1.0))
    assert features.shape == (len(found), len(NAMES))
    assert np.isfinite(features).all()


def faces_in(
    raster: Raster,
    expected: Expected,
    prints: Sequence[Printed],
    fixed: Sequence[Rectangle] = (),
    refuted: RefutedFaces | None = None,
) -> tuple[Found, ...]:
    """What a raster shows by itself."""
    finder = Finder()
    return finder.chosen(finder.weighed(raster, expected, prints, fixed, refuted))


def test_flush_faces_are_found_side_by_side_and_a_known_one_is_left_alone() -> None:
    """Four faces, no gap between them."""
    faces = [Rectangle(0.3 + 0.2 * i, 0.25 + 0.16 * j, 0.2, 0.16) for i in (0, 1) for j in (0, 1)]
    raster = raster_with(faces, contrast=0.6)
    expected = Expected(((0.2, 0.16, 0.12),))
    name = Name("00000000000017", "top", 0.95, certain=False)
    prints = [Printed(each, name) for each in faces]
    found = faces_in(raster, expected, prints)
    for face in faces:
        assert max(overlap(face, each.rectangle) for each in found) > 0.85
    rest = faces_in(raster, expected, prints, fixed=faces[:1])
    assert all(overlap(faces[0], each.rectangle) < 0.1 for each in rest)


def test_two_faces_are_found_where_a_box_of_both_was_refuted() -> None:
    """What looked like one long face is the next best thing that explains the place."""
    pair = [Rectangle(0.3 + 0.2 * i, 0.3, 0.2, 0.16) for i in (0, 1)]
    long = Rectangle(0.4, 0.3, 0.4, 0.16, 0.0, 0.3)
    raster = raster_with(pair, contrast=0.6)
    expected = Expected(((0.2, 0.16, 0.12), (0.4, 0.16, 0.12)))
    prints = [Printed(long, Name("00000000000017", "top", 0.95, certain=False))]
    believed = faces_in(raster, expected, prints)
    assert max(overlap(long, each.rectangle) for each in believed) > 0.85
    found = faces_in(raster, expected, prints, refuted=RefutedFaces((long,)))
    assert all(overlap(long, each.rectangle) < 0.85 for each in found)
    for face in pair:
        assert max(overlap(face, each.rectangle) for each in found) > 0.85
