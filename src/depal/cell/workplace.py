"""Everything that a primitive works with: the ports, and what the cell believes."""

import asyncio
from collections import Counter
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field
from enum import Enum

from depal.cell.bounds import Bounds
from depal.cell.charges import Charges
from depal.cell.departures import Departure, Departures, Fate
from depal.cell.feedback import Feedback
from depal.cell.gate import Gate
from depal.cell.hand import Hand, Phase
from depal.cell.modules import Modules
from depal.cell.outbox import Outbox
from depal.cell.pile import Deck, Pile
from depal.cell.questions import Questions
from depal.cell.refusals import Refusals
from depal.cell.wishes import Wishes
from depal.domain import (
    Approach,
    BoxId,
    CellLayout,
    Delivery,
    Grasp,
    Gtin,
    Perceived,
    PlaceId,
    Product,
    Recognition,
)
from depal.executive.engine import Call, Engine
from depal.executive.events import Change
from depal.executive.runtime import Runtime
from depal.geometry import Vector3
from depal.perception.memory import Tally, tally_of
from depal.ports import (
    Arm,
    BarcodeReader,
    Bays,
    Clock,
    Gripper,
    Override,
    Person,
    Safety,
    Sight,
    StoreSystem,
)

FIRST = 10.0
"""A priority above that of any request."""

LEAKED = 2
"""Where cups have leaked on a box's top so often, there is no such top."""

PALLET = "pallet"
"""The name of the pallet's thing in the task files."""


@dataclass(frozen=True, slots=True)
class Ports:
    """The devices, people and systems of a cell."""

    arm: Arm
    gripper: Gripper
    reader: BarcodeReader
    bays: Bays
    safety: Safety
    person: Person
    store: StoreSystem
    sight: Sight
    clock: Clock
    override: Override


class Policy(Enum):
    """Which boxes may be taken."""

    PAPER = "paper"
    ACCESS = "access"


@dataclass(frozen=True, slots=True)
class Settings:
    """How a run is to go.

    Attributes:
        w: the weight of Eq. (3).
        policy: which boxes may be taken.
        speed: share of the arm's full speed, in (0, 1].
        charges: of simulated time.
        guard: whether a box waits that would leave a pile with too little margin.
    """

    w: float = 0.5
    policy: Policy = Policy.PAPER
    speed: float = 1.0
    charges: Charges = field(default_factory=Charges)
    guard: bool = False


@dataclass(frozen=True, slots=True)
class Held:
    """The box in the gripper.

    Attributes:
        box: its perceived name.
        grasp: how it is held.
        size: of the box along its own axes [m].
        mass: as felt at the flange [kg].
        beyond: how much longer the box may be along its axes, at either end [m].
    """

    box: BoxId
    grasp: Grasp
    size: Vector3
    mass: float
    beyond: Vector3 = (0.0, 0.0, 0.0)

    @classmethod
    def again(cls, hand: Hand) -> "Held":
        """Of the step that the ledger has last told of."""
        return cls(hand.box, hand.grasp, hand.size, hand.mass, hand.beyond)


@dataclass(frozen=True, slots=True)
class Difference:
    """A product of which the note promises another number than was found.

    Attributes:
        gtin: which.
        promised: by the note.
        found: on the pallet.
    """

    gtin: Gtin
    promised: int
    found: int


class Ending:
    """Something that begins and ends again and again, and can be waited for."""

    def __init__(self) -> None:
        """Not begun."""
        self._over: asyncio.Event | None = None

    def begin(self) -> bool:
        """Begins, unless it runs; whether it did."""
        if self._over is not None:
            return False
        self._over = asyncio.Event()
        return True

    def end(self) -> None:
        """Ends: whoever waits goes on."""
        if self._over is not None:
            self._over.set()
            self._over = None

    async def wait(self) -> None:
        """Waits until it has ended."""
        if self._over is not None:
            await self._over.wait()


def nothing_kept() -> None:
    """A run that no restart has to go on with."""


@dataclass(slots=True)
class Workplace:
    """What the primitives share.

    Attributes:
        layout: the cell.
        delivery: the note; its stack is not read here.
        ports: everything outside.
        settings: of the run.
        questions: to the supervising person.
        impossible: products that the arm cannot handle, and why.
        pile: what stands on the pallet.
        outbox: what the store's system is to be told.
        wishes: what is wanted.
        departures: what became of the boxes.
        runtime: the executive; set once it is bound.
        held: the box in the gripper.
        left_behind: boxes that stay on the pallet, and why.
        passed_over: boxes that the arm set out for in vain, and that may be chosen anew.
        aside_reasons: why boxes are set aside.
        doubted: boxes that were not as they looked: they are looked at before another try.
        unplaceable: boxes in the gripper that weigh like two, or of which nobody knows where they
            end: a person takes out what hangs there.
        stranded: why a box in the gripper comes into no place at all.
        tries: how often the gripper had no hold of a box that it was at.
        leaks: how often some cups sealed on a box's top and others did not.
        refusals: boxes that no way led to.
        strangers: what the reader saw on boxes that are not on the note.
        homeless: boxes for which the store's system has named no place.
        seen_to: whether a person has looked for what the note promises and no look shows.
        modules: of the gripper, and which of them are dead.
        feedback: told what the work finds out about boxes.
        hand: the physical step that the box in the gripper is in.
        keep: writes what must not be forgotten; called before and after every such step.
        gate: closed while no further box is to be begun.
        plans: closed after a restart until the arm stands where plans can begin.
        bounds: what the arm may not exceed.
    """

    layout: CellLayout
    delivery: Delivery
    ports: Ports
    settings: Settings
    questions: Questions
    impossible: Mapping[Gtin, str] = field(default_factory=dict)
    pile: Pile = field(init=False)
    bounds: Bounds = field(init=False)
    outbox: Outbox = field(init=False)
    wishes: Wishes = field(default_factory=lambda: Wishes(()))
    departures: Departures = field(default_factory=Departures)
    held: Held | None = None
    left_behind: dict[BoxId, str] = field(default_factory=dict)
    passed_over: set[BoxId] = field(default_factory=set)
    aside_reasons: dict[BoxId, str] = field(default_factory=dict)
    doubted: dict[BoxId, frozenset[Approach]] = field(default_factory=dict)
    unplaceable: set[BoxId] = field(default_factory=set)
    stranded: dict[BoxId, str] = field(default_factory=dict)
    tries: dict[BoxId, int] = field(default_factory=dict)
    leaks: Counter[BoxId] = field(default_factory=Counter)
    refusals: Refusals = field(default_factory=Refusals)
    strangers: dict[BoxId, str] = field(default_factory=dict)
    homeless: set[BoxId] = field(default_factory=set)
    seen_to: bool = False
    modules: Modules = field(default_factory=Modules)
    feedback: Feedback = field(default_factory=Feedback)
    hand: Hand | None = None
    keep: Callable[[], None] = nothing_kept
    gate: Gate = field(default_factory=Gate)
    plans: Gate = field(default_factory=Gate)
    _exchanges: dict[str, "Ending"] = field(default_factory=dict)
    _gone: dict[BoxId, asyncio.Event] = field(default_factory=dict)
    _runtime: Runtime | None = None

    def __post_init__(self) -> None:
        """The pile stands on the cell's pallet."""
        self.outbox = Outbox(self.ports.store)
        self.bounds = Bounds(self.ports.override)
        self.pile = Pile(Deck.of(self.layout.pallet.cell_from_pallet))

    def bind(self, runtime: Runtime) -> None:
        """The executive that the primitives work for."""
        self._runtime = runtime

    @property
    def runtime(self) -> Runtime:
        """The executive.

        Raises:
            RuntimeError: it is not bound yet.
        """
        if self._runtime is None:
            raise RuntimeError("the workplace is not bound to a runtime")
        return self._runtime

    @property
    def engine(self) -> Engine | None:
        """What decides; None before it is bound."""
        return None if self._runtime is None else self._runtime.engine

    @property
    def now(self) -> float:
        """The time [s]."""
        return self.ports.clock.now()

    def tell(self, facts: Iterable[Change], source: str) -> None:
        """Facts that the world has changed."""
        self.runtime.change(facts, source)

    def allocate(self, *calls: Call) -> None:
        """Tasks that follow."""
        self.runtime.allocate(*calls)

    def gone(self, box: BoxId) -> asyncio.Event:
        """Set once a box has left the pallet, or never will, and the view of the pile is clear."""
        return self._gone.setdefault(box, asyncio.Event())

    def lifted(self, held: Held) -> None:
        """The arm has lifted a box off the pallet."""
        box, self.held = held.box, held
        self.pile.take(box, self.now)
        self.departures.leaves(box, self.now)
        product = self.product_of(box)
        self.wishes.left(box, product.gtin if product else None, self.now)
        self.steps(Phase.HELD)

    def begins(self, hand: Hand) -> None:
        """A physical step is about to begin: it is written before anything moves."""
        self.hand = hand
        self.keep()

    def steps(self, phase: Phase, place: PlaceId | None = None) -> None:
        """The box in the gripper comes into another phase: written before anything moves."""
        held = self.held
        if held is not None:
            self.begins(Hand(held.box, held.grasp, held.size, held.mass, phase, place, held.beyond))

    def lets_go(self) -> None:
        """The gripper is empty, and the step over."""
        self.hand = None
        self.keep()

    def ended(self, box: BoxId, fate: Fate, place: PlaceId | None = None, reason: str = "") -> None:
        """It is known what became of a box."""
        held = self.held if self.held is not None and self.held.box == box else None
        product = self.product_of(box)
        gtin = product.gtin if product else None
        if not self.departures.has_left(box):
            self.pile.take(box, self.now)
            self.wishes.left(box, gtin, self.now)
        approach = held.grasp.approach if held else None
        self.departures.ends(Departure(box, gtin, approach, place, fate, reason, self.now))
        if held:
            self.held = self.hand = None
        self.keep()
        self.gone(box).set()

    def dropped(self, box: BoxId) -> None:
        """A box has fallen out of the gripper: a person is called before anything else moves."""
        self.ended(box, Fate.LOST, reason="fell out of the gripper")
        self.tell([(f"{box}.taken", False), (f"{box}.on_floor", True)], "gripper")
        self.allocate(Call("recover", (box,), FIRST))

    def fallen(self, box: BoxId) -> None:
        """A box was seen, nobody has taken it, and it is gone: a person picks it up."""
        self.ended(box, Fate.LOST, reason="fell off the pallet")
        self.tell([(f"{box}.on_floor", True)], "camera")
        self.allocate(Call("recover", (box,), FIRST))

    def deny(self, box: Perceived) -> None:
        """A box is not there, a person says: neither now nor later, as long as it looks so."""
        self.pile.forget(box.id, self.now)
        self.feedback.deny(box.id)

    def has_no_such_top(self, box: BoxId) -> bool:
        """Whether a box's top is not where it seems: some cups found hold on it, others did not."""
        return self.leaks[box] >= LEAKED

    def mistrust(self, box: BoxId, reasons: Iterable[str]) -> None:
        """A box in the gripper is not what it was taken for: it will be shown to the reader."""
        self.pile.doubt(box)
        self.wishes.doubted(box)
        self.aside_reasons[box] = "; ".join(reasons)
        facts = [(f"{box}.known", False), (f"{box}.product", None), (f"{box}.target", None)]
        self.tell(facts, "scale")

    def tally(self) -> Tally:
        """The note beside what has left the pallet and what is believed to stand there."""
        there = [box.gtin if isinstance(box, Recognition) else None for box in self.pile.boxes]
        return tally_of(self.delivery.lines, (*self.pile.left_as, *there))

    def surplus(self, gtin: Gtin) -> str | None:
        """Why a box that has left cannot be of a product: there were too many already."""
        left = [each for each in self.pile.left_as if each is not None]
        for surplus in tally_of(self.delivery.lines, left).surplus:
            if surplus.gtin == gtin:
                return str(surplus)
        return None

    def note_differences(self) -> tuple[Difference, ...]:
        """Where the note and what was found differ, product by product."""
        found = Counter(gtin for gtin in self.pile.left_as if gtin is not None)
        found.update(Gtin(code) for code in self.strangers.values())
        tally = self.tally()
        if not tally.missing and not tally.surplus and not self.strangers:
            return ()  # boxes that nobody has named may be what seems to be missing
        promised = {line.product.gtin: line.count for line in self.delivery.lines}
        return tuple(
            Difference(gtin, promised.get(gtin, 0), found[gtin])
            for gtin in sorted({*promised, *found})
            if promised.get(gtin, 0) != found[gtin]
        )

    def exchange_of(self, trolley: str) -> Ending:
        """The exchange of a trolley."""
        return self._exchanges.setdefault(trolley, Ending())

    def product_of(self, box: Perceived | BoxId) -> Product | None:
        """The product of a box, where it is known and on the note."""
        name = box if isinstance(box, str) else box.id
        gtin = self.runtime.engine.state.facts.get(f"{name}.product")
        return self.delivery.products.get(Gtin(str(gtin))) if gtin else None
