"""The card says one thing, and it is the most important one."""

from dataclasses import replace

import pytest
from hypothesis import given
from hypothesis import strategies as st
from screenstates import line, state_with

from depal.server.cellstate import Alarm, CellState, Mode, QuestionState
from depal.server.screen.said import said_in
from depal.server.screen.todo import Todo, Tone, Verb, todo_of
from depal.server.screen.words import words_of

WORDS, SAID = words_of("en"), said_in("en")

ASKED = QuestionState("1/take/b7/3-1", "Please take it.", ("taken", "it is not there"), "b7", 3.0)

ALARM = Alarm("world", "The world has ended.", "Load the pallet anew, then press Start.", 1.0)


def card(state: CellState, *waiting: str) -> Todo:
    """The card for a state."""
    return todo_of(state, waiting, WORDS, SAID)


def verbs(todo: Todo) -> list[Verb]:
    """What its buttons do."""
    return [act.verb for act in todo.acts]


states = st.builds(
    CellState,
    mode=st.sampled_from(Mode),
    reason=st.just("So it is."),
    run=st.none() | st.just(1),
    stopping=st.booleans(),
    questions=st.lists(st.just(ASKED), max_size=2).map(tuple),
    alarms=st.lists(st.just(ALARM), max_size=2).map(tuple),
    held=st.none() | st.just("b1"),
)


@given(states, st.lists(st.text(min_size=1), max_size=2))
def test_there_is_always_something_to_read(state: CellState, waiting: list[str]) -> None:
    """There is always something to read."""
    todo = card(state, *waiting)
    assert todo.headline
    assert todo.detail
    assert sum(act.main for act in todo.acts) <= max(1, len(state.questions))


@given(states, st.lists(st.text(min_size=1), max_size=2))
def test_a_safety_stop_offers_no_button(state: CellState, waiting: list[str]) -> None:
    """A safety stop offers no button."""
    todo = card(replace(state, mode=Mode.ABORTED), *waiting)
    assert todo.tone is Tone.ALARM
    assert todo.acts == ()


@given(states)
def test_a_question_comes_before_all_but_a_safety_stop(state: CellState) -> None:
    """A question comes before all but a safety stop."""
    if state.mode is Mode.ABORTED:
        return
    todo = card(replace(state, questions=(ASKED,)))
    assert todo.tone is Tone.ASKING
    assert [act.choice for act in todo.acts] == list(ASKED.choices)
    assert {act.about for act in todo.acts} == {ASKED.id}


def test_what_the_cell_waits_for_is_asked_first() -> None:
    """What the cell waits for is asked first."""
    later = replace(ASKED, id="1/aside/b2/1-1", blocks=False, text="Please take it away.")
    todo = card(state_with(questions=(later, ASKED)))
    assert todo.headline == ASKED.text
    assert "1 more" in todo.detail


def test_answers_are_words_on_buttons() -> None:
    """Answers are words on buttons."""
    todo = card(state_with(questions=(ASKED,)))
    assert [act.label for act in todo.acts] == ["Taken", "It is not there"]


def test_while_it_works_nothing_is_to_be_done() -> None:
    """While it works nothing is to be done."""
    todo = card(state_with(line("b1"), target="b1"))
    assert (todo.tone, verbs(todo)) == (Tone.CALM, [Verb.HOLD, Verb.STOP])
    assert not any(act.main for act in todo.acts)
    assert "b1" in todo.detail


@pytest.mark.parametrize(
    ("mode", "verb"),
    [(Mode.HELD, Verb.RESUME), (Mode.STOPPED, Verb.START)],
)
def test_a_cell_that_stands_says_how_it_goes_on(mode: Mode, verb: Verb) -> None:
    """A cell that stands says how it goes on."""
    assert verbs(card(state_with(mode=mode))) == [verb]


def test_after_a_restart_start_goes_on_and_not_resume() -> None:
    """After a restart start goes on and not resume."""
    alarm = Alarm("restart", "Started anew.", "Look at the cell, then press Start.", 0.0)
    todo = card(state_with(mode=Mode.HELD, alarms=(alarm,)))
    assert verbs(todo) == [Verb.START]
    assert todo.headline == alarm.todo


@pytest.mark.parametrize("mode", [Mode.IDLE, Mode.COMPLETE])
def test_the_next_delivery_is_started_by_its_name(mode: Mode) -> None:
    """The next delivery is started by its name."""
    todo = card(state_with(mode=mode), "monday", "tuesday")
    assert todo.acts[0].about == "monday"
    assert "monday" in todo.acts[0].label


def test_an_empty_queue_asks_for_a_delivery_and_a_new_cell_offers_a_sample() -> None:
    """An empty queue asks for a delivery and a new cell offers a sample."""
    assert verbs(card(CellState())) == [Verb.BRING, Verb.SAMPLE]
    assert verbs(card(state_with(mode=Mode.COMPLETE))) == [Verb.BRING]


def test_a_cell_that_is_stopping_can_be_let_go_on() -> None:
    """A cell that is stopping can be let go on."""
    assert verbs(card(state_with(stopping=True))) == [Verb.RESUME]
