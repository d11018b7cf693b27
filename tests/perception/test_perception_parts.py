"""Sizes tell parts: two faces side by side are not one, and what is covered goes on."""

import cv2
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from depal.perception.proposals import surfaces
from depal.perception.proposals.kernels import FEATURES
from depal.perception.proposals.lines import measured, running
from depal.perception.proposals.parts import LEAST
from depal.perception.scoring.parts import DIVIDED, PARTLY, UNSURE, doubts, whole
from depal.perception.seams import Seams

STEP = 0.003
WIDE, HIGH = 140, 110

edges = st.floats(0.1, 0.4)
sizes = st.lists(st.tuples(edges, edges), min_size=1, max_size=4)
covers = st.tuples(*[st.floats(0.0, 1.0)] * 4)


def seams_with(lines: list[tuple[bool, int, int, int]]) -> Seams:
    """Evidence on lines alone: whether upright, where, from, to [pixel]."""
    upright, level = (np.full((HIGH, WIDE), 0.1, dtype=np.float32) for _ in range(2))
    for up, at, first, last in lines:
        if up:
            cv2.line(upright, (at, first), (at, last), 0.95)
        else:
            cv2.line(level, (first, at), (last, at), 0.95)
    depth = np.full((HIGH, WIDE), 0.3, dtype=np.float32)
    known = np.ones((HIGH, WIDE), dtype=np.bool_)
    return Seams(0.0, STEP, np.eye(3)[:2], upright, level, known, depth)


def outlined(seam: int, until: int) -> Seams:
    """A rectangle from (20, 20) to (120, 80) with an upright line inside that ends somewhere."""
    sides = [(True, 20, 20, 80), (True, 120, 20, 80), (False, 20, 20, 120), (False, 80, 20, 120)]
    return seams_with([*sides, (True, seam, 20, until)])


def doubt(seams: Seams, known: list[tuple[float, float]], prints: float = -1.0) -> float:
    """About the rectangle from (20, 20) to (120, 80)."""
    pixels = np.array([[20, 20, 120, 80]])
    numbers = measured(seams, pixels, running(seams), known)
    size = np.array([[0.3, 0.18]])
    return float(doubts(numbers, size, known, np.array([prints]))[0])


@given(st.integers(50, 90))
@settings(max_examples=20)
def test_a_seam_between_two_expected_sizes_speaks_against_one_face(seam: int) -> None:
    """Wherever it is; not so where it ends half way, or is of no sizes, or a print knows better."""
    parts = [((seam - 20) * STEP, 0.18), ((120 - seam) * STEP, 0.18)]
    assert doubt(outlined(seam, 80), parts) == pytest.approx(DIVIDED)
    assert doubt(outlined(seam, 50), parts) == 0.0
    assert doubt(outlined(seam, 80), [(0.3, 0.18)]) == 0.0
    assert doubt(outlined(seam, 80), [(w, 0.3) for w, _ in parts]) == 0.0
    assert doubt(outlined(seam, 80), []) == 0.0
    assert doubt(outlined(seam, 80), parts, 0.9) == 0.0


@given(sizes, edges, edges, covers)
def test_a_face_goes_on_only_where_something_covers_it(
    known: list[tuple[float, float]], wide: float, high: float, covered: tuple[float, ...]
) -> None:
    """It never gets smaller, enough of it is seen, and it comes nearer to an expected size."""
    seen = np.array([[wide, high]])
    found, more = whole(seen, known, np.array([covered]))
    assert (found >= seen).all()
    if max(covered[0], covered[2]) <= 0.5:
        assert found[0, 0] == wide
    if max(covered[1], covered[3]) <= 0.5:
        assert found[0, 1] == high
    assert seen.prod() >= LEAST * found.prod() - 1e-12
    before, after = (np.hypot(*(np.array(known) - each).T).min() for each in (seen[0], found[0]))
    assert after <= before
    assert more[0] in (0.0, UNSURE)
    if more[0] == 0.0:
        assert (found == seen).all()


def test_what_is_hidden_in_part_is_taken_for_a_part() -> None:
    """Two thirds of a carton, the rest behind something; its face must be the surer."""
    known, seen = [(0.17, 0.26), (0.27, 0.35)], np.array([[0.17, 0.175]])
    found, more = whole(seen, known, np.array([[0.0, 0.0, 0.0, 1.0]]))
    assert found[0] == pytest.approx((0.17, 0.26))
    assert more[0] == UNSURE
    numbers = np.zeros((1, FEATURES))
    numbers[0, 25] = 1.0
    assert doubts(numbers, seen, known, np.array([-1.0])) == pytest.approx(PARTLY)
    alone, _ = whole(seen, known, np.zeros((1, 4)))
    assert alone[0] == pytest.approx(seen[0])


@given(st.integers(0, 3), st.integers(0, 10), st.floats(0.04, 0.2))
@settings(max_examples=30)
def test_what_covers_a_side_is_seen_across_a_gap(side: int, gap: int, nearer: float) -> None:
    """Nothing need be known between them; what lies behind or level covers nothing."""
    pixels = np.array([[40, 40, 90, 80]])
    outside = [
        np.s_[:, : 39 - gap],
        np.s_[: 39 - gap, :],
        np.s_[:, 92 + gap :],
        np.s_[82 + gap :, :],
    ]
    unknown = [np.s_[:, 39 - gap : 39], np.s_[39 - gap : 39, :], np.s_[:, 92 : 92 + gap]]
    unknown.append(np.s_[82 : 82 + gap, :])
    for depth, share in ((0.3 - nearer, 1.0), (0.3 + nearer, 0.0), (0.3, 0.0)):
        picture = np.full((HIGH, WIDE), 0.3, dtype=np.float32)
        picture[unknown[side]] = np.nan
        picture[outside[side]] = depth
        numbers = np.zeros((1, FEATURES))
        numbers[0, 16] = 0.3
        surfaces.covers(picture, STEP, pixels, numbers)
        assert numbers[0, 22 + side] == share
        assert np.delete(numbers[0, 22:26], side).max() <= 0.3
