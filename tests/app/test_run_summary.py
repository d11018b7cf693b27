"""What a run is summed up as: the contract of `depal run --json`, and the referee's word."""

import json
from collections.abc import Mapping

import pytest
from hypothesis import given
from hypothesis import strategies as st

from depal.app.run.summary import Left, Outcome, disagreements, run_report
from depal.cell.departures import Departure, Fate
from depal.cell.questions import Asked
from depal.cell.timekeeping import ORDER, REST, WAITING
from depal.cell.wishes import Wish
from depal.domain import Approach, BoxId, Gtin, PlaceId, Request
from depal.ports import Question
from depal.simulation.contacts import Collision
from depal.simulation.referee import FLOOR, HAND, PALLET, REMOVED, Summary

HIT = Collision(3.5, "tool", "box 2", 61.0, held=False, allowed=False)

CONTRACT = {
    "delivery": str,
    "boxes": int,
    "stored": int,
    "lost": int,
    "collisions": int,
    "exceptions": list,
    "sequence": list,
    "requests": list,
    "questions": list,
    "sim_seconds": float,
    "waiting_seconds": float,
    "wall_seconds": float,
    "boxes_per_hour": float,
    "perception": str,
    "policy": str,
    "w": float,
    "seed": int,
    "events_sha256": str,
}
"""What `depal run --json` has at least, and of which kind."""


def departure(number: int, fate: Fate, reason: str = "") -> Departure:
    """A box of the stack that left."""
    held = fate is not Fate.BY_PERSON
    standing = fate in {Fate.STORED, Fate.SET_ASIDE}
    return Departure(
        BoxId(f"b{number}"),
        Gtin(f"g{number}") if held else None,
        Approach.VERTICAL if held else None,
        PlaceId("trolley_1/level_1") if standing else None,
        fate,
        "" if fate is Fate.STORED else reason or "a reason",
        float(number),
    )


def outcome(
    *departures: Departure,
    left: tuple[Left, ...] = (),
    collisions: tuple[Collision, ...] = (),
    differs: tuple[str, ...] = (),
    wishes: tuple[Wish, ...] = (),
    waiting: float = 20.0,
) -> Outcome:
    """A run of 100 s."""
    shares = {**dict.fromkeys([*ORDER, REST], 0.0), "arm motion": 80.0, WAITING: waiting}
    question = Question("take/b1", "Please take b1.", ("taken",), "b1")
    return Outcome(
        delivery="tiny",
        boxes=len(departures) + len(left),
        stack={d.box: int(d.box[1:]) - 1 for d in departures},
        departures=departures,
        left=left,
        wishes=wishes,
        questions=(Asked(question, 1.0, "taken", 21.0),),
        referee=Summary({"trolley_1/level_1": 1}, collisions, 12.0, (), (), ()),
        differences=(),
        disagreements=differs,
        sim_seconds=100.0,
        waiting_seconds=waiting,
        wall_seconds=2.5,
        shares=shares,
        plan_seconds=(0.01, 0.02),
        policy="paper",
        w=0.5,
        seed=3,
        speed=1.0,
        events_sha256="0" * 64,
    )


fates = st.lists(st.sampled_from([*Fate, None]), max_size=12)


@given(fates)
def test_every_box_is_stored_an_exception_or_lost(ended: list[Fate | None]) -> None:
    """And counted once; whole is what has no loss."""
    departures = [departure(n, fate) for n, fate in enumerate(ended, start=1) if fate is not None]
    left = [Left(BoxId(f"b{n}"), "out of reach") for n, f in enumerate(ended, start=1) if not f]
    run = outcome(*departures, left=tuple(left))
    report = run_report(run, "truth")
    fields = json.loads(json.dumps(report.fields))
    assert fields["stored"] + len(fields["exceptions"]) + fields["lost"] == fields["boxes"]
    assert fields["stored"] == ended.count(Fate.STORED)
    assert fields["lost"] == ended.count(Fate.LOST)
    assert report.holds is run.whole is (Fate.LOST not in ended)
    assert all(exception["reason"] for exception in fields["exceptions"])
    listed = [exception["box"] for exception in fields["exceptions"]]
    gone = [entry["box"] for entry in fields["sequence"]]
    assert len(set(listed)) == len(listed)
    assert gone == [d.box for d in departures]
    assert [entry["stack"] for entry in fields["sequence"]] == [int(box[1:]) - 1 for box in gone]


def test_the_fields_are_those_of_the_contract() -> None:
    """Each of its kind; a bool is no integer."""
    wishes = (
        Wish(Request(priority=0.8, gtin=Gtin("g1")), 12.0, BoxId("b1"), 2),
        Wish(Request(priority=0.2, box=BoxId("b2"), arrived=4.0, due=50.0)),
    )
    run = outcome(departure(1, Fate.STORED), departure(2, Fate.BY_PERSON), wishes=wishes)
    fields = json.loads(json.dumps(run_report(run, "truth").fields))
    assert {key: type(fields[key]) for key in CONTRACT} == CONTRACT
    assert fields["sequence"] == [
        {
            "stack": 0,
            "box": "b1",
            "gtin": "g1",
            "grasp": "vertical",
            "place": "trolley_1/level_1",
            "outcome": "stored",
            "at": 1.0,
        },
        {
            "stack": 1,
            "box": "b2",
            "gtin": None,
            "grasp": None,
            "place": None,
            "outcome": "taken by a person",
            "at": 2.0,
        },
    ]
    assert fields["requests"] == [
        {"priority": 0.8, "arrived": 0.0, "gtin": "g1", "served": 12.0, "boxes_before": 2},
        {
            "priority": 0.2,
            "arrived": 4.0,
            "box": "b2",
            "due": 50.0,
            "served": None,
            "boxes_before": 0,
        },
    ]
    assert fields["questions"] == [
        {
            "text": "Please take b1.",
            "about": "b1",
            "answer": "taken",
            "asked": 1.0,
            "answered": 21.0,
        }
    ]


def test_the_rate_leaves_the_waiting_for_people_out() -> None:
    """Stored per simulated hour."""
    run = outcome(departure(1, Fate.STORED), departure(2, Fate.SET_ASIDE))
    assert run.boxes_per_hour == pytest.approx(3600 / 80)
    assert outcome(waiting=100.0).boxes_per_hour == 0.0


@pytest.mark.parametrize(
    "wrong",
    [
        outcome(departure(1, Fate.LOST)),
        outcome(departure(1, Fate.STORED), collisions=(HIT,)),
        outcome(departure(1, Fate.STORED), differs=("box b1: elsewhere",)),
    ],
)
def test_a_run_with_a_loss_a_collision_or_wrong_books_does_not_hold(wrong: Outcome) -> None:
    """Whatever else went well."""
    assert not wrong.whole
    assert not run_report(wrong, "truth").holds


def test_a_run_in_which_a_box_was_forgotten_does_not_hold() -> None:
    """Neither departed nor left: nobody has seen it."""
    run = outcome(departure(1, Fate.STORED))
    forgotten = outcome(departure(1, Fate.STORED), left=(Left(BoxId("b2"), "?"),))
    assert run.whole
    assert forgotten.whole
    object.__setattr__(forgotten, "left", ())
    assert not forgotten.whole


class Truth:
    """A referee that says what a test says."""

    def __init__(self, where: Mapping[int, str]) -> None:
        """By the index in the stack."""
        self._where = where

    def where(self, index: int) -> str:
        """Where a box is."""
        return self._where[index]

    def product(self, index: int) -> Gtin:
        """What a box is."""
        return Gtin(f"g{index + 1}")


@pytest.mark.parametrize(
    ("fate", "agree"),
    [
        (Fate.STORED, {"trolley_1/level_1", REMOVED}),  # its trolley may have gone
        (Fate.SET_ASIDE, {"trolley_1/level_1", REMOVED}),
        (Fate.BY_PERSON, {REMOVED, HAND}),
        (Fate.LOST, {FLOOR, REMOVED, PALLET}),
        (None, {PALLET}),
    ],
)
def test_the_referee_confirms_what_became_of_each_box(fate: Fate | None, agree: set[str]) -> None:
    """Anywhere else is said, in words."""
    gone = [departure(1, fate)] if fate is not None else []
    left = [] if fate is not None else [Left(BoxId("b1"), "out of reach")]
    for where in ("trolley_1/level_1", "trolley_1/level_2", FLOOR, HAND, PALLET, REMOVED):
        found = disagreements(Truth({0: where}), gone, left, {BoxId("b1"): 0})  # type: ignore[arg-type]
        assert bool(found) is (where not in agree)
        assert all(line.startswith("box b1: the books say ") for line in found)
        assert all(line.endswith(f", it is in {where}") for line in found)


def test_a_box_that_the_stack_does_not_have_is_nowhere() -> None:
    """A phantom of the perception."""
    phantom = departure(7, Fate.STORED)
    found = disagreements(Truth({}), [phantom], [], {})  # type: ignore[arg-type]
    assert found == ("box b7: the books say trolley_1/level_1 or removed, it is in nowhere",)
