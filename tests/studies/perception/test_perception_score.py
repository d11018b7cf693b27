"""What a look is worth: poses, names, relations, and all together."""

import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from perception_truths import face_like, perfect, turned, wall_of

from depal.domain import Gtin
from depal.geometry import OrientedBox, Pose
from depal.perception.faces import Facing, Look, Relation, SeenBox
from depal.studies.perception import Score, Truth, pose_error, scored, true_relations
from depal.studies.perception.relations import judged
from depal.studies.statistics import Share

SMALL = st.floats(-0.02, 0.02)


def test_a_perfect_look_is_right_in_everything() -> None:
    """And wrong in nothing."""
    truth = wall_of(3, 2, 2)
    score = scored(perfect(truth), truth)
    for detected in score.detected.values():
        assert detected.right.value == detected.found.value == 1.0
    assert max(error.sideways for error in score.poses) == pytest.approx(0.0, abs=1e-9)
    assert score.names.all_known.right == score.names.all_known.boxes > 0
    assert score.names.all_known.wrong == score.names.phantoms == 0
    for counts in (score.on_top, score.occludes):
        assert counts.right.value == counts.found.value == 1.0


@given(st.integers(0, 5), st.integers(0, 3))
def test_what_is_missed_costs_recall_and_what_is_made_up_costs_precision(
    missed: int, made_up: int
) -> None:
    """One does not touch the other."""
    truth = wall_of()
    fronts = [face for face in truth.faces if face.facing is Facing.FRONT]
    found = [face_like(face) for face in fronts[missed:]]
    found += [face_like(fronts[0], right=5.0 + k) for k in range(made_up)]
    score = scored(Look((), faces=tuple(found)), truth)
    detected = score.detected[Facing.FRONT]
    assert detected.found == Share(6 - missed, 6)
    assert detected.right == Share(6 - missed, 6 - missed + made_up)


@given(SMALL, SMALL, SMALL)
def test_the_error_of_a_moved_face_is_how_far_it_was_moved(
    right: float, down: float, deep: float
) -> None:
    """Within the plane and across it, of fronts and tops."""
    for true in wall_of(1, 1).faces:
        error = pose_error(face_like(true, right, down, deep), true)
        assert error.sideways == pytest.approx(math.hypot(right, down), abs=1e-9)
        assert error.depth == pytest.approx(deep, abs=1e-9)
        assert error.yaw == pytest.approx(0.0, abs=1e-9)
        assert error.size == 0.0


@given(st.floats(-0.5, 0.5))
def test_the_error_of_a_turned_face_is_its_yaw(yaw: float) -> None:
    """About the vertical."""
    for true in wall_of(1, 1).faces:
        assert pose_error(turned(true, yaw), true).yaw == pytest.approx(yaw, abs=1e-9)


def test_a_top_that_is_described_the_other_way_round_is_the_same_top() -> None:
    """Width and height change places with the axes."""
    true = wall_of(1, 1).faces[1]
    quarter = Pose(rotation=((0.0, -1.0, 0.0), (1.0, 0.0, 0.0), (0.0, 0.0, 1.0)))
    other = replace(
        face_like(true), cell_from_face=true.cell_from_face @ quarter, size=true.size[::-1]
    )
    error = pose_error(other, true)
    assert (error.yaw, error.size) == pytest.approx((0.0, 0.0), abs=1e-9)


def test_grasp_faces_are_those_of_boxes_that_none_stands_on_or_before() -> None:
    """Of a block the upper front row alone; its faces count among all too."""
    truth = wall_of(3, 2, 2)
    score = scored(perfect(truth), truth)
    for facing in Facing:
        errors = [error for error in score.poses if error.facing is facing]
        assert (len(errors), sum(error.grasp for error in errors)) == (6, 3)


def named(look: Look, names: list[str | None]) -> Look:
    """The look with other names."""
    boxes = [
        replace(box, gtin=None if name is None else Gtin(name))
        for box, name in zip(look.boxes, names, strict=True)
    ]
    return replace(look, boxes=tuple(boxes))


def test_names_are_counted_by_what_is_known_of_the_box() -> None:
    """Known by stock, siblings apart, unknown apart, boxes that are not there apart."""
    truth = wall_of(3, 2)
    kinds = ["printed", "printed", "kraft", "kraft", "plain", "printed"]
    boxes = [replace(box, stock=kind) for box, kind in zip(truth.boxes, kinds, strict=True)]
    boxes[1] = replace(boxes[1], sibling=True)
    boxes[4] = replace(boxes[4], known=False)
    boxes[5] = replace(boxes[5], known=False, sibling=True)
    truth = Truth(tuple(boxes), truth.faces)
    own = [box.gtin for box in boxes]
    look = named(perfect(truth), [own[0], own[0], own[2], None, None, own[0]])
    away = face_like(truth.faces[0], right=5.0)
    ghost = SeenBox(boxes[0].shape, 0.9, np.eye(6), (away,), own[3])
    names = scored(replace(look, boxes=(*look.boxes, ghost)), truth).names
    assert {kind: (n.boxes, n.right, n.wrong) for kind, n in names.known.items()} == {
        "kraft": (2, 1, 0),
        "printed": (2, 1, 1),
    }
    assert (names.all_siblings.boxes, names.all_siblings.wrong) == (1, 1)
    assert (names.unknown.boxes, names.unknown.wrong) == (2, 1)
    assert (names.unknown_siblings.boxes, names.unknown_siblings.wrong) == (1, 1)
    assert names.phantoms == 1


def test_a_true_box_is_named_once() -> None:
    """Of two seen boxes on one true box the second is it once more, or is not there."""
    truth = wall_of(1, 1)
    look = perfect(truth)
    front, top = look.faces
    halves = tuple(replace(look.boxes[0], faces=(face,)) for face in (front, top))
    names = scored(replace(look, boxes=halves), truth).names
    assert names.all_known.boxes == 1
    assert (names.phantoms, names.twice) == (0, 1)
    other = replace(halves[0], gtin=Gtin("00000000000099"))  # the smaller half is the second
    names = scored(replace(look, boxes=(other, halves[1])), truth).names
    assert (names.phantoms, names.twice) == (1, 0)


@given(st.integers(0, 200), st.integers(0, 200))
def test_an_interval_holds_its_share_and_shrinks(count: int, more: int) -> None:
    """Wilson's, which stays within [0, 1]."""
    share = Share(count, count + more)
    low, high = share.ci95
    assert 0.0 <= low <= high <= 1.0
    if share.of:
        assert low <= share.value <= high
        wide, narrow = high - low, Share(10 * share.count, 10 * share.of).ci95
        assert narrow[1] - narrow[0] < wide


def test_intervals_are_those_of_the_tables() -> None:
    """Newcombe 1998, table I: 81 of 263, 15 of 148, 0 of 20, 1 of 29."""
    table = {
        (81, 263): (0.2553, 0.3662),
        (15, 148): (0.0624, 0.1605),
        (0, 20): (0.0, 0.1611),
        (1, 29): (0.0061, 0.1718),
    }
    for (count, of), interval in table.items():
        assert Share(count, of).ci95 == pytest.approx(interval, abs=5e-5)


def test_a_box_is_on_everything_that_is_below_it() -> None:
    """Three in a tower, one beside it, one a hair over the edge."""
    size = (0.3, 0.3, 0.2)
    tower = [OrientedBox.upright((1.6, 0.0, 0.1 + 0.2 * k), size) for k in range(3)]
    beside = OrientedBox.upright((1.6, 0.31, 0.1), size)
    over = OrientedBox.upright((1.6, 0.605, 0.3), size)
    on_top, hides = true_relations([*tower, beside, over])
    assert on_top.asked == {(1, 0), (2, 1), (2, 0)}
    assert on_top.accepted == {(1, 0), (2, 1), (2, 0), (4, 3)}
    assert not hides.accepted


def test_a_box_hides_what_stands_behind_it() -> None:
    """As seen from the robot, along x; more than a centimetre of it for certain."""
    size = (0.3, 0.3, 0.2)
    spots = [(1.6, 0.0), (1.95, 0.1), (1.95, 0.4), (1.95, -0.295)]
    _, hides = true_relations([OrientedBox.upright((x, y, 0.1), size) for x, y in spots])
    assert hides.asked == {(0, 1)}
    assert hides.accepted == {(0, 1), (0, 3)}


def test_relations_are_judged_between_boxes_that_were_found() -> None:
    """Doubted ones and those of boxes that are not there are left out."""
    shapes = [OrientedBox.upright((1.6, 0.0, 0.1 + 0.2 * k), (0.3, 0.3, 0.2)) for k in range(3)]
    on_top, _ = true_relations(shapes)
    seen = [
        Relation(0, 1, 0.9),
        Relation(1, 0, 0.9),
        Relation(0, 7, 0.9),
        Relation(2, 0, 0.4),
    ]
    counts = judged(seen, on_top, {0: 2, 1: 1, 2: 0})
    assert counts.right == Share(1, 2)
    assert counts.found == Share(1, 3)
    assert judged(seen, on_top, {0: 2}).found == Share(0, 0)


def test_scores_add_up() -> None:
    """Two looks count as two, in any order."""
    truth = wall_of()
    first, second = scored(perfect(truth, noise=0.002), truth), scored(Look(()), truth)
    both = first + second
    assert both.looks == 2
    assert both.detected[Facing.FRONT].found == Share(6, 12)
    assert (second + first).detected == both.detected
    assert (Score() + first) == first
