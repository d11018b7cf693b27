"""The mode of the cell in PackML's terms, from the run and its alarms."""

from collections.abc import Sequence

from depal.app.serve.alarms import RESTART
from depal.app.serve.session import Session, Stage
from depal.cell.halting import ABORTED, STOPPED
from depal.server.cellstate import Alarm, Mode

EXCHANGE = "/exchange/"
"""What the names of questions after another trolley have in them."""


STANDING = {
    Stage.DONE: (Mode.COMPLETE, "The pallet is empty."),
    Stage.STOPPED: (Mode.STOPPED, "Stopped after a box. Press Start to go on."),
    Stage.HELD: (Mode.HELD, "Held by a person. Press Resume to go on."),
    Stage.UNWRITTEN: (Mode.HELD, "Nothing can be written. Make room, then press Start."),
    Stage.RECOVERED: (Mode.HELD, "The controller was started anew. Press Start to go on."),
}


def mode_of(session: Session | None, alarms: Sequence[Alarm]) -> tuple[Mode, str]:
    """The mode and why, for people."""
    if session is None:
        trouble = next((alarm.text for alarm in alarms if alarm.urgent), "")
        return (Mode.STOPPED, trouble) if trouble else (Mode.IDLE, "No delivery is started.")
    inputs = session.wired.controller.safety.read()
    if inputs.tripped:
        return Mode.ABORTED, "A safety stop is active."
    if inputs.suspended and session.stage is Stage.WORKING:
        return Mode.SUSPENDED, f"Nothing moves: {inputs.reason}."
    if session.stage is Stage.WORKING:
        return _working(session)
    mode, reason = STANDING[session.stage]
    return mode, next((alarm.text for alarm in alarms if alarm.id == RESTART), reason)


def _working(session: Session) -> tuple[Mode, str]:
    """Working, unless everything waits for an answer."""
    facts = session.wired.controller.runtime.engine.state.facts
    if facts.get(STOPPED):
        mode = Mode.ABORTED if facts.get(ABORTED) else Mode.HELD
        return mode, f"The arm has stopped: {facts[STOPPED]}"
    unwritten = session.wired.controller.books.error
    if unwritten is not None:
        return Mode.HELD, f"Nothing moves, for what is done cannot be written: {unwritten}"
    waited_for = [question for question in session.person.open if question.blocks]
    if not waited_for or _moves(session):
        return Mode.EXECUTE, "Boxes are being moved."
    outside = [question for question in waited_for if EXCHANGE in question.id]
    if len(outside) == len(waited_for):
        return Mode.SUSPENDED, outside[0].text
    held = next(question for question in waited_for if EXCHANGE not in question.id)
    return Mode.HELD, held.text


def _moves(session: Session) -> bool:
    """Whether something goes on that has not asked anybody."""
    attempts = session.wired.controller.runtime.engine.state.attempts.values()
    return any(attempt.node.action.name not in ASKING for attempt in attempts)


ASKING = frozenset(
    {
        "select_box",
        "ask_target",
        "await_box",
        "await_trolley",
        "call_for_exchange",
        "ask_decision",
        "ask_to_take",
        "await_answer",
        "kr60_show",
        "read_barcode",
    }
)
"""Actions in which a person may be waited for."""
