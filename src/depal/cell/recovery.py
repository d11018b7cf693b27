"""A controller that is started anew in the middle of a run: held, reconciled, and on again.

RELIABILITY, "The core protocol": a step that was begun and of which nobody knows the end is never
simply run again. What the ledger tells and what the sensors tell decide; what they leave open a
person decides. Nothing moves before a person has said start.
"""

import asyncio
from contextlib import suppress

from depal.cell.answers import ASIDE, OF_BOXES, STORE
from depal.cell.clearing import get_clear
from depal.cell.departures import Fate
from depal.cell.guards import Guards
from depal.cell.hand import Hand, Phase
from depal.cell.ledger.reconciling import Found, Sensed, reconcile
from depal.cell.planning.desk import Desk
from depal.cell.primitives.restarting import OVER
from depal.cell.stock import movement_id
from depal.cell.workplace import FIRST, PALLET, Held, Workplace
from depal.domain import BoxId
from depal.errors import DeviceError
from depal.executive.engine import Call
from depal.ports import TAKEN, Movement, Question

HANGS, STANDS, ON_PALLET = (
    "it hangs in the gripper",
    "it stands in its place",
    "it stands on the pallet",
)

MEANT = {
    HANGS: Found.HOLDING,
    STANDS: Found.SET_DOWN,
    ON_PALLET: Found.LET_GO,
    TAKEN: Found.NOTHING,
}
"""What a person's answer says about a box that nobody knows about."""

SETTLING = 0.05
"""The probes of a restart are asked for every so often [s]."""

ARM_AT = "kr60.at"


class Recovery:
    """Brings a restored workplace and the world to the same story."""

    def __init__(self, work: Workplace, desk: Desk, hand: Hand | None) -> None:
        """Before the executive goes on.

        Args:
            work: restored from the ledger; its runtime is folded from the journal and held.
            desk: plans the way out.
            hand: the step that the ledger has last told of.
        """
        self._work, self._desk, self._hand = work, desk, hand
        self.found = Found.NOTHING
        work.plans.close()

    def examine(self) -> Found:
        """Reads the sensors; nothing moves, and asking again does no harm."""
        ports = self._work.ports
        vacuum = any(value > 0.0 for value in ports.gripper.vacuum().values())
        self.found = reconcile(self._hand, Sensed(vacuum, ports.arm.load()))
        if self.found is Found.HOLDING and self._hand is not None:
            self._takes_over(self._hand)
        return self.found

    def _takes_over(self, hand: Hand) -> None:
        held = Held.again(hand)
        if not self._work.departures.has_left(hand.box):
            self._work.lifted(held)  # the controller ended between the lift and its report
            return
        self._work.held = held
        # Until the arm is clear it is in the place: whoever takes over next must know which.
        self._work.begins(hand)

    def _hangs(self, hand: Hand) -> None:
        """The arm is clear, and the box hangs on it: its spot is free."""
        self._desk.promises.gone(hand.box)
        self._work.steps(Phase.HELD)

    async def go_on(self) -> None:
        """A person has said start: what is open is asked, the arm gets clear, the facts are set."""
        await self._probed()
        if self.found is Found.UNKNOWN:
            await (self._empty_hand() if self._hand is None else self._ask(self._hand))
        await self._settle()
        self._work.plans.open()
        self._work.runtime.start("person")

    async def _probed(self) -> None:
        """Waits until the probes that the restart has begun are through."""
        attempts = self._work.runtime.engine.state.attempts
        while any(each.in_doubt for each in attempts.values()):  # noqa: ASYNC110 - they are short
            await asyncio.sleep(SETTLING)

    async def _empty_hand(self) -> None:
        """Something hangs on the arm, and no step is known that it could be in."""
        text = (
            "The cell was started anew and something hangs on the arm that it does not know of. "
            "Please hold it, take it out of the gripper and out of the cell."
        )
        question = Question("restart/arm", text, (TAKEN,), "arm")
        await self._work.questions.ask(question)
        await self._work.ports.gripper.release()
        self.found = Found.NOTHING

    async def _ask(self, hand: Hand) -> None:
        choices = (HANGS, *((STANDS,) if hand.place is not None else ()), ON_PALLET, TAKEN)
        question = Question(
            f"restart/{hand.box}",
            f"The cell was started anew while it moved box {hand.box}, and its sensors cannot "
            "tell where that is. Where is it?",
            choices,
            str(hand.box),
        )
        answer = await self._work.questions.ask(question)
        self.found = MEANT[answer]
        if self.found is Found.HOLDING:
            self._takes_over(hand)
        elif answer == TAKEN:
            self._desk.promises.gone(hand.box)
            self._work.ended(hand.box, Fate.BY_PERSON, reason="taken after a restart")

    async def _settle(self) -> None:
        """Motions first, then the facts, so that nobody acts on what is not so yet."""
        work, hand = self._work, self._hand
        guards = Guards(work.ports.arm, work.ports.gripper, work.ports.safety)
        if self.found in {Found.SET_DOWN, Found.LET_GO}:
            await work.ports.gripper.release()
        if self.found is Found.HOLDING:
            lost = await get_clear(work, self._desk, guards.holding())
            if lost is not None:
                self.found = Found.DROPPED
                await work.ports.gripper.release()
            elif hand is not None:
                self._hangs(hand)
        else:
            await get_clear(work, self._desk)
        with suppress(DeviceError):  # what was believed before stands until a picture comes
            work.pile.see(await work.ports.sight.look())
        if hand is not None:
            await self._tell(hand)
        await self._tell_what_has_ended()
        self._forget_the_rest(hand)
        self._withdraw_what_waits()

    async def _tell(self, hand: Hand) -> None:
        work, box = self._work, hand.box
        match self.found:
            case Found.HOLDING:
                self._facts(hand, taken=True)
                self._with_a_task(hand)
            case Found.SET_DOWN | Found.PLACED if hand.place is not None:
                await self._placed(hand)
            case Found.DROPPED:
                self._desk.promises.gone(box)
                work.dropped(box)
                self._facts(hand, taken=False)
            case _:
                self._desk.promises.gone(box)
                work.lets_go()
                self._facts(hand, taken=False)

    def _facts(self, hand: Hand, *, taken: bool) -> None:
        self._work.tell([(f"{hand.box}.taken", taken), (ARM_AT, None)], "restart")

    def _with_a_task(self, hand: Hand) -> None:
        """A box in the hand is worked on by somebody; else it is set aside."""
        trees = self._work.runtime.engine.state.trees.values()
        roots = [tree.root.node for tree in trees if tree.withdrawn is None]
        if not any(r.args[:1] == (hand.box,) and r.schema.name in OF_BOXES for r in roots):
            self._work.aside_reasons.setdefault(hand.box, "nobody worked on it after a restart")
            self._work.allocate(Call(ASIDE, (hand.box,), FIRST))

    async def _placed(self, hand: Hand) -> None:
        work, box, place = self._work, hand.box, hand.place
        if place is None:
            return
        aside = place.split("/", maxsplit=1)[0] == work.layout.aside
        work.held = Held.again(hand)
        reason = work.aside_reasons.get(box, "set aside") if aside else ""
        work.ended(box, Fate.SET_ASIDE if aside else Fate.STORED, place, reason)
        if aside:
            work.tell([(f"{box}.taken", False), (f"{box}.at", "aside"), (ARM_AT, None)], "restart")
            return

    async def _tell_what_has_ended(self) -> None:
        """What the ledger knows to be over, and the executive or the store may not."""
        work = self._work
        facts = work.runtime.engine.state.facts
        for departure in work.departures.sequence:
            box, place = departure.box, departure.place
            if departure.fate is Fate.STORED and place:
                # Told before or not: it counts once.
                name = movement_id(box, place)
                await work.outbox.tell(Movement(name, box, departure.gtin, place, work.now))
                if facts.get(f"{box}.stored"):
                    continue
                work.tell([(f"{box}.taken", False), (f"{box}.stored", True)], "restart")
            elif departure.fate is Fate.SET_ASIDE and not facts.get(f"{box}.at"):
                work.tell([(f"{box}.taken", False), (f"{box}.at", "aside")], "restart")
            elif departure.fate in {Fate.BY_PERSON, Fate.LOST}:
                self._withdraw(box)

    def _withdraw(self, box: BoxId) -> None:
        """Nobody works on a box any more that somebody has taken, or that fell."""
        for number, tree in list(self._work.runtime.engine.state.trees.items()):
            root = tree.root.node
            if root.args[:1] == (box,) and root.schema.name in OF_BOXES:
                self._work.runtime.withdraw(number, "the box has left the cell")

    def _forget_the_rest(self, hand: Hand | None) -> None:
        """The arm is nowhere and stands clear, and no box but the one in the hand is in it."""
        facts = self._work.runtime.engine.state.facts
        held = None if hand is None or self.found is not Found.HOLDING else f"{hand.box}.taken"
        stale = [
            (key, False)
            for key, value in facts.items()
            if key.endswith(".taken") and value and key != held
        ]
        self._work.tell([*stale, (ARM_AT, None), *OVER], "restart")

    def _withdraw_what_waits(self) -> None:
        """What stands on the pallet is looked at and chosen anew: names may have changed."""
        work = self._work
        for number, tree in list(work.runtime.engine.state.trees.items()):
            root = tree.root.node
            box = BoxId(root.args[0]) if root.args else None
            waits = root.schema.name == STORE and box is not None
            if waits and box is not None and not work.departures.has_left(box):
                work.runtime.withdraw(number, "the cell was started anew")
        # A restart before may have withdrawn it already, and have ended before anybody heard.
        chosen = work.runtime.engine.state.facts.get(f"{PALLET}.next")
        if chosen and not work.departures.has_left(BoxId(str(chosen))):
            work.gone(BoxId(str(chosen))).set()
