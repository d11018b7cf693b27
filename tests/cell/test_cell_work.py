"""The controller with fake devices in simulated time: whole runs of a few boxes."""

import dataclasses
import hashlib
import os
import subprocess
import sys
from pathlib import Path
from unittest import mock

import pytest
from cells_at_work import (
    ASIDE,
    DECK,
    LOST,
    PERSON,
    SIZE,
    STORED,
    TROLLEYS,
    Cell,
    exchanged_by,
    gtin,
    name,
    note,
)
from hypothesis import given, settings
from hypothesis import strategies as st

from depal.cell.planning.presenting import Presenting
from depal.cell.primitives.feeling import STEPS
from depal.cell.primitives.seeing import ABSENT
from depal.cell.workplace import Settings
from depal.domain import PlaceId, Recognition, Request
from depal.executive import events as ev
from depal.executive.events import encode
from depal.geometry import OrientedBox
from depal.ports import TAKEN, Question
from depal.ports.fakes import FakeBays, FakeGripper, FakePerson, FakeReader

HERE = Path(__file__).resolve().parent

FELT = 1 + len(STEPS)
"""So often the gripper sucks before it gives a grasp up."""

SHELF = (PlaceId("shelf/level_1"), PlaceId("shelf/level_2"))


def texts(cell: Cell) -> list[str]:
    """What the person was asked."""
    return [question.text for question in cell.person.asked]


def refusing() -> FakePerson:
    """A person who gives the careful answer."""
    return FakePerson(lambda question: question.choices[-1])


# All goes well


@pytest.mark.parametrize("boxes", [1, 2, 3, 4])
def test_every_box_is_stored_in_the_place_that_the_store_names(boxes: int) -> None:
    """One after the other; nobody is asked anything."""
    cell = Cell(boxes).works()
    cell.assert_whole()
    assert set(cell.fates.values()) == {STORED}
    assert cell.booked == {name(n): TROLLEYS[n - 1] for n in range(1, boxes + 1)}
    assert texts(cell) == []
    assert [choice.target for choice in cell.choices] == list(cell.fates)


def test_the_store_is_told_each_movement_once_with_product_place_and_time() -> None:
    """In the order in which the boxes were stored."""
    cell = Cell(3).works()
    movements = cell.store.movements
    assert [m.box for m in movements] == list(cell.fates)
    assert {m.box: m.gtin for m in movements} == {name(n): gtin(n) for n in (1, 2, 3)}
    assert len({m.id for m in movements}) == 3
    assert sorted(m.at for m in movements) == [m.at for m in movements]


def test_the_next_box_is_chosen_and_given_a_place_while_the_arm_carries_the_one_before() -> None:
    """Looking, choosing, asking and planning cost no time of their own but for the first box."""
    cell = Cell(3).works()
    first, second = list(cell.fates)[:2]
    order = cell.started
    asked = order.index(f"ask_target({second})")
    assert order.index(f"kr60_carry({first})") < asked < order.index(f"kr60_release({first})")
    shares = cell.times.shares(cell.ended)
    assert shares["planning"] == pytest.approx(cell.settings.charges.plan)
    assert shares["looking"] == pytest.approx(cell.sight.time)
    assert sum(shares.values()) == pytest.approx(cell.ended)


def test_a_box_behind_another_waits_for_it() -> None:
    """The pile is seen whole from the beginning."""
    cell = Cell(2)
    x = 1.55 + SIZE[0] + 0.002
    shapes = [
        OrientedBox.upright((at, 0.0, DECK + SIZE[2] / 2), SIZE)
        for at in (x, 1.55)  # b1 stands behind b2
    ]
    cell.sight.script = [
        tuple(Recognition(name(n), shape, gtin(n)) for n, shape in enumerate(shapes, start=1))
    ]
    cell.works(Request(priority=1.0, box=name(1))).assert_whole()
    assert list(cell.fates) == ["b2", "b1"]


@pytest.mark.parametrize("error", [-0.0075, 0.0075])
def test_a_box_that_is_seen_a_little_too_low_or_high_is_taken_nevertheless(error: float) -> None:
    """Too low it would stand in the wood of the pallet."""
    cell = Cell(1)
    ((seen,),) = cell.sight.script
    assert seen is not None
    x, y, z = seen.shape.centre
    shape = OrientedBox.upright((x, y, z + error), seen.shape.size)
    cell.sight.script = [(dataclasses.replace(seen, shape=shape),)]
    cell.works().assert_whole()
    assert cell.fates == {"b1": STORED}


# Boxes that nobody knows


def test_an_unknown_box_is_shown_read_and_then_given_a_place() -> None:
    """The paper's check and query really happen, and for that box alone."""
    cell = Cell(3, unknown=(2,), reader=FakeReader([(), ("nonsense",), (gtin(2),)])).works()
    cell.assert_whole()
    assert set(cell.fates.values()) == {STORED}
    steps = [step for step in cell.started if step.endswith("(b2)")]
    assert steps == [
        "kr60_reach(b2)",
        "kr60_grasp(b2)",
        "kr60_show(b2)",
        "read_barcode(b2)",
        "ask_target(b2)",
        "kr60_carry(b2)",
        "kr60_release(b2)",
    ]
    assert cell.reader.readings == 3
    assert [step for step in cell.started if "barcode" in step] == ["read_barcode(b2)"]
    assert texts(cell) == []


def test_where_the_reader_sees_no_product_of_the_note_a_person_says_which_it_is() -> None:
    """The answer counts like a reading."""

    def answer(question: Question) -> str:
        return gtin(2) if question.id == "product/b2" else question.choices[0]

    reader = FakeReader([("4006381333931",), ()])  # once: it may be a misread
    cell = Cell(2, unknown=(2,), reader=reader, person=FakePerson(answer)).works()
    cell.assert_whole()
    assert set(cell.fates.values()) == {STORED}
    assert texts(cell) == [
        "Which product is the box in the gripper (b2)? The reader saw 4006381333931."
    ]
    assert cell.person.asked[0].choices == (gtin(1), gtin(2), "I cannot tell")
    assert cell.booked["b2"] == TROLLEYS[1]
    assert cell.times.shares(cell.ended)["waiting for people"] == pytest.approx(20.0)


def test_a_box_that_no_way_leads_to_the_reader_with_is_what_a_person_says() -> None:
    """The answer holds at once: the box is neither shown nor asked about again."""

    def answer(question: Question) -> str:
        return gtin(2) if question.id == "product/b2" else question.choices[0]

    cell = Cell(2, unknown=(2,), reader=FakeReader([]), person=FakePerson(answer))
    with mock.patch.object(Presenting, "show", mock.AsyncMock(return_value="no side can be shown")):
        cell.works().assert_whole()
    assert set(cell.fates.values()) == {STORED}
    assert texts(cell) == ["Which product is the box in the gripper (b2)? No side can be shown."]
    assert [step for step in cell.started if step == "kr60_show(b2)"] == ["kr60_show(b2)"]
    assert cell.reader.readings == 0
    assert cell.booked["b2"] == TROLLEYS[1]


def test_a_box_whose_code_is_not_on_the_note_is_set_aside_without_a_question() -> None:
    """Read from two sides; the reason names the product."""
    reader = FakeReader([("4006381333931",)] * 9)
    cell = Cell(2, unknown=(2,), reader=reader).works()
    cell.assert_whole()
    assert cell.fates == {"b1": STORED, "b2": ASIDE}
    (aside,) = [d for d in cell.work.departures.sequence if d.fate is ASIDE]
    assert aside.reason == "product 4006381333931 is not on the note"
    assert texts(cell) == []


def test_a_box_that_does_not_weigh_what_its_name_says_is_shown_to_the_reader() -> None:
    """Where the code is another product's that weighs so, it is stored as that."""
    cell = Cell(2, reader=FakeReader([(gtin(2),)]), person=refusing())
    cell.work.delivery = note(2)
    light, heavy = cell.work.delivery.lines
    product = dataclasses.replace(light.product, mass=9.0)
    lines = (dataclasses.replace(light, product=product), dataclasses.replace(heavy, count=2))
    cell.work.delivery = dataclasses.replace(cell.work.delivery, lines=lines)
    cell.works()
    assert cell.fates == {"b1": STORED, "b2": STORED}
    assert [d.gtin for d in cell.work.departures.sequence] == [gtin(2), gtin(2)]
    assert "read_barcode(b1)" in cell.started
    assert "read_barcode(b2)" not in cell.started


def test_a_box_whose_code_and_weight_contradict_each_other_is_set_aside() -> None:
    """Nothing is stored under a name that something speaks against."""
    cell = Cell(1, reader=FakeReader([(gtin(1),)]))
    (line,) = cell.work.delivery.lines
    product = dataclasses.replace(line.product, mass=9.0)
    lines = (dataclasses.replace(line, product=product),)
    cell.work.delivery = dataclasses.replace(cell.work.delivery, lines=lines)
    cell.works()
    assert cell.fates == {"b1": ASIDE}
    (aside,) = cell.work.departures.sequence
    assert "it weighs 4.0 kg, product product-1 weighs 9.0 kg" in aside.reason


def test_one_case_too_many_is_set_aside() -> None:
    """The one that is taken last: the note promises one."""
    cell = Cell(2, reader=FakeReader([(gtin(1),)]), person=refusing())
    cell.sight.script = [
        tuple(Recognition(box.id, box.shape, gtin(1)) for box in cell.sight.script[0] or ())
    ]
    cell.works()
    assert sorted(cell.fates.values(), key=str) == [ASIDE, STORED]
    (aside,) = [d for d in cell.work.departures.sequence if d.fate is ASIDE]
    assert "the note promises 1 of product product-1, this is one more" in aside.reason


def test_a_box_that_the_note_promises_and_no_look_shows_is_asked_for() -> None:
    """Once everything else is gone; a person says that it is missing."""
    cell = Cell(2, person=FakePerson(lambda question: question.choices[-1]))
    cell.sight.script = [cell.sight.script[0][:1]]  # type: ignore[index]
    cell.works()
    assert cell.fates == {"b1": STORED}
    (text,) = texts(cell)
    assert text.startswith("The note promises one more case of product 2 (product-2), and none")


def test_a_box_that_is_none_is_forgotten() -> None:
    """A person says that there is nothing where the cell sees a box."""
    person = FakePerson(lambda question: question.choices[-1])
    cell = Cell(1, gripper=FakeGripper(dict.fromkeys(range(4 * FELT), 0.0)), person=person).works()
    assert cell.fates == {}
    assert len(cell.work.pile) == 0


def test_a_box_that_nobody_can_tell_is_set_aside() -> None:
    """With a reason; the run goes on."""
    person = FakePerson(lambda question: question.choices[-1])
    cell = Cell(2, unknown=(2,), person=person).works()
    cell.assert_whole()
    assert cell.fates == {"b1": STORED, "b2": ASIDE}
    assert cell.booked["b2"] in SHELF
    assert all(d.reason for d in cell.work.departures.sequence if d.fate is ASIDE)


def test_a_product_that_the_store_does_not_know_is_set_aside() -> None:
    """With the same for all its cases."""
    cell = Cell(2, places={gtin(1): (TROLLEYS[0],)}).works()
    cell.assert_whole()
    assert cell.fates == {"b1": STORED, "b2": ASIDE}
    assert cell.booked["b2"] in SHELF


def test_a_store_that_is_silent_for_a_while_is_asked_again() -> None:
    """No box is set aside for a short silence."""
    cell = Cell(2)
    cell.store.silent = frozenset((0, 1, 3))
    cell.works().assert_whole()
    assert set(cell.fates.values()) == {STORED}
    assert len(cell.store.questions) == 5


# Suction


def test_a_vacuum_that_does_not_come_is_tried_again() -> None:
    """The arm draws back and approaches anew."""
    cell = Cell(2, gripper=FakeGripper(dict.fromkeys(range(2 * FELT), 0.0))).works()
    cell.assert_whole()
    assert set(cell.fates.values()) == {STORED}
    first = cell.choices[0].target
    assert cell.started.count(f"kr60_grasp({first})") == 3
    assert cell.started.count(f"kr60_reach({first})") == 3


def test_a_box_that_cannot_be_sucked_is_left_to_a_person() -> None:
    """After four tries; the others are stored first."""
    cell = Cell(3, gripper=FakeGripper(dict.fromkeys(range(4 * FELT), 0.0))).works()
    cell.assert_whole()
    first = str(cell.choices[0].target)
    assert cell.fates.pop(first) is PERSON
    assert set(cell.fates.values()) - {PERSON} == {STORED}
    assert list(cell.fates)[-1] == first
    (question,) = cell.person.asked
    assert (question.about, question.choices) == (first, (TAKEN, ABSENT))
    assert question.at is not None
    assert f"cannot take box {first}" in question.text


def test_a_vacuum_that_breaks_on_the_way_makes_the_box_lost() -> None:
    """The person is asked to pick it up, the place is free again, the others are stored."""
    cell = Cell(3, gripper=FakeGripper({0: 1.2})).works()
    cell.assert_whole()
    first, *others = cell.fates
    assert cell.fates[first] is LOST
    assert {cell.fates[box] for box in others} == {STORED}
    assert set(cell.booked) == set(others)
    assert texts(cell) == [f"Box {first}: it lies on the floor. Please pick it up."]
    lost = cell.work.departures.sequence[0]
    assert lost.reason == "fell out of the gripper"
    assert lost.grasp is not None


def test_a_vacuum_that_breaks_while_the_arm_stands_is_noticed() -> None:
    """Here while a person is asked: the box was never carried on, so it is not stored."""

    def answer(question: Question) -> str:
        return gtin(1) if question.id == "product/b1" else question.choices[0]

    gripper, reader = FakeGripper({0: 10.0}), FakeReader([("x",), ("y",)])
    cell = Cell(1, unknown=(1,), gripper=gripper, reader=reader, person=FakePerson(answer)).works()
    cell.assert_whole()
    assert cell.fates == {"b1": LOST}


@settings(max_examples=20)
@given(grip=st.integers(0, 2), after=st.floats(0.0, 7.0), unknown=st.sampled_from([(), (1,), (3,)]))
def test_whenever_the_vacuum_breaks_each_box_ends_once_and_the_books_are_true(
    grip: int, after: float, unknown: tuple[int, ...]
) -> None:
    """Before, in and after any of the motions with a box."""
    readings = [tuple(gtin(n) for n in unknown)] * 9
    cell = Cell(3, unknown, gripper=FakeGripper({grip: after}), reader=FakeReader(readings))
    cell.works().assert_whole()
    broke = [box for box, fate in cell.fates.items() if fate is LOST]
    assert len(broke) <= 1
    assert [q.text for q in cell.person.asked if "floor" in q.text] == [
        f"Box {box}: it lies on the floor. Please pick it up." for box in broke
    ]


# Places and trolleys


def test_a_full_place_has_its_trolley_exchanged_and_the_box_goes_into_the_new_one() -> None:
    """The arm waits; the books begin anew."""
    bays = FakeBays()
    cell = Cell(2, full=[TROLLEYS[0]], bays=bays, person=exchanged_by(bays)).works()
    cell.assert_whole()
    assert set(cell.fates.values()) == {STORED}
    assert [bay for _, bay in bays.exchanges] == ["trolley_4"]
    assert texts(cell) == [
        "trolley_4 is full. Please pull it out and put an empty one into its bay."
    ]
    ((at, _),) = bays.exchanges
    stored = {m.box: m.at for m in cell.store.movements}
    assert stored[name(1)] > at
    assert cell.booked["b1"] == TROLLEYS[0]
    assert f"full {TROLLEYS[0]}" not in cell.desk.promises.books.at(TROLLEYS[0]).by_id


def test_of_several_places_the_first_with_room_is_taken_before_any_exchange() -> None:
    """The store's order counts."""
    places = {gtin(1): (TROLLEYS[0], TROLLEYS[1], TROLLEYS[2])}
    cell = Cell(1, full=[TROLLEYS[0]], places=places).works()
    cell.assert_whole()
    assert cell.booked == {"b1": TROLLEYS[1]}
    assert texts(cell) == []


@pytest.mark.parametrize("delay", [100.0, 1000.0, 3000.0])
def test_a_person_who_comes_late_is_waited_for(delay: float) -> None:
    """No time-out makes the cell believe that a trolley was exchanged."""
    bays = FakeBays()
    person = exchanged_by(bays)
    person.delay = delay
    cell = Cell(1, full=[TROLLEYS[0]], bays=bays, person=person).works()
    cell.assert_whole()
    assert cell.fates == {"b1": STORED}
    assert cell.store.movements[0].at > delay
    assert len(texts(cell)) == 1


@pytest.mark.parametrize("homeless", [2, 3])
def test_where_no_storage_has_room_a_person_takes_the_box_out_of_the_gripper(homeless: int) -> None:
    """And the arm does nothing else before: no other box is reached for with a full hand."""
    known = {gtin(n): (TROLLEYS[n - 1],) for n in range(1, 4) if n != homeless}
    cell = Cell(3, places=known, full=SHELF)
    cell.person.delay = 100.0
    cell.works().assert_whole()
    fates = dict.fromkeys(("b1", "b2", "b3"), STORED)
    assert cell.fates == {**fates, f"b{homeless}": PERSON}
    assert texts(cell)[0].startswith(f"The arm cannot put box b{homeless} down:")


# Requests


def test_requests_are_served_once_and_late_ones_too() -> None:
    """The wanted box comes as soon as it can, and what left before it is counted."""
    wanted = [
        Request(priority=0.9, gtin=gtin(2)),
        Request(priority=0.4, gtin=gtin(2)),  # only one case of it is there
        Request(priority=1.0, box=name(3), arrived=9.0),
    ]
    cell = Cell(4, settings=Settings(w=1.0)).works(*wanted)
    cell.assert_whole()
    first, second, late = cell.work.wishes
    assert (first.box, first.boxes_before) == (name(2), 0)
    assert second.served is None
    assert late.box == name(3)
    assert late.served is not None
    assert late.served > 9.0
    order = [d.box for d in cell.work.departures.sequence]
    assert order[0] == name(2)
    left = {d.box: d.at for d in cell.work.departures.sequence}
    assert late.served == left[name(3)]
    assert late.boxes_before == sum(9.0 <= at < late.served for at in left.values())


def test_a_request_is_served_by_an_unknown_box_once_it_is_read() -> None:
    """Nobody knew that it was the wanted one."""
    wanted = Request(priority=1.0, gtin=gtin(1))
    cell = Cell(1, unknown=(1,), reader=FakeReader([(gtin(1),)])).works(wanted)
    (wish,) = cell.work.wishes
    assert (wish.box, wish.boxes_before) == (name(1), 0)


# The executive's log


def digest(cell: Cell) -> str:
    """Of the events, as the contract has it."""
    lines = [f"{e.at!r} {type(e).__name__} {encode(e)}\n" for e in cell.events]
    return hashlib.sha256("".join(lines).encode()).hexdigest()


def troubled(seed: int = 0) -> Cell:
    """A run with an unknown box, a full place and a vacuum that comes late."""
    bays = FakeBays()
    return Cell(
        3,
        unknown=(2,),
        full=[TROLLEYS[0]],
        bays=bays,
        person=exchanged_by(bays),
        gripper=FakeGripper({0: 0.0}),
        reader=FakeReader([(gtin(2),)]),
        seed=seed,
    )


def test_the_same_inputs_give_the_same_events() -> None:
    """To the byte; and the hash is that of the events."""
    cells = [troubled().works() for _ in range(2)]
    assert cells[0].sha256 == cells[1].sha256 == digest(cells[0])
    assert Cell(3).works().sha256 != cells[0].sha256


@pytest.mark.slow
def test_the_hash_seed_of_python_decides_nothing() -> None:
    """No set's order leads to a decision."""
    program = "from test_cell_work import troubled; print(troubled().works().sha256)"
    found = {
        subprocess.run(  # noqa: S603 - our own program
            [sys.executable, "-c", program],
            check=True,
            capture_output=True,
            text=True,
            env={**os.environ, "PYTHONHASHSEED": seed, "PYTHONPATH": os.pathsep.join(sys.path)},
            cwd=HERE,
        ).stdout
        for seed in ("1", "2")
    }
    assert len(found) == 1
    assert found == {troubled().works().sha256 + "\n"}


def test_every_wait_is_on_the_loops_time() -> None:
    """A person who takes a day costs no time of the machine, and the times of events rise."""
    person = FakePerson(lambda question: question.choices[-1], delay=250.0)
    reader = FakeReader([("x",), ("y",)])
    cell = Cell(1, unknown=(1,), reader=reader, person=person).works()
    times = [event.at for event in cell.events]
    assert times == sorted(times)
    assert cell.ended > 250.0


def test_attempts_end_as_often_as_they_begin() -> None:
    """Nothing is left running when the pallet is empty."""
    cell = troubled().works()
    begun = [e.attempt for e in cell.events if isinstance(e, ev.Started)]
    over = [e.attempt for e in cell.events if isinstance(e, ev.Ended)]
    assert sorted(begun) == sorted(over)


# Faults of devices


@pytest.mark.parametrize("looks", [1, 3])
def test_a_camera_that_fails_for_a_while_is_asked_again(looks: int) -> None:
    """The run goes on."""
    cell = Cell(1)
    cell.sight.script = [*[None] * looks, *cell.sight.script]
    cell.works().assert_whole()
    assert cell.fates == {"b1": STORED}


def test_a_camera_that_fails_for_good_ends_the_run_when_the_arm_is_done() -> None:
    """It never hangs: what was begun is ended, the rest is left."""
    cell = Cell(3)
    cell.sight.script = [*cell.sight.script, None]
    cell.works()
    assert list(cell.fates.values()) == [STORED]
    assert len(cell.work.pile) == 2
    assert not cell.still_held


@pytest.mark.parametrize("motion", [0, 1, 2, 3])
def test_a_motion_that_the_arm_refuses_once_is_tried_again(motion: int) -> None:
    """Approach, lift, carry and descent of the first box."""
    cell = Cell(2, refuses=frozenset((motion,))).works()
    cell.assert_whole()
    assert set(cell.fates.values()) == {STORED}


# What the cell cannot do yet


def test_after_a_loss_in_front_of_a_place_the_arm_goes_on() -> None:
    """It draws back from where the box has fallen and takes the next one."""
    cell = Cell(2, gripper=FakeGripper({0: 3.3})).works()
    assert cell.fates == {"b1": LOST, "b2": STORED}


def test_no_trolley_is_exchanged_while_a_box_is_on_its_way_into_it() -> None:
    """However quick the person is."""
    bays = FakeBays()
    upper = PlaceId("trolley_4/level_2")
    person = exchanged_by(bays)
    person.delay = 0.1
    places = {gtin(1): (TROLLEYS[0],), gtin(2): (upper,)}
    Cell(2, full=[upper], bays=bays, person=person, places=places).works().assert_whole()


def test_a_box_stays_stored_when_the_arm_refuses_to_draw_back() -> None:
    """It stands, whatever comes after."""
    cell = Cell(2, refuses=frozenset((4,))).works()
    cell.assert_whole()
    assert set(cell.fates.values()) == {STORED}


def test_a_person_is_told_why_a_box_could_not_be_taken() -> None:
    """The last thing that went wrong, in words."""
    cell = Cell(1, gripper=FakeGripper(dict.fromkeys(range(4 * FELT), 0.0))).works()
    assert "the vacuum did not come" in texts(cell)[0]
    assert cell.work.departures.sequence[0].reason == "the vacuum did not come"


def test_an_arm_on_which_nothing_hangs_has_taken_nothing() -> None:
    """Though the sensor says that the vacuum stands: the box is tried again, then a person's."""
    cell = Cell(1)
    cell.arm.hanging = lambda: 0.0
    cell.works()
    assert [d.fate for d in cell.work.departures.sequence] == [PERSON]
    assert "0.0 kg hang on the arm" in texts(cell)[0]
