"""What needs an action of a person, from a run."""

from collections.abc import Iterator

from depal.app.serve.session import Session, Stage
from depal.server.cellstate import Alarm

RESTART = "restart"
"""The name of the alarm that says what a restart has found."""


def alarms_of(session: Session, now: float) -> tuple[Alarm, ...]:
    """The alarms of a run, the most urgent first; where nothing can be written, that alone.

    Args:
        session: the run.
        now: the time [s].
    """
    if session.stage is Stage.UNWRITTEN:
        todo = "Make room, then press Start."
        return (Alarm("unwritten", session.reason, todo, now),)
    return tuple(sorted(_all(session), key=lambda alarm: not alarm.urgent))


def _all(session: Session) -> Iterator[Alarm]:
    if session.stage is Stage.RECOVERED and session.found is not None:
        text = f"The controller was started anew; the sensors say: {session.found.value}"
        yield Alarm(RESTART, text, "Look at the cell, then press Start.", session.began)
    for asked in session.person.open:
        yield Alarm(asked.id, asked.text, "Answer the question.", asked.asked, asked.blocks)
    for place, since in session.wired.desk.carrying.blocked.items():
        text = f"Something stands in {place} that the cell has not put there."
        yield Alarm(f"blocked/{place}", text, "Take it out.", since)
    safety = session.wired.controller.safety
    if not safety.judgement.good and session.stage is Stage.WORKING:
        text, todo = f"Nothing moves: {safety.judgement.reason}.", "See to the safety controller."
        yield Alarm("safety", text, todo, safety.since, urgent=True)
