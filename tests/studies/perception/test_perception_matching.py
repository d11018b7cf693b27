"""Matching detections to true faces: laws first."""

import itertools
import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from perception_truths import face_like, turned, wall_of

from depal.perception.faces import Facing
from depal.studies.perception import match_faces, matched
from depal.studies.perception.matching import AGREES, face_agreement
from depal.studies.perception.polygons import agreement, area_of, common_area
from depal.studies.perception.truth import corners_of

TABLES = st.tuples(st.integers(0, 6), st.integers(0, 6)).flatmap(
    lambda shape: arrays(float, shape, elements=st.floats(0.0, 1.0))
)
RECTANGLES = st.tuples(
    st.floats(-0.3, 0.3), st.floats(-0.3, 0.3), st.floats(0.05, 0.6), st.floats(0.05, 0.6),
    st.floats(-math.pi, math.pi),
)  # fmt: skip


def corners(rectangle: tuple[float, float, float, float, float]) -> np.ndarray:
    """(4, 2) of a middle, two edges and a turn."""
    x, y, a, b, turn = rectangle
    c, s = math.cos(turn), math.sin(turn)
    half = np.array([(-a, -b), (a, -b), (a, b), (-a, b)]) / 2
    return half @ np.array([(c, s), (-s, c)]) + (x, y)


@given(RECTANGLES, RECTANGLES)
def test_agreement_is_symmetric_and_between_nothing_and_all(first: tuple, second: tuple) -> None:
    """And the common area is in both."""
    a, b = corners(first), corners(second)
    assert 0.0 <= agreement(a, b) <= 1.0
    assert agreement(a, b) == pytest.approx(agreement(b, a), abs=1e-9)
    assert agreement(a, b[::-1]) == pytest.approx(agreement(a, b), abs=1e-9)
    assert common_area(a, b) <= min(area_of(a), area_of(b)) + 1e-9


@given(RECTANGLES, st.floats(-1.0, 1.0), st.floats(-1.0, 1.0))
def test_agreement_is_that_of_the_moved_rectangle(
    rectangle: tuple, right: float, down: float
) -> None:
    """A rectangle moved along its own edges shares what is left of both edges."""
    x, y, a, b, turn = rectangle
    c, s = math.cos(turn), math.sin(turn)
    moved = (x + c * right - s * down, y + s * right + c * down, a, b, turn)
    common = max(a - abs(right), 0.0) * max(b - abs(down), 0.0)
    expected = common / (2 * a * b - common)
    assert agreement(corners(rectangle), corners(moved)) == pytest.approx(expected, abs=1e-6)


@given(RECTANGLES, RECTANGLES)
def test_the_common_area_is_that_of_a_raster(first: tuple, second: tuple) -> None:
    """Against counting points of a grid, which knows no clipping."""
    a, b = corners(first), corners(second)
    step = 0.02
    grid = np.stack(np.meshgrid(*[np.arange(-0.8, 0.8, step)] * 2), axis=-1).reshape(-1, 2)
    inside = []
    for corner in (a, b):
        edges = np.roll(corner, -1, axis=0) - corner
        beside = [
            edge[0] * (grid[:, 1] - start[1]) - edge[1] * (grid[:, 0] - start[0])
            for start, edge in zip(corner, edges, strict=True)
        ]
        inside.append(np.all(np.array(beside) >= 0, axis=0))
    counted = float((inside[0] & inside[1]).sum()) * step * step
    assert common_area(a, b) == pytest.approx(counted, abs=0.03)


@given(TABLES, st.data())
def test_everything_is_matched_once_or_left_over(table: np.ndarray, data: st.DataObject) -> None:
    """Every detection has one fate, every face that counts is found or missed."""
    counts = data.draw(st.lists(st.booleans(), min_size=table.shape[1], max_size=table.shape[1]))
    result = matched(table, counts)
    detections = [d for d, _ in (*result.pairs, *result.ignored)] + list(result.wrong)
    assert sorted(detections) == list(range(len(table)))
    faces = [f for _, f in result.pairs]
    assert sorted([*faces, *result.missed]) == [f for f, asked in enumerate(counts) if asked]
    assert len({f for _, f in result.ignored}) == len(result.ignored)
    assert all(not counts[f] for _, f in result.ignored)
    assert all(table[pair] > AGREES for pair in (*result.pairs, *result.ignored))


@given(TABLES.filter(lambda table: max(table.shape, default=0) <= 4))
def test_no_other_way_of_matching_finds_more(table: np.ndarray) -> None:
    """Against trying all ways."""
    best = 0
    many, few = max(table.shape), min(table.shape)
    wide = table if table.shape[1] == many else table.T
    for columns in itertools.permutations(range(many), few):
        best = max(best, sum(wide[row, column] > AGREES for row, column in enumerate(columns)))
    assert len(matched(table, [True] * table.shape[1]).pairs) == best


@given(TABLES, st.randoms(use_true_random=False))
def test_the_order_of_detections_and_faces_changes_no_count(
    table: np.ndarray, random: object
) -> None:
    """Whatever order they come in."""
    rows, columns = list(range(table.shape[0])), list(range(table.shape[1]))
    random.shuffle(rows)  # type: ignore[attr-defined]
    random.shuffle(columns)  # type: ignore[attr-defined]
    counts = [column % 3 > 0 for column in range(table.shape[1])]
    first = matched(table, counts)
    second = matched(table[rows][:, columns], [counts[column] for column in columns])
    for part in ("pairs", "missed"):
        assert len(getattr(first, part)) == len(getattr(second, part))


@given(TABLES)
def test_a_detection_of_nothing_is_wrong_and_changes_nothing_else(table: np.ndarray) -> None:
    """Whatever else was found."""
    counts = [True] * table.shape[1]
    before = matched(table, counts)
    after = matched(np.vstack((table, np.zeros(table.shape[1]))), counts)
    assert len(after.pairs) == len(before.pairs)
    assert len(after.wrong) == len(before.wrong) + 1
    assert len(table) in after.wrong
    first, second = (sum(table[pair] for pair in result.pairs) for result in (before, after))
    assert first == pytest.approx(second)


def test_a_second_detection_of_a_face_is_wrong() -> None:
    """One to one."""
    result = matched(np.array([[0.8], [0.9]]), [True])
    assert result.pairs == ((1, 0),)
    assert result.wrong == (0,)


def test_a_detection_of_a_hidden_face_is_neither_right_nor_wrong() -> None:
    """It is there, and nobody asked for it."""
    result = matched(np.array([[0.9, 0.0], [0.0, 0.0]]), [False, True])
    assert result.ignored == ((0, 0),)
    assert result.wrong == (1,)
    assert result.missed == (1,)


def test_faces_in_two_planes_are_two_faces() -> None:
    """Before or behind, turned away, or one front and one top."""
    front, top = wall_of(1, 1).faces
    assert face_agreement(face_like(front), front) == pytest.approx(1.0)
    assert face_agreement(face_like(front, deep=0.055), front) == pytest.approx(1.0)
    assert face_agreement(face_like(front, deep=0.065), front) == 0.0
    assert face_agreement(turned(front, math.radians(21)), front) == 0.0
    assert face_agreement(face_like(front, right=3.0), front) == 0.0
    assert face_agreement(replace(face_like(front), facing=Facing.TOP), front) == 0.0
    assert face_agreement(face_like(top), front) == 0.0


@given(st.floats(-0.39, 0.39), st.floats(-0.24, 0.24))
def test_a_moved_detection_agrees_by_what_it_still_covers(right: float, down: float) -> None:
    """In the plane of the true face, whatever its pose in the cell."""
    front = wall_of(1, 1).faces[0]
    common = (0.4 - abs(right)) * (0.25 - abs(down))
    expected = common / (2 * 0.4 * 0.25 - common)
    assert face_agreement(face_like(front, right, down), front) == pytest.approx(expected, abs=1e-9)


def test_faces_are_matched_to_those_they_lie_on() -> None:
    """With a false one, a missed one and a doubled one."""
    truth = wall_of()
    counted = [index for index, face in enumerate(truth.faces) if face.counts]
    found = [face_like(truth.faces[index], 0.01, -0.01, 0.01) for index in counted[1:]]
    found += [found[0], face_like(truth.faces[counted[0]], right=0.2)]
    result = match_faces(found, truth.faces)
    assert [true for _, true in sorted(result.pairs)] == counted[1:]
    assert result.missed == (counted[0],)
    assert len(result.wrong) == 2
    assert corners_of(found[0].cell_from_face, found[0].size).shape == (4, 3)
