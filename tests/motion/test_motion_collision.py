"""Collision checks never miss what MuJoCo finds, and are not much stricter than it."""

import math
from itertools import pairwise

import numpy as np
import numpy.typing as npt
import pytest
from hypothesis import given
from hypothesis import strategies as st

from depal.cell.files import shipped_cell
from depal.domain import CellLayout
from depal.geometry import OrientedBox, Pose
from depal.logistics import read_delivery
from depal.motion.collision import Body, Checker, Hand, Margins, Scene, Upright, fixed_solids
from depal.motion.kinematics import Kinematics
from depal.studies.bench.planning_referee import Referee
from depal.studies.real import perceived_stack

Floats = npt.NDArray[np.float64]

TOUCHING = Margins(0.0, 0.0, 0.0, 0.0, 0.0)
DEEP = 1e-6
HELD = OrientedBox(Pose((0.37, 0.02, -0.03)), (0.34, 0.27, 0.22))
HANGING = OrientedBox(Pose((0.12, -0.01, -0.34)), (0.30, 0.40, 0.28))


@pytest.fixture(scope="module")
def layout() -> CellLayout:
    """The paper's cell."""
    return shipped_cell("default")


@pytest.fixture(scope="module")
def solids(layout: CellLayout) -> list[tuple[str, OrientedBox]]:
    """Its storages, fixtures and a real delivery's stack."""
    return fixed_solids(layout)


@pytest.fixture(scope="module")
def cases() -> list[tuple[str, OrientedBox]]:
    """A real delivery's stack."""
    return [(str(box.id), box.shape) for box in perceived_stack(read_delivery("dev-018"))]


def random_postures(kinematics: Kinematics, count: int, seed: int) -> Floats:
    """Half of them anywhere, half with the flange near the pallet or in front of a storage."""
    rng = np.random.default_rng(seed)
    anywhere = rng.uniform(kinematics.lower, kinematics.upper, (count // 2, 6))
    near: list[Floats] = []
    while len(near) < count - count // 2:
        heading = rng.uniform(-math.pi, math.pi)
        pitch, roll = rng.normal(0.0, 0.3), rng.choice([0, 1, 2, 3]) * math.pi / 2
        yaw = heading + rng.normal(0.0, 0.4)
        turn = (
            np.array(Pose.from_yaw((0, 0, 0), yaw).rotation)
            @ np.array(
                [
                    [math.cos(pitch), 0, -math.sin(pitch)],
                    [0, 1, 0],
                    [math.sin(pitch), 0, math.cos(pitch)],
                ]
            )
            @ np.array(
                [
                    [1, 0, 0],
                    [0, math.cos(roll), -math.sin(roll)],
                    [0, math.sin(roll), math.cos(roll)],
                ]
            )
        )
        out, up = rng.uniform(1.0, 1.7), rng.uniform(0.2, 1.9)
        at = (out * math.cos(heading), out * math.sin(heading), up)
        near += list(kinematics.solve(Pose.from_arrays(at, turn)))
    return np.concatenate((anywhere, np.array(near[: count - count // 2])))


Variant = tuple[OrientedBox | None, bool]


def missed_and_refused(
    layout: CellLayout, scene: Scene, boxes: list[OrientedBox], variant: Variant, postures: Floats
) -> tuple[list[Floats], int, int]:
    """Postures whose contact was missed; how many were refused for nothing; how many touch."""
    held, folded = variant
    hand = Hand.of(layout.tool, folded=folded, held=held)
    checker = Checker(Body.of(layout), hand, scene, TOUCHING)
    referee = Referee(layout, boxes, held, folded=folded)
    missed, refused, touching = [], 0, 0
    for q in postures:
        deep, free = referee.nearest(q) < -DEEP, checker.free(q)
        touching += deep
        if deep and free:
            missed.append(q)
        refused += not deep and not free and "fence" not in checker.why(q)
    return missed, refused, touching


VARIANTS: list[Variant] = [
    (None, False),
    (None, True),
    (HELD, False),
    (HELD, True),
    (HANGING, False),
]


@pytest.mark.parametrize("variant", VARIANTS)
def test_no_contact_is_missed_and_few_postures_are_refused_for_nothing(
    layout: CellLayout,
    solids: list[tuple[str, OrientedBox]],
    cases: list[tuple[str, OrientedBox]],
    variant: Variant,
) -> None:
    """Against MuJoCo's own detection, all margins zero."""
    count = 300
    postures = random_postures(Kinematics(layout.robot), count, seed=7)
    scene, boxes = Scene.of(solids, cases), [box for _, box in solids + cases]
    missed, refused, touching = missed_and_refused(layout, scene, boxes, variant, postures)
    assert not missed
    assert touching > 0.15 * count
    assert refused < 0.05 * count


@pytest.mark.slow
def test_no_contact_is_missed_in_ten_thousand_postures(
    layout: CellLayout, solids: list[tuple[str, OrientedBox]], cases: list[tuple[str, OrientedBox]]
) -> None:
    """The figure of the issue."""
    scene, boxes = Scene.of(solids, cases), [box for _, box in solids + cases]
    for seed, variant in enumerate(VARIANTS):
        postures = random_postures(Kinematics(layout.robot), 2000, seed)
        missed, _, _ = missed_and_refused(layout, scene, boxes, variant, postures)
        assert not missed


@pytest.mark.parametrize("apart", [0.01, 0.05])
def test_what_is_free_with_a_margin_is_that_far_from_everything(
    layout: CellLayout,
    solids: list[tuple[str, OrientedBox]],
    cases: list[tuple[str, OrientedBox]],
    apart: float,
) -> None:
    """A margin is a distance."""
    scene, boxes = Scene.of(solids, cases), [box for _, box in solids + cases]
    margins = Margins(apart, apart, apart, apart, apart)
    checker = Checker(Body.of(layout), Hand.of(layout.tool, held=HELD), scene, margins)
    referee = Referee(layout, boxes, HELD)
    referee.keep_apart(apart)
    for q in random_postures(Kinematics(layout.robot), 400, seed=3):
        if checker.free(q):
            assert referee.nearest(q) > apart - DEEP


def test_a_free_edge_is_free_between_its_steps(
    layout: CellLayout, solids: list[tuple[str, OrientedBox]], cases: list[tuple[str, OrientedBox]]
) -> None:
    """Steps of 2 cm with the usual margins against MuJoCo at every half millimetre or so."""
    scene, boxes = Scene.of(solids, cases), [box for _, box in solids + cases]
    checker = Checker(Body.of(layout), Hand.of(layout.tool, held=HELD), scene, Margins())
    referee = Referee(layout, boxes, HELD)
    postures = [
        q for q in random_postures(Kinematics(layout.robot), 600, seed=5) if checker.free(q)
    ]
    edges = [(a, b) for a, b in pairwise(postures) if checker.edge_free(a, a + 0.2 * (b - a))]
    assert len(edges) > 30
    for a, b in edges[:60]:
        for u in np.linspace(0.0, 0.2, 300):
            assert referee.nearest(a + u * (b - a)) > -DEEP


def test_reasons_name_what_touches_what(
    layout: CellLayout, solids: list[tuple[str, OrientedBox]], cases: list[tuple[str, OrientedBox]]
) -> None:
    """Words for people."""
    scene = Scene.of(solids, cases)
    body = Body.of(layout)
    parked = np.array(layout.robot.parked)
    empty = Checker(body, Hand.of(layout.tool), scene, Margins())
    assert empty.why(parked) == ""
    assert empty.why_along(np.stack((parked, parked))) == ""
    down = np.radians((0.0, -10.0, 90.0, 0.0, 0.0, 0.0))
    assert empty.why(down) == "the tool at the floor"
    assert empty.why_along(np.stack((parked, down))) == "the tool at the floor"
    back = body.kinematics.solve(Pose.from_yaw((-1.6, 0.0, 1.0), math.pi))[0]
    assert empty.why(back) == "the tool against shelf"
    folded_back = np.radians((0.0, -90.0, 60.0, 0.0, 118.0, 0.0))
    assert empty.why(folded_back) == "the tool against link 4"
    holding = Checker(
        body, Hand.of(layout.tool, held=HELD), scene, Margins(), Upright((0.0, 0.0, 1.0), 0.4)
    )
    level = np.radians((0.0, -95.0, 110.0, 0.0, -15.0, 0.0))
    assert holding.why(level) == ""
    leaning = level.copy()
    leaning[4] += 0.5
    assert holding.why(leaning) == "the held box leans too far"
    near_pile = body.kinematics.solve(Pose((1.15, 0.2, 0.7)))[0]
    assert holding.why(near_pile).startswith("the held box against b")
    outside = body.kinematics.solve(Pose((2.05, 0.0, 1.0)))[0]
    assert (
        Checker(body, Hand.of(layout.tool, held=HELD), Scene.of([], []), Margins()).why(outside)
        == "the held box at the fence"
    )


def test_a_scene_without_a_case_lets_the_arm_through_and_with_it_does_not(
    layout: CellLayout,
) -> None:
    """Scenes are values."""
    body, q = Body.of(layout), np.radians((0.0, -60.0, 75.0, 0.0, -15.0, 0.0))
    ahead = OrientedBox(body.kinematics.flange(q) @ Pose((0.3, 0.0, 0.0)), (0.2, 0.2, 0.2))
    bare = Scene.of([], [])
    full = bare.with_case("crate", ahead)
    hand = Hand.of(layout.tool)
    assert Checker(body, hand, bare, Margins()).free(q)
    assert Checker(body, hand, full, Margins(tool=0.04)).why(q) == "the tool against crate"
    assert Checker(body, hand, full.without("crate"), Margins(tool=0.04)).free(q)


@given(st.floats(-0.011, 0.011), st.floats(-0.0015, 0.0015))
def test_a_held_box_may_rub_along_cases_by_the_margin_and_no_deeper(
    gap: float, turn: float
) -> None:
    """A negative margin for cases; the cell's own solids keep theirs."""
    layout = shipped_cell("default")
    body, q = Body.of(layout), np.radians((0.0, -75.0, 85.0, 0.0, -10.0, 0.0))
    held = OrientedBox(Pose((0.36, 0.0, 0.0)), (0.30, 0.30, 0.30))
    beside = Pose.from_yaw((0.36, 0.30 + gap, 0.0), turn)
    neighbour = OrientedBox(body.kinematics.flange(q) @ beside, (0.30, 0.30, 0.30))
    hand, rubbing = Hand.of(layout.tool, held=held), Margins(pile=-0.005, held=0.0)
    case = Scene.of([], [("crate", neighbour)])
    wall = Scene.of([("wall", neighbour)], [])
    slack = 0.3 * abs(turn)
    if gap < -0.005 - slack:
        assert not Checker(body, hand, case, rubbing).free(q)
    if gap > -0.005 + slack:
        assert Checker(body, hand, case, rubbing).free(q)
    if gap < -slack:
        assert not Checker(body, hand, wall, rubbing).free(q)


@given(st.floats(-0.009, 0.02), st.floats(0.0, 0.012))
def test_a_careful_box_reaches_no_deeper_than_it_seems_to(gap: float, deeper: float) -> None:
    """Touching boxes seem to overlap by the errors of their poses; more than that is a push."""
    layout = shipped_cell("default")
    body, q = Body.of(layout), np.radians((0.0, -75.0, 85.0, 0.0, -10.0, 0.0))
    held = OrientedBox(Pose((0.36, 0.0, 0.0)), (0.30, 0.30, 0.30))
    flange = body.kinematics.flange(q)
    seen = OrientedBox(flange @ Pose((0.36, 0.30 + gap, 0.0)), (0.30, 0.30, 0.30))
    pushed = OrientedBox(flange @ Pose((0.36, 0.30 + gap - deeper, 0.0)), (0.30, 0.30, 0.30))
    hand, margins = Hand.of(layout.tool, held=held), Margins(pile=-0.012, held=0.0)

    def careful(box: OrientedBox) -> Checker:
        return Checker(body, hand, Scene.of([], [("crate", box)]), margins)

    rubbing = careful(seen).rubbing(q, 0.003)
    assert rubbing.free(q)
    depth = max(0.0, -gap)
    there = Checker(
        body,
        hand,
        Scene.of([], [("crate", pushed)]),
        margins,
        rubbed=np.array([min(depth + 0.003, 0.012)]),
    )
    if deeper - max(0.0, gap) > 0.0045:
        assert not there.free(q)
