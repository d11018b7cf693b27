"""What tasks ask of motions and choices: tilt, zones, the margin of the pile that a box leaves."""

import math
from collections.abc import Callable
from dataclasses import dataclass, field, replace

import cells_at_work
import numpy as np
import pytest
from cells_at_work import ASIDE, DECK, PERSON, STORED, Cell, gtin, name
from hypothesis import given
from hypothesis import strategies as st

from depal.cell.controller import Controller
from depal.cell.files import shipped_cell
from depal.cell.rules import LEAVING, NO_RULES, Rules, rules_on
from depal.cell.tasks import read_shipped_tasks
from depal.cell.workplace import Held
from depal.domain import (
    EURO_PALLET,
    Delivery,
    DeliveryLine,
    Joints,
    Perceived,
    Product,
    Recognition,
    Zone,
)
from depal.errors import TaskError
from depal.executive import events as ev
from depal.executive.engine import Call, Engine
from depal.executive.language import format_repository, parse
from depal.executive.schema import Repository
from depal.geometry import OrientedBox, Pose, Vector3
from depal.motion.collision import Body, Checker, Hand, Margins, Scene, held_box
from depal.motion.kinematics import Kinematics
from depal.ports import Guard, Trajectory
from depal.ports.fakes import FakeArm, FakeOverride, FakeReader

FACTS = "fact cell.tilt : number?\nfact cell.shut : text?\nfact cell.firm : number?\n"

ERROR = 0.1
"""So much more may a box lean between two checks [deg]."""

WALL = Zone("wall", OrientedBox(Pose((1.1, 0.6, 1.1)), (0.7, 0.1, 2.2)))
"""Between the pallet and the trolleys on the left: there is a way round."""

FRONT = Zone("front", OrientedBox(Pose((0.0, 1.45, 1.0)), (3.0, 0.3, 2.0)))
"""All along the trolleys on the left: there is none."""


def tasks_with(clauses: str) -> Repository:
    """The shipped tasks; whatever moves a box is bound by some clauses more."""
    text = format_repository(read_shipped_tasks())
    return parse(FACTS + text.replace("limit speed cell.speed", f"limit speed cell.speed{clauses}"))


@dataclass(slots=True)
class Watched:
    """An arm that remembers what hung on it in every motion.

    Attributes:
        arm: that moves.
        carried: what hung on it when a motion began, and the motion.
        hear: told the number of each motion with a box, from 1 on, when it begins.
    """

    arm: FakeArm
    carried: list[tuple[Held | None, Trajectory]] = field(default_factory=list)
    hear: Callable[[int], None] = lambda _: None
    held: Callable[[], Held | None] = lambda: None

    def joints(self) -> Joints:
        """Where the axes are [rad]."""
        return self.arm.joints()

    def load(self) -> float:
        """What hangs on the flange [kg]."""
        return self.arm.load()

    async def follow(self, trajectory: Trajectory, guard: Guard | None = None) -> str | None:
        """Moves."""
        self.carried.append((self.held(), trajectory))
        if self.held() is not None:
            self.hear(sum(held is not None for held, _ in self.carried))
        return await self.arm.follow(trajectory, guard)


def made(monkeypatch: pytest.MonkeyPatch, cell: Cell, clauses: str) -> Watched:
    """A cell whose tasks have some clauses more; its arm is watched."""
    monkeypatch.setattr(cells_at_work, "read_shipped_tasks", lambda: tasks_with(clauses))
    watched = Watched(cell.arm, held=lambda: cell.work.held)
    cell.work.ports = replace(cell.work.ports, arm=watched)
    return watched


def leans(watched: Watched) -> list[float]:
    """How far a held box leans at the most in each motion [deg]."""
    kinematics = Kinematics(shipped_cell("default").robot)
    found = []
    for held, motion in watched.carried:
        if held is None:
            continue
        up = np.array(held.grasp.box_from_flange.rotation)[2]
        times = np.arange(0.0, motion.duration, 0.01)
        rise = [(kinematics.frames(motion.at(t)[0])[6][:, :3] @ up)[2] for t in times]
        found.append(math.degrees(math.acos(min(1.0, min(rise, default=1.0)))))
    return found


def enters(cell: Cell, watched: Watched, zone: Zone) -> list[bool]:
    """Whether arm, tool or held box are in a zone in each motion."""
    body, tool = Body.of(cell.layout), cell.layout.tool
    scene, bare = Scene.of([], []).with_zones([zone]), Margins(0.0, 0.0, 0.0, 0.0, 0.0)
    found = []
    for held, motion in watched.carried:
        solid = None if held is None else held_box(held.grasp, held.size)
        folded = held is not None and held.grasp.folded
        checker = Checker(body, Hand.of(tool, folded=folded, held=solid), scene, bare)
        times = np.arange(0.0, motion.duration, 0.01)
        found.append(any(not checker.free(motion.at(t)[0]) for t in times))
    return found


def ended(cell: Cell, outcome: ev.Outcome) -> list[str]:
    """The reasons of attempts that ended so."""
    return [e.reason for e in cell.events if isinstance(e, ev.Ended) and e.outcome is outcome]


# Tilt


@pytest.mark.parametrize("degrees", [10, 3])
def test_a_held_box_leans_no_further_than_its_task_allows(
    monkeypatch: pytest.MonkeyPatch, degrees: int
) -> None:
    """On the way to the reader and to its place; with the shipped tasks it leans further."""
    cell, usual = Cell(4, unknown=(2,)), Cell(4, unknown=(2,))
    watched = made(monkeypatch, cell, f", tilt {degrees} deg")
    cell.works().assert_whole()
    assert list(cell.fates.values()) == [STORED, STORED, STORED, ASIDE]
    assert max(leans(watched)) <= degrees + ERROR
    freely = made(monkeypatch, usual, "")
    usual.works()
    assert max(leans(freely)) > degrees


def test_a_limit_that_becomes_tighter_breaks_a_motion_off_and_it_is_planned_anew(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """That is no failure; from then on the box leans less."""
    cell = Cell(1, unknown=(1,), reader=FakeReader([(gtin(1),)]))
    watched = made(monkeypatch, cell, ", tilt cell.tilt")

    def tighten(number: int) -> None:
        if number == 2:
            cell.work.tell([("cell.tilt", math.radians(4.0))], "person")

    watched.hear = tighten
    cell.works().assert_whole()
    assert cell.fates == {"b1": STORED}
    assert any("lean less" in reason for reason in ended(cell, ev.Outcome.CANCELLED))
    assert ended(cell, ev.Outcome.FAILED) == []
    assert max(leans(watched)[3:]) <= 4.0 + ERROR


def test_a_fact_that_is_empty_limits_nothing(monkeypatch: pytest.MonkeyPatch) -> None:
    """The run is the same to the byte of its motions."""
    cell, usual = Cell(2), Cell(2)
    told = made(monkeypatch, cell, ", tilt cell.tilt, margin at least cell.firm avoids cell.shut")
    cell.works()
    plain = made(monkeypatch, usual, "")
    usual.works()
    assert [m.positions.tobytes() for _, m in told.carried] == [
        m.positions.tobytes() for _, m in plain.carried
    ]


# Zones


def zoned(zone: Zone, boxes: int = 2) -> Cell:
    """A cell with a zone."""
    layout = replace(shipped_cell("default"), zones=(zone,))
    return Cell(boxes, layout=layout)


def test_the_way_round_a_zone_is_taken(monkeypatch: pytest.MonkeyPatch) -> None:
    """Arm, tool and held box keep out of it; a cell whose tasks do not avoid it goes through."""
    cell, usual = zoned(WALL), zoned(WALL)
    watched = made(monkeypatch, cell, " avoids wall")
    cell.works().assert_whole()
    assert set(cell.fates.values()) == {STORED}
    assert not any(enters(cell, watched, WALL))
    freely = made(monkeypatch, usual, "")
    usual.works()
    assert any(enters(usual, freely, WALL))


def test_where_there_is_no_way_round_the_reason_names_the_zone(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """The box goes aside, and the other one where it belongs."""
    cell = zoned(FRONT)
    watched = made(monkeypatch, cell, " avoids front")
    cell.works().assert_whole()
    assert cell.fates == {"b1": STORED, "b2": ASIDE}
    assert not any(enters(cell, watched, FRONT))
    assert any("zone front" in reason for reason in ended(cell, ev.Outcome.FAILED))


def test_an_arm_that_stands_in_a_zone_begins_nothing_and_says_so(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """A person takes the box off, and reads why."""
    zone = Zone("left", OrientedBox(Pose((0.6, 1.1, 1.2)), (0.6, 0.3, 2.4)))
    cell = zoned(zone, 1)
    watched = made(monkeypatch, cell, " avoids left")
    cell.works().assert_whole()
    assert cell.fates == {"b1": PERSON}
    assert watched.carried == []
    assert "against zone left, where it stands" in cell.person.asked[0].text


def test_a_zone_that_is_closed_meanwhile_breaks_a_motion_off(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """The kept plan of the carry led through it; the way round is planned."""
    cell = zoned(WALL)
    watched = made(monkeypatch, cell, " avoids cell.shut")
    moved: list[int] = []

    def shut(number: int) -> None:
        if number == 3:
            moved.append(len(watched.carried))
            cell.work.tell([("cell.shut", "wall")], "person")

    watched.hear = shut
    cell.works().assert_whole()
    assert set(cell.fates.values()) == {STORED}
    assert moved
    assert not any(enters(cell, watched, WALL)[moved[0] :])


def test_a_zone_that_the_cell_does_not_have_lets_nothing_move(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """Told by a fact, it cannot be refused before: it might be anywhere."""
    cell = zoned(WALL, 1)
    watched = made(monkeypatch, cell, " avoids cell.shut")
    begin = Controller.begin

    def shut(self: Controller) -> None:
        self.work.tell([("cell.shut", "aisle")], "person")
        begin(self)

    monkeypatch.setattr(Controller, "begin", shut)
    cell.works().assert_whole()
    assert watched.carried == []
    assert "zone aisle, which the cell does not have" in cell.person.asked[0].text


@pytest.mark.parametrize(
    ("zones", "said"),
    [((WALL, FRONT), "did you mean 'wall'"), ((), "its file names none")],
)
def test_a_cell_refuses_tasks_that_avoid_a_zone_it_does_not_have(
    monkeypatch: pytest.MonkeyPatch, zones: tuple[Zone, ...], said: str
) -> None:
    """Before anything moves; the message says which exist."""
    layout = replace(shipped_cell("default"), zones=zones)
    cell = Cell(1, layout=layout)
    made(monkeypatch, cell, " avoids walls")
    with pytest.raises(TaskError, match=said) as refused:
        cell.works()
    assert "the cell has no zone 'walls'" in str(refused.value)


# Margin

LEVER: tuple[tuple[Vector3, Vector3, float], ...] = (
    ((1.55, -0.325, 0.15), (0.30, 0.35, 0.30), 8.0),
    ((1.55, -0.175, 0.375), (0.30, 0.65, 0.15), 4.0),
    ((1.55, -0.4, 0.55), (0.20, 0.20, 0.20), 6.0),
    ((1.55, 0.05, 0.55), (0.20, 0.20, 0.20), 4.0),
)
"""Middles [m], sizes [m] and masses [kg]: the third box holds the second one down, the fourth one
pulls it over."""


def lever() -> Cell:
    """A cell with that pile."""
    cell, boxes, lines = Cell(4), list[Perceived](), list[DeliveryLine]()
    for number, ((x, y, z), size, mass) in enumerate(LEVER, start=1):
        shape = OrientedBox.upright((x, y, DECK + z), size)
        boxes.append(Recognition(name(number), shape, gtin(number)))
        depth, width, height = size
        product = Product(gtin(number), f"product {number}", (width, depth, height), mass)
        lines.append(DeliveryLine(product, 1))
    cell.sight.script = [tuple(boxes)]
    cell.work.delivery = Delivery("lever", EURO_PALLET, tuple(lines))
    cell.gripper.weight = 5.0
    return cell


def test_a_box_that_would_leave_too_little_margin_stays(monkeypatch: pytest.MonkeyPatch) -> None:
    """The counterweight goes after what it holds up; without the limit it goes first."""
    cell, usual = lever(), lever()
    made(monkeypatch, cell, ", margin at least 0.03 g")
    cell.works().assert_whole()
    assert list(cell.fates) == ["b4", "b3", "b2", "b1"]
    made(monkeypatch, usual, "")
    usual.works()
    assert next(iter(usual.fates)) == "b3"


def test_where_every_box_would_leave_too_little_a_person_takes_one(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """Unlike the guard a limit never relents; the person reads why."""
    cell = lever()
    made(monkeypatch, cell, ", margin at least 2 g")
    cell.works().assert_whole()
    assert PERSON in cell.fates.values()
    assert "its task asks for at least 2 g" in cell.person.asked[0].text


def test_a_box_that_was_chosen_before_is_refused_before_it_is_touched(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """The fact that tells the margin has risen meanwhile."""
    cell = lever()
    watched = made(monkeypatch, cell, ", margin at least cell.firm")

    def rise(number: int) -> None:
        if number == 3:
            cell.work.tell([("cell.firm", 2.0)], "person")

    watched.hear = rise
    cell.works().assert_whole()
    assert any("asks for at least 2 g" in reason for reason in ended(cell, ev.Outcome.FAILED))


# What binds


RULES = st.builds(
    Rules, st.floats(0.01, 1.0), st.frozensets(st.sampled_from(["wall", "front", "aisle"]))
)


@given(RULES, RULES, RULES)
def test_rules_cover_others_as_sets_contain_sets(a: Rules, b: Rules, c: Rules) -> None:
    """A partial order; what keeps to anything keeps to no rules."""
    assert a.cover(a)
    assert a.cover(NO_RULES)
    assert not (a.cover(b) and b.cover(a)) or a == b
    assert a.cover(c) or not (a.cover(b) and b.cover(c))


def test_what_binds_a_box_is_known_before_its_store_is_allocated_and_after() -> None:
    """A task above it may bind it further; one that was withdrawn binds nothing."""
    text = (
        format_repository(tasks_with(", tilt 10 deg avoids wall"))
        + "\ntask gently(Box) until Box.stored limit tilt 2 deg avoids front\n  - store(Box)\n"
    )
    engine, box = Engine(parse(text)), name(1)
    ahead = Rules(math.radians(10), frozenset({"wall"}))
    assert rules_on(None, box, LEAVING) == NO_RULES
    assert rules_on(engine, box, LEAVING) == ahead
    engine.allocate([Call("gently", (box,))], 0.0)
    assert rules_on(engine, box, LEAVING) == Rules(math.radians(2), frozenset({"wall", "front"}))
    assert rules_on(engine, name(2), LEAVING) == ahead
    engine.withdraw(1, "not wanted", 1.0)
    assert rules_on(engine, box, LEAVING) == ahead


def test_the_shipped_tasks_bind_no_motion() -> None:
    """They behave as ever."""
    assert rules_on(Engine(read_shipped_tasks()), name(1), LEAVING) == NO_RULES
    assert isinstance(Cell(1).work.ports.override, FakeOverride)
