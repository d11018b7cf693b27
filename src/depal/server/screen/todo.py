"""What is to be done now: one sentence, one reason, the buttons for it."""

from collections.abc import Sequence
from dataclasses import dataclass
from enum import Enum

from depal.server.cellstate import Alarm, CellState, Mode, QuestionState
from depal.server.screen.said import Said, label_of
from depal.server.screen.words import Words

RESTART = "restart"
"""The alarm after a restart, which Start ends and not Resume."""


class Tone(Enum):
    """How loud the card is; only what is abnormal is loud."""

    CALM = "calm"
    WAITING = "waiting"
    ASKING = "asking"
    ALARM = "alarm"


class Verb(Enum):
    """What a button does."""

    START = "start"
    HOLD = "hold"
    RESUME = "resume"
    STOP = "stop"
    ANSWER = "answer"
    BRING = "bring"
    SAMPLE = "sample"


@dataclass(frozen=True, slots=True)
class Act:
    """A button.

    Attributes:
        verb: what it does.
        label: on it.
        main: whether it is what is to be done now.
        about: the question that it answers, or the delivery that it starts.
        choice: the answer that it gives.
    """

    verb: Verb
    label: str
    main: bool = True
    about: str = ""
    choice: str = ""


@dataclass(frozen=True, slots=True)
class Todo:
    """The card.

    Attributes:
        tone: how loud.
        icon: beside the headline.
        headline: what to do.
        detail: why.
        acts: the buttons.
    """

    tone: Tone
    icon: str
    headline: str
    detail: str
    acts: tuple[Act, ...] = ()


def todo_of(state: CellState, waiting: Sequence[str], words: Words, said: Said) -> Todo:
    """What is to be done now.

    Args:
        state: of the cell.
        waiting: the deliveries in the queue, the next first.
        words: of the screen.
        said: puts what the cell says into the screen's language.
    """
    if state.mode is Mode.ABORTED:
        return Todo(Tone.ALARM, "dangerous", words("todo.aborted"), words("todo.aborted_how"))
    question = first_question(state)
    if question is not None:
        return _asked(question, state, words, said)
    alarm = next((alarm for alarm in state.alarms if alarm.urgent), None)
    if alarm is not None:
        return _alarmed(alarm, state, waiting, words, said)
    return _plain(state, waiting, words, said)


def first_question(state: CellState) -> QuestionState | None:
    """The one that is to be answered first: what the cell waits for, then the oldest."""
    ranked = sorted(state.questions, key=lambda question: not question.blocks)
    return ranked[0] if ranked else None


def _asked(question: QuestionState, state: CellState, words: Words, said: Said) -> Todo:
    acts = tuple(
        Act(Verb.ANSWER, label_of(choice, said), main=place == 0, about=question.id, choice=choice)
        for place, choice in enumerate(question.choices)
    )
    detail = words("todo.waits_for_you") if question.blocks else words("todo.goes_on")
    more = len(state.questions) - 1
    if more:
        detail = f"{detail} {words('todo.more_questions', count=more)}"
    return Todo(Tone.ASKING, "help", said(question.text), detail, acts)


def _alarmed(
    alarm: Alarm, state: CellState, waiting: Sequence[str], words: Words, said: Said
) -> Todo:
    acts: tuple[Act, ...] = ()
    if state.mode in {Mode.HELD, Mode.STOPPED}:
        going = state.run is not None and state.mode is Mode.HELD
        acts = (Act(Verb.START, words("act.start")),) if going else _starts(waiting, words)
    return Todo(Tone.ALARM, "warning", said(alarm.todo), said(alarm.text), acts)


def _starts(waiting: Sequence[str], words: Words, *, first: bool = False) -> tuple[Act, ...]:
    if not waiting:
        sample = (Act(Verb.SAMPLE, words("act.sample"), main=False),) if first else ()
        return (Act(Verb.BRING, words("act.bring")), *sample)
    return (
        Act(Verb.START, words("act.start_delivery", delivery=waiting[0]), about=waiting[0]),
        Act(Verb.BRING, words("act.bring"), main=False),
    )


def _plain(state: CellState, waiting: Sequence[str], words: Words, said: Said) -> Todo:
    """Nothing is wrong."""
    if state.mode is Mode.EXECUTE:
        return _working(state, words)
    if state.mode is Mode.SUSPENDED:
        return Todo(Tone.WAITING, "hourglass_top", words("todo.suspended"), said(state.reason))
    if state.mode is Mode.HELD:
        act = Act(Verb.RESUME, words("act.resume"))
        return Todo(
            Tone.WAITING, "pause_circle", words("todo.held"), words("todo.held_how"), (act,)
        )
    if state.mode is Mode.STOPPED:
        act = Act(Verb.START, words("act.start"))
        return Todo(
            Tone.WAITING, "stop_circle", words("todo.stopped"), words("todo.stopped_how"), (act,)
        )
    if state.mode is Mode.COMPLETE:
        key = "todo.complete_next" if waiting else "todo.complete"
        detail = words("todo.complete_how", stored=state.stored, aside=state.aside)
        return Todo(Tone.WAITING, "check_circle", words(key), detail, _starts(waiting, words))
    key = "todo.idle_next" if waiting else "todo.idle"
    detail = words("todo.idle_next_how" if waiting else "todo.idle_how")
    acts = _starts(waiting, words, first=state.run is None)
    return Todo(Tone.WAITING, "inbox", words(key), detail, acts)


def _working(state: CellState, words: Words) -> Todo:
    if state.stopping:
        return Todo(
            Tone.CALM, "stop_circle", words("todo.stopping"), words("todo.stopping_how"),
            (Act(Verb.RESUME, words("act.go_on"), main=False),),
        )  # fmt: skip
    box = state.held or state.target
    detail = words("todo.moving", box=box) if box else words("todo.looking")
    acts = (
        Act(Verb.HOLD, words("act.hold"), main=False),
        Act(Verb.STOP, words("act.stop"), main=False),
    )
    return Todo(Tone.CALM, "task_alt", words("todo.nothing"), detail, acts)
