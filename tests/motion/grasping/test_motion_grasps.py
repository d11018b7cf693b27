"""The ways to hold a box: cups wholly on the face, plates in its plane, and no way too weak."""

import itertools
import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from depal.cell.files import shipped_cell
from depal.domain import FRONT, LOWER, Approach, Grasp
from depal.geometry import OrientedBox, Vector3
from depal.motion.grasping import grasps, in_a_row, refusal, static_share
from depal.motion.grasping.candidates import share_of
from depal.motion.grasping.fitting import faces_of, plates_for, ways_on

TOOL = shipped_cell("default").tool
TOWARDS: Vector3 = (-1.0, 0.0, 0.0)

edges = st.floats(0.08, 0.6)
sizes = st.tuples(edges, edges, edges)
masses = st.floats(0.5, 15.0)
yaws = st.floats(-math.pi, math.pi)


def ways(size: Vector3, mass: float, yaw: float = 0.0) -> tuple[Grasp, ...]:
    """The grasps of a box that stands before the robot."""
    return grasps(OrientedBox.upright((1.6, 0.2, 0.9), size, yaw), mass, TOOL, TOWARDS)


def cups_in_box(grasp: Grasp) -> list[tuple[Vector3, Vector3]]:
    """Centre and direction of every cup that is switched on, in the box's frame."""
    out = []
    for name, index in grasp.cups:
        module = TOOL.module(name, folded=grasp.folded)
        pose = grasp.box_from_flange @ module.flange_from_face
        y, z = module.cups[index]
        normal = np.array(pose.rotation)[:, 0]
        out.append((pose.apply((0.0, y, z)), (normal[0], normal[1], normal[2])))
    return out


@given(sizes, masses, yaws)
def test_every_cup_lies_wholly_on_one_face_and_looks_into_it(
    size: Vector3, mass: float, yaw: float
) -> None:
    """Its outline stays 5 mm inside the edges; it touches, and does not reach in."""
    for grasp in ways(size, mass, yaw):
        for centre, normal in cups_in_box(grasp):
            axis = int(np.argmax(np.abs(normal)))
            assert abs(normal[axis]) == pytest.approx(1.0, abs=1e-9)
            assert centre[axis] == pytest.approx(-normal[axis] * size[axis] / 2, abs=1e-9)
            for other in {0, 1, 2} - {axis}:
                assert abs(centre[other]) + 0.035 <= size[other] / 2 + 1e-8


@given(sizes, masses)
def test_cups_are_in_a_row_where_no_three_of_them_span_an_area(size: Vector3, mass: float) -> None:
    """One and two always are."""
    for grasp in ways(size, mass):
        centres = [np.array(centre) for centre, _ in cups_in_box(grasp)]
        areas = [
            np.linalg.norm(np.cross(b - a, c - a)) for a, b, c in itertools.combinations(centres, 3)
        ]
        assert in_a_row(grasp, TOOL) == (max(areas, default=0.0) < 1e-6)


@given(sizes, masses, yaws)
def test_horizontal_grasps_touch_the_side_that_faces_the_robot_and_vertical_ones_the_top(
    size: Vector3, mass: float, yaw: float
) -> None:
    """The cups look away from the robot, or down."""
    box = OrientedBox.upright((1.6, 0.2, 0.9), size, yaw)
    for grasp in grasps(box, mass, TOOL, TOWARDS):
        turn = np.array(box.pose.rotation)
        for _, normal in cups_in_box(grasp):
            into = turn @ np.array(normal)
            if grasp.approach is Approach.VERTICAL:
                assert into[2] == pytest.approx(-1.0)
            else:
                assert into[0] >= math.cos(math.radians(45)) - 1e-9
                assert abs(into[2]) < 1e-9


@settings(max_examples=25)
@given(sizes, masses)
def test_what_is_offered_holds_the_box_at_rest(size: Vector3, mass: float) -> None:
    """With the planner's safety and something to move with."""
    for grasp in ways(size, mass):
        assert static_share(grasp, mass, TOOL) <= 0.95


@settings(max_examples=25)
@given(sizes, masses)
def test_the_list_is_short_and_holds_nothing_twice(size: Vector3, mass: float) -> None:
    """At most 24 ways, each another one, from cups that exist."""
    found = ways(size, mass)
    assert len(found) <= 24
    assert len({(grasp.cups, grasp.folded, grasp.box_from_flange) for grasp in found}) == len(found)
    for grasp in found:
        assert len(set(grasp.cups)) == len(grasp.cups) > 0
        names = {name for name, _ in grasp.cups}
        if grasp.approach is Approach.VERTICAL:
            assert names == {LOWER}
            assert not grasp.folded
        else:
            assert grasp.folded or names == {FRONT}


@settings(max_examples=25)
@given(sizes, st.floats(0.5, 6.0), st.floats(1.05, 2.0))
def test_a_lighter_box_is_held_in_every_way_that_a_heavier_one_is(
    size: Vector3, mass: float, factor: float
) -> None:
    """The share of what is counted on grows with the mass."""
    for grasp in ways(size, mass * factor):
        assert static_share(grasp, mass, TOOL) <= static_share(grasp, mass * factor, TOOL)


@settings(max_examples=25)
@given(sizes, masses)
def test_a_box_turned_by_half_looks_the_same(size: Vector3, mass: float) -> None:
    """As many ways, with the same cups, in the same order."""
    here, turned = ways(size, mass), ways(size, mass, math.pi)
    assert [way.cups for way in here] == [way.cups for way in turned]


@settings(max_examples=10)
@given(sizes, masses)
def test_the_share_that_orders_the_ways_is_that_of_their_grasps(size: Vector3, mass: float) -> None:
    """The short way to it and the long one agree."""
    box = OrientedBox.upright((1.6, 0.2, 0.9), size)
    for face in faces_of(box, TOWARDS):
        for plate in plates_for(TOOL, face.approach):
            for way in ways_on(face, plate, TOOL):
                share = static_share(way.grasp(), mass, TOOL)
                assert share_of(way, mass, TOOL, {}) == pytest.approx(share, rel=1e-9)


def test_an_ordinary_box_is_held_first_by_the_whole_plate_unturned() -> None:
    """In the middle of its face, both ways."""
    found = ways((0.4, 0.4, 0.3), 5.0)
    for approach in Approach:
        first = next(grasp for grasp in found if grasp.approach is approach)
        assert len(first.cups) == 6
        assert not first.folded
        points = np.array([centre for centre, _ in cups_in_box(first)])
        middle = points.mean(axis=0)
        outward = int(np.argmax(np.abs(middle)))
        assert np.delete(middle, outward) == pytest.approx([0.0, 0.0], abs=1e-9)
        x_of_flange = np.array(first.box_from_flange.rotation)[:, 0]
        assert x_of_flange == pytest.approx([1.0, 0.0, 0.0], abs=1e-9)
        z_of_flange = np.array(first.box_from_flange.rotation)[:, 2]
        assert z_of_flange == pytest.approx([0.0, 0.0, 1.0], abs=1e-9)


def test_every_roll_of_the_tool_is_among_the_ways() -> None:
    """Four in front, four on top: where one does not reach another may."""
    found = ways((0.4, 0.4, 0.3), 5.0)
    for approach in Approach:
        turns = {
            tuple(np.round(np.array(grasp.box_from_flange.rotation), 6).ravel().tolist())
            for grasp in found
            if grasp.approach is approach
        }
        assert len(turns) == 4


def test_a_face_8_cm_high_takes_one_row_of_cups() -> None:
    """With the plate shifted up or down by half a pitch."""
    horizontal = [way for way in ways((0.2, 0.3, 0.08), 1.0) if way.approach is Approach.HORIZONTAL]
    assert len(horizontal[0].cups) == 3
    heights = {round(centre[2], 9) for centre, _ in cups_in_box(horizontal[0])}
    assert heights == {0.0}
    plates = {round(abs(way.box_from_flange.translation[2]), 6) for way in horizontal}
    assert 0.05 in plates


def test_a_deep_heavy_box_takes_both_modules() -> None:
    """Its weight would peel the upper cups of one module off."""
    deep = [way for way in ways((0.6, 0.4, 0.5), 9.0) if way.approach is Approach.HORIZONTAL]
    assert deep
    assert all(way.folded for way in deep)
    assert len(deep[0].cups) == 12


@pytest.mark.parametrize(
    ("size", "mass", "words"),
    [
        ((0.4, 0.3, 0.3), 43.0, "43 kg is more than the arm carries beside its tool (42 kg)"),
        ((0.06, 0.06, 0.3), 1.0, "no side is wide enough for a cup of 70 mm with its rim"),
        ((0.4, 0.3, 0.3), 40.0, "40 kg is more than the cups hold on its sides with safety 2"),
        ((0.4, 0.3, 0.3), 8.0, ""),
    ],
)
def test_a_box_that_cannot_be_held_is_refused_in_words(
    size: Vector3, mass: float, words: str
) -> None:
    """The arm's payload, the cups' size, the cups' force."""
    assert refusal(size, mass, TOOL, 60.0) == words


@settings(max_examples=25)
@given(sizes, st.floats(0.5, 50.0))
def test_what_is_refused_has_no_grasp_and_what_is_not_has_one(size: Vector3, mass: float) -> None:
    """In any of the ways that it may stand, turned about the vertical."""
    turned = (size, (size[1], size[0], size[2]))
    held = any(ways(one, mass) for one in turned)
    assert (refusal(size, mass, TOOL, 60.0) == "") == (held and mass <= 42.0)


def test_case_sizes_of_deliveries_are_held_from_both_sides() -> None:
    """Edges of 8 to 51 cm, up to 10.6 kg at a density of a third of water's."""
    for size in itertools.product((0.08, 0.13, 0.2, 0.3, 0.4), repeat=3):
        mass = min(10.6, 330 * size[0] * size[1] * size[2])
        if sorted(size)[1] < 0.13:
            continue
        assert ways(size, mass), size
