"""The referee looks on while a run goes: the invariants after every step of the executive.

RELIABILITY, "Invariants": I1 to I5 and I7 at each step and at the beginning of each motion, I6 by a
watch beside the run. The first one that is broken ends the run, for what comes after it tells
nothing.
"""

import asyncio
from collections import Counter
from collections.abc import Coroutine, Iterable, Iterator, Mapping, Sequence
from typing import Any

import numpy as np

from depal.app.run.summary import disagreements
from depal.cell.bookkeeping import RECORDS
from depal.cell.departures import Departure, Fate
from depal.cell.hand import Phase
from depal.cell.primitives.restarting import ARM
from depal.cell.reporting import Journalist
from depal.cell.workplace import Workplace
from depal.domain import BoxId
from depal.executive import events as ev
from depal.motion.kinematics import Kinematics
from depal.ports import Trajectory
from depal.simulation.cell import SimulatedCell
from depal.simulation.contacts import Collision
from depal.simulation.referee import FLOOR
from depal.simulation.witness import name_of

DECISION = "decision/"
"""How questions about a box on the floor begin."""

NEAR = 0.5
"""So near to a box that is known to lie on the floor no motion comes [m]."""

APPROACH = 0.05
"""Closer than this to where it was before, the arm comes nearer [m]."""

BRIEF = 5.0
"""For so long the books may not say what is so: a sensor has to be asked first [s]."""

STILL = 900.0
"""Without a motion for so long, and without a question, there is no progress [s]."""

OFTEN = 5.0
"""The watch looks so often [s]."""

RESTS = 1.0
"""After a stop the arm is at rest in this time [s]."""

SLOW = 0.01
"""An axis that turns no faster than this rests [rad/s]."""


FALLING = 1.0
"""A box that has been pulled out of the hand falls past the arm, which brakes, for so long [s]."""


def undue(hits: Iterable[Collision], fell: Mapping[int, float]) -> Iterator[Collision]:
    """The collisions that a motion has caused: not those of an arm that brakes with what falls.

    Args:
        hits: all.
        fell: when each box was pulled out of the hand [s].
    """
    for hit in hits:
        names = (f"box {box}" for box, at in fell.items() if 0.0 <= hit.at - at <= FALLING)
        if {hit.who, hit.against}.isdisjoint(names):
            yield hit


class Inspector:
    """Checks a run as it goes.

    Attributes:
        broken: the first invariant that did not hold, with its time, in words; empty so far.
        checks: how often all was checked.
    """

    def __init__(self, work: Workplace, cell: SimulatedCell, fell: Mapping[int, float]) -> None:
        """Beside a controller and the world that it works in.

        Args:
            work: what the controller believes.
            cell: knows what is so.
            fell: when each box was pulled out of the hand [s]; it grows.
        """
        self._work, self._cell, self._fell = work, cell, fell
        self._kinematics = Kinematics(cell.world.layout.robot)
        self._ended: Counter[str] = Counter()
        self._since: dict[str, float] = {}
        self._moved = 0.0
        self._stopped: float | None = None
        self._over = asyncio.Event()
        self.broken = ""
        self.checks = 0

    def listen_to(self, notes: Journalist) -> None:
        """Checks after every step of the executive."""
        notes.listen(heard=self._heard)

    async def over(self, working: Coroutine[Any, Any, None]) -> None:
        """Returns once a run is over, or an invariant is broken; then it is broken off."""
        run = asyncio.get_running_loop().create_task(working)
        watch = asyncio.get_running_loop().create_task(self.violated())
        try:
            await asyncio.wait([run, watch], return_when=asyncio.FIRST_COMPLETED)
        finally:
            watch.cancel()
            if not run.done():
                run.cancel()
        if run.done() and not run.cancelled():
            run.result()

    async def violated(self) -> None:
        """Returns once an invariant is broken; looks by itself as well."""
        while not self._over.is_set():
            try:
                await asyncio.wait_for(self._over.wait(), OFTEN)
            except TimeoutError:
                self._check([*self._at_any_time(), *self._progress()])

    def moves(self, trajectory: Trajectory) -> None:
        """A motion begins."""
        self._moved = self._work.now
        self._check([*self._at_any_time(), *self._motion(trajectory)])

    def _heard(self, _: int, events: Sequence[ev.Event]) -> None:
        for event in events:
            facts = event.facts if isinstance(event, ev.Ended | ev.Changed) else ()
            self._ended.update(key for key, value in facts if key.endswith(".stored") and value)
        self._check(self._at_any_time())

    def _check(self, found: Iterable[str]) -> None:
        self.checks += 1
        for line in found:
            if not self.broken:
                self.broken = f"{line} ({self._work.now:.3f} s)"
                self._over.set()
            return

    # The invariants

    def _at_any_time(self) -> Iterator[str]:
        world, work = self._cell.world, self._work
        world.advance(work.now)
        yield from self._lasting(self._books())
        held = world.suction.held_boxes
        if work.hand is not None and work.hand.phase is not Phase.GRASPING and len(held) > 1:
            yield f"I2: boxes {', '.join(map(str, held))} are in the hand"
        for key, times in self._ended.items():
            if times > 1:
                yield f"I3: {key} was told {times} times"
        for hit in undue(world.contacts.collisions, self._fell):
            yield f"I5: {hit.who} against {hit.against} at {hit.at:.3f} s, {hit.force:.0f} N"
        yield from self._rest()

    def _books(self) -> Iterator[str]:
        """I1 and I4: where the books and the truth differ."""
        work, referee = self._work, self._cell.referee
        names = {name_of(case.index): case.index for case in self._cell.world.cases}
        stack = {**names, **self._cell.witness.indices}
        asked = {asked.question.about for asked in work.questions.open}
        ended = [gone for gone in work.departures.sequence if not self._unclear(gone, asked)]
        differing = disagreements(referee, ended, (), stack)
        if differing:
            flagged = {each.gtin for each in work.note_differences()}
            differing = disagreements(referee, ended, (), stack, flagged)
        for line in differing:
            yield f"I1, I4: {line}"
        held = work.held
        if held is not None and not asked:
            where = referee.where(stack[held.box]) if held.box in stack else "nowhere"
            if where != "hand":
                yield f"I1: box {held.box}: the books say hand, it is in {where}"

    @staticmethod
    def _unclear(gone: Departure, asked: set[str]) -> bool:
        """Whether an alarm says that it is not known where a box is, or that it fell."""
        return gone.fate is Fate.LOST or gone.box in asked

    def _lasting(self, lines: Iterator[str]) -> Iterator[str]:
        """Those that have been so for longer than a moment."""
        found, now = set(lines), self._work.now
        self._since = {line: self._since.get(line, now) for line in found}
        for line, since in self._since.items():
            if now - since > BRIEF:
                yield line

    def _rest(self) -> Iterator[str]:
        """I7: with bad safety inputs the arm comes to rest and stays there."""
        now, safety = self._work.now, self._cell.safety.state()
        if not (safety.stopped or safety.gate_open):
            self._stopped = None
            return
        if self._stopped is None:  # as of now: when it began, between two looks, nobody knows
            self._stopped = now
        fastest = float(np.abs(self._cell.world.data.qvel[:6]).max())
        if now - self._stopped > RESTS and fastest > SLOW:
            yield f"I7: the arm moves {now - self._stopped:.1f} s after a safety stop"

    def _progress(self) -> Iterator[str]:
        work = self._work
        since = max(self._moved, *(asked.answered or 0.0 for asked in work.questions.all), 0.0)
        if work.now - since > STILL and not work.questions.open:
            yield f"I6: nothing has moved for {work.now - since:.0f} s, and nobody is asked"

    def _motion(self, trajectory: Trajectory) -> Iterator[str]:
        """I5 and I7: what no motion may begin against."""
        for asked in self._work.questions.open:
            question = asked.question
            if question.about in {ARM, RECORDS} or question.id.startswith(DECISION):
                yield f"I5, I7: the arm moves before {question.id} is answered"
        for box in self._on_floor():
            nearest, before = self._distances(trajectory, box)
            if nearest < min(NEAR, before - APPROACH):
                yield f"I5: the arm comes within {nearest:.2f} m of box {box} on the floor"

    def _on_floor(self) -> Iterator[int]:
        """The boxes that lie on the floor, and of which the cell knows that they do."""
        facts = self._work.runtime.engine.state.facts
        for case in self._cell.world.cases:
            name = self._name(case.index)
            if facts.get(f"{name}.on_floor") and self._cell.referee.where(case.index) == FLOOR:
                yield case.index

    def _name(self, index: int) -> BoxId:
        named = self._cell.witness.indices
        return next((name for name, box in named.items() if box == index), name_of(index))

    def _distances(self, trajectory: Trajectory, box: int) -> tuple[float, float]:
        """How near the tool comes to a box, and how near it is when it sets out [m]."""
        tool, folded = self._work.layout.tool, self._cell.world.suction.folded
        at = np.array(self._cell.world.box(box).translation)
        ways = [tool.module(m.name, folded=folded).flange_from_face for m in tool.modules]
        found = []
        for row in trajectory.positions[:: max(1, len(trajectory.positions) // 40)]:
            flange = self._kinematics.flange(row)
            tips = [np.array((flange @ way).translation) for way in ways]
            found.append(min(float(np.linalg.norm(tip - at)) for tip in tips))
        return min(found), found[0]
