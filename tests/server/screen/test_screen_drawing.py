"""What is drawn: marks by shape and word, the arm where it is, held boxes as they were taken."""

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st
from screenstates import line, state_with

from depal.cell.files import shipped_cell
from depal.server.cellstate import CellState, QuestionState, Solid, TaskNode, TaskTree, TrolleyState
from depal.server.screen.grip import Grip, held_of
from depal.server.screen.panels.marks import NODES, SHAPES, Mark, blockers_of, marks_of
from depal.server.screen.panels.queue import queue_table
from depal.server.screen.panels.summary import summary
from depal.server.screen.panels.tree import trees
from depal.server.screen.panels.trolleys import trolleys
from depal.server.screen.plan import both, corners_of, from_above
from depal.server.screen.posture import posture
from depal.server.screen.said import said_in
from depal.server.screen.words import words_of

WORDS, SAID = words_of("en"), said_in("en")

LAYOUT = shipped_cell("default")

angles = st.floats(-2.0, 2.0)


def test_blockers_are_those_of_requested_boxes_and_theirs() -> None:
    """Blockers are those of requested boxes and theirs."""
    state = state_with(
        line("a", requested=True, blockers=("b",)),
        line("b", blockers=("c",)),
        line("c"),
        line("d", blockers=("a",)),
    )
    assert blockers_of(state) == {"b", "c"}


def test_a_cycle_of_blockers_ends() -> None:
    """A cycle of blockers ends."""
    state = state_with(line("a", requested=True, blockers=("b",)), line("b", blockers=("a",)))
    assert blockers_of(state) == {"a", "b"}


def test_the_most_important_mark_wins() -> None:
    """The most important mark wins."""
    asked = QuestionState("q", "?", ("yes",), "a", 0.0)
    lines = (line("a", requested=True), line("b", requested=True, blockers=("c",)), line("c"))
    marks = marks_of(state_with(*lines, target="b", questions=(asked,)))
    assert marks == {"a": Mark.ASKED, "b": Mark.TARGET, "c": Mark.BLOCKER}
    assert marks_of(state_with(line("c")))["c"] is Mark.PLAIN


def test_no_mark_lives_by_its_colour_alone() -> None:
    """No mark lives by its colour alone."""
    shapes = [SHAPES[mark] for mark in Mark if mark is not Mark.PLAIN]
    assert len(set(shapes)) == len(shapes)
    assert all(shapes)
    looks = [look.shape for look in NODES.values()]
    assert len(set(looks)) == len(looks)
    table = queue_table(state_with(line("a"), target="a"), WORDS, SAID)
    assert WORDS("mark.target") in table


@given(st.tuples(angles, angles, angles, angles, angles, angles))
def test_links_hang_together(joints: tuple[float, ...]) -> None:
    """Links hang together."""
    geometry = LAYOUT.robot.geometry
    poses = posture(LAYOUT.robot, joints)
    assert len(poses) == 8
    upper, fore = poses[2].origin, poses[3].origin
    assert math.dist(upper, fore) == pytest.approx(geometry.c2, abs=1e-9)
    assert math.dist(poses[5].origin, poses[7].origin) == pytest.approx(geometry.c4, abs=1e-9)


def test_an_arm_that_tells_no_joints_is_parked() -> None:
    """An arm that tells no joints is parked."""
    assert posture(LAYOUT.robot, ()) == posture(LAYOUT.robot, LAYOUT.robot.parked)


@given(st.tuples(angles, angles, angles, angles, angles, angles), st.floats(-3, 3))
def test_a_held_box_seen_from_the_flange_stands_where_it_stood(
    joints: tuple[float, ...], yaw: float
) -> None:
    """A held box seen from the flange stands where it stood."""
    flange = posture(LAYOUT.robot, joints)[-1]
    solid = Solid((1.5, 0.2, 0.7), (0.3, 0.4, 0.2), yaw)
    held = held_of("b1", solid, flange)
    assert flange.at(held.origin) == pytest.approx(solid.centre, abs=1e-9)


def test_a_grip_remembers_where_the_box_stood_before_it_was_taken() -> None:
    """A grip remembers where the box stood before it was taken."""
    grip, flange = Grip(), posture(LAYOUT.robot, ())[-1]
    assert grip.follow(state_with(line("b1")), flange) is None
    held = grip.follow(state_with(held="b1"), flange)
    assert held is not None
    assert grip.follow(state_with(held="b1"), posture(LAYOUT.robot, (0.1,) * 6)[-1]) is held
    assert grip.follow(state_with(), flange) is None
    assert grip.follow(state_with(held="b9"), flange) is None


@given(st.floats(-3, 3))
def test_corners_are_as_far_from_the_middle_as_the_size_says(yaw: float) -> None:
    """Corners are as far from the middle as the size says."""
    solid = Solid((1.0, 2.0, 3.0), (0.3, 0.4, 0.2), yaw)
    half = math.hypot(0.15, 0.2, 0.1)
    for corner in corners_of(solid):
        assert math.dist(corner, solid.centre) == pytest.approx(half)


def test_the_plan_is_seen_from_behind_the_arm() -> None:
    """The plan is seen from behind the arm."""
    x, y = from_above((2.0, 1.0, 0.0))
    assert (x, y) == (-100.0, -200.0)


def test_the_plan_shows_every_box_and_names_the_marked_ones() -> None:
    """The plan shows every box and names the marked ones."""
    state = state_with(line("b1"), line("b2"), target="b2", held="b3")
    drawn = both(LAYOUT, state, WORDS)
    assert drawn.count('class="box"') == 4
    assert "▼ b2" in drawn
    assert "b3" in drawn
    assert drawn.count('role="img"') == 2


def test_a_trolley_that_needs_hands_says_so() -> None:
    """A trolley that needs hands says so."""
    wanted = TrolleyState("trolley_2", present=True, boxes=9, fill=0.83, full=True, exchanging=True)
    told = trolleys(state_with(trolleys=(wanted,)), WORDS)
    assert WORDS("trolley.exchange") in told
    assert "83 %" in told
    assert "trolley 2" in told


def test_the_summary_says_how_far_it_is() -> None:
    """The summary says how far it is."""
    told = summary(state_with(stored=6, aside=1, lost=1, boxes=12, rate=418.0), WORDS)
    assert "6 of 12 stored" in told
    assert "8 of 12 boxes" in told
    assert "420 boxes/h" in told
    assert "1 fallen" in told
    assert summary(CellState(), WORDS).count("mode-idle") == 1


def test_a_task_that_does_not_run_says_why() -> None:
    """A task that does not run says why."""
    nodes = (
        TaskNode("store(b1)", 0, "enabled", concrete=False),
        TaskNode("leave(b1)", 1, "disabled", concrete=True, why="b1.taken is not set"),
    )
    told = trees([TaskTree(3, 0.8, nodes)], WORDS)
    assert "b1.taken is not set" in told
    assert WORDS("node.disabled") in told
    assert "--depth:1" in told
