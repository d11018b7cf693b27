"""The safety inputs, read cyclically and told: to the executive as facts, to the arm as pace."""

import asyncio

from depal.cell.safety.judging import Judgement, facts_under, heard, judged, speed_under
from depal.cell.workplace import Workplace

PERIOD = 0.1
"""The inputs are read so often [s]."""

SOURCE = "safety"


class SafetyWatch:
    """Reads the safety controller, and never writes to it.

    Attributes:
        judgement: of the last reading; nothing is good before the first.
        since: since when it is so [s].
    """

    def __init__(self, work: Workplace) -> None:
        """Nothing was read yet."""
        self._work = work
        self.judgement = Judgement(good=False)
        self.since = 0.0

    def read(self) -> Judgement:
        """What the inputs say now."""
        return judged(heard(self._work.ports.safety), self._work.now, self.judgement)

    def look(self) -> None:
        """Reads the inputs and tells what has changed."""
        work, judgement = self._work, self.read()
        if judgement != self.judgement:
            self.judgement, self.since = judgement, work.now
        near = work.layout.speeds.near
        work.bounds.hold_below(speed_under(judgement, near))
        facts = work.runtime.engine.state.facts
        changes = [
            (key, value)
            for key, value in facts_under(judgement, near)
            if (facts.get(key) or None) != (value or None)
        ]
        if changes:
            work.tell(changes, SOURCE)

    async def keep(self) -> None:
        """Looks until it is cancelled."""
        while True:
            self.look()
            await asyncio.sleep(PERIOD)
