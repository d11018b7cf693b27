"""A cell at work for the tests of its controller: real motions, fake devices, simulated time."""

import asyncio
import re
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace

from depal.app.run.record import Keeper
from depal.cell.bookkeeping import Bookkeeping, WrittenArm, WrittenGripper
from depal.cell.controller import Controller
from depal.cell.departures import Fate
from depal.cell.files import shipped_cell
from depal.cell.planning.desk import MotionDesk
from depal.cell.planning.planner import Planner
from depal.cell.questions import Questions
from depal.cell.reporting import ChoiceNote, Journalist
from depal.cell.tasks import read_shipped_tasks
from depal.cell.timekeeping import Timekeeper, timed
from depal.cell.workplace import Ports, Settings, Workplace
from depal.domain import (
    EURO_PALLET,
    BoxId,
    CellLayout,
    Delivery,
    DeliveryLine,
    Detection,
    Gtin,
    Perceived,
    PlaceId,
    Product,
    Recognition,
    Request,
)
from depal.executive import events as ev
from depal.executive.clock import LoopClock, run_simulated
from depal.executive.journal import Journal
from depal.geometry import OrientedBox, Vector3
from depal.logistics.placing import Standing
from depal.ports import Question, View
from depal.ports.fakes import (
    FakeArm,
    FakeBays,
    FakeGripper,
    FakeOverride,
    FakePerson,
    FakeReader,
    FakeSafety,
    FakeSight,
    FakeStore,
)

SIZE: Vector3 = (0.25, 0.28, 0.22)
"""Depth, width and height of every box [m]."""

SPOTS = (-0.45, -0.15, 0.15, 0.45)
"""Where boxes stand beside each other along the pallet's front: y in the cell [m]."""

DECK = EURO_PALLET[2]

TROLLEYS = tuple(PlaceId(f"trolley_{n}/level_1") for n in (4, 1, 5, 2))

STORED, ASIDE, PERSON, LOST = Fate.STORED, Fate.SET_ASIDE, Fate.BY_PERSON, Fate.LOST

BROKEN = r"(?!DeviceError)\w+(Error|Exception): "
"""What no fault excuses: a primitive that broke, not a device."""

LONG = 20_000.0
"""A run that is not over by then never ends [s]."""


class Remembering(FakeSight):
    """A sight that measures with cameras, and errs."""

    async def look(self) -> View:
        """All that is believed."""
        return replace(await FakeSight.look(self), remembered=True)


def gtin(number: int) -> Gtin:
    """The product of a box by its number."""
    return Gtin(f"product-{number}")


def name(number: int) -> BoxId:
    """A box by its number, from 1 on."""
    return BoxId(f"b{number}")


def pile(boxes: int, unknown: Sequence[int] = ()) -> tuple[Perceived, ...]:
    """Boxes in a row along the front; some are detected and not recognised."""
    shapes = [
        OrientedBox.upright((1.55, SPOTS[number - 1], DECK + SIZE[2] / 2), SIZE)
        for number in range(1, boxes + 1)
    ]
    return tuple(
        Detection(name(number), shape)
        if number in unknown
        else Recognition(name(number), shape, gtin(number))
        for number, shape in enumerate(shapes, start=1)
    )


def note(boxes: int, mass: float = 4.0) -> Delivery:
    """A note of so many products, one case of each."""
    depth, width, height = SIZE
    lines = tuple(
        DeliveryLine(Product(gtin(n), f"product {n}", (width, depth, height), mass), 1)
        for n in range(1, boxes + 1)
    )
    return Delivery("tiny", EURO_PALLET, lines)


def note_of(*sizes: Vector3) -> Delivery:
    """A note of one case of each of some sizes: products g0, g1, and so on."""
    products = [Product(Gtin(f"g{k}"), "g", size, 4.0) for k, size in enumerate(sizes)]
    return Delivery("d", EURO_PALLET, tuple(DeliveryLine(each, 1) for each in products))


def homes(boxes: int) -> dict[Gtin, tuple[PlaceId, ...]]:
    """A place for every product, each in a trolley of its own."""
    return {gtin(n): (TROLLEYS[n - 1],) for n in range(1, boxes + 1)}


@dataclass(slots=True)
class Cell:
    """A cell with so many boxes in a row; change its parts, then let it work once.

    Attributes:
        boxes: how many.
        unknown: the numbers of those that the camera does not recognise.
        layout: of the cell.
        settings: of the run.
        full: places in which nothing has room.
        disk: what becomes of the journal on it.
        page: writes a page of the ledger.
    """

    boxes: int = 3
    unknown: Sequence[int] = ()
    layout: CellLayout = field(default_factory=lambda: shipped_cell("default"))
    settings: Settings = field(default_factory=Settings)
    full: Sequence[PlaceId] = ()
    gripper: FakeGripper = field(default_factory=FakeGripper)
    reader: FakeReader = field(default_factory=FakeReader)
    person: FakePerson = field(default_factory=FakePerson)
    bays: FakeBays = field(default_factory=FakeBays)
    places: Mapping[Gtin, tuple[PlaceId, ...]] | None = None
    refuses: frozenset[int] = frozenset()
    disk: Callable[[Journal], Journal] = lambda journal: journal
    page: Callable[[], None] = lambda: None
    seed: int = 0
    events: list[ev.Event] = field(default_factory=list)
    choices: list[ChoiceNote] = field(default_factory=list)
    started: list[str] = field(default_factory=list)
    blunders: list[str] = field(default_factory=list)
    arm: FakeArm = field(init=False)
    sight: FakeSight = field(init=False)
    store: FakeStore = field(init=False)
    work: Workplace = field(init=False)
    desk: MotionDesk = field(init=False)
    times: Timekeeper = field(init=False)
    books: Bookkeeping = field(init=False)
    sha256: str = field(init=False, default="")
    ended: float = field(init=False, default=0.0)
    still_held: bool = field(init=False, default=False)

    def __post_init__(self) -> None:
        """Puts the devices together."""
        self.arm = FakeArm(self.layout.robot.parked, self.gripper.load, refuses=self.refuses)
        self.sight = FakeSight([pile(self.boxes, self.unknown)])
        self.store = FakeStore(homes(self.boxes) if self.places is None else self.places)
        clock = LoopClock()
        self.times = Timekeeper(clock)
        ports = Ports(
            self.arm,
            self.gripper,
            self.reader,
            self.bays,
            FakeSafety(),
            self.person,
            self.store,
            self.sight,
            clock,
            FakeOverride(),
        )
        ports = timed(ports, self.times)
        questions = Questions(ports.person, clock)
        self.books = Bookkeeping(questions)
        ports = replace(
            ports,
            arm=WrittenArm(ports.arm, self.books),
            gripper=WrittenGripper(ports.gripper, self.books),
        )
        self.work = Workplace(self.layout, note(self.boxes), ports, self.settings, questions)
        self.desk = MotionDesk(self.work, Planner(self.work, self.times, seed=self.seed))
        for place in self.full:
            self.desk.promises.books = self.desk.promises.books.put(
                place, filling(self.layout, place)
            )

    def works(self, *requests: Request) -> "Cell":
        """Empties the pallet, to the end.

        Raises:
            TimeoutError: it never ends.
        """
        run_simulated(self._run(requests))
        return self

    async def _run(self, requests: Sequence[Request]) -> None:
        tasks = read_shipped_tasks()
        notes = Journalist()
        notes.listen(self._heard, self.choices.append)
        with Keeper.open(None, tasks) as keeper:
            keeper.listen_to(notes)
            journal = self.disk(keeper.journal)
            controller = Controller(self.work, self.desk, notes, tasks, journal, books=self.books)
            self.work.keep = self.books.keeping(self.page)
            await asyncio.wait_for(controller.empty_pallet(requests), LONG)
            self.sha256 = keeper.events_sha256
        self.ended = self.work.now
        self.still_held = bool(self.gripper.load())

    def _heard(self, _: int, events: Sequence[ev.Event]) -> None:
        trees = self.work.runtime.engine.state.trees
        self.events += events
        for event in events:
            if isinstance(event, ev.Started):
                label = trees[event.tree].nodes[event.node].node.label
                self.started.append(label)
                if label.startswith("kr60_reach") and self.gripper.load():
                    self.blunders.append(f"{label} with a full hand")
            if isinstance(event, ev.Ended) and re.match(BROKEN, event.reason):
                self.blunders.append(event.reason)

    # What came of it

    @property
    def fates(self) -> dict[str, Fate]:
        """What became of each box."""
        return {str(departure.box): departure.fate for departure in self.work.departures.sequence}

    @property
    def booked(self) -> dict[str, str]:
        """Where the books say that the boxes stand."""
        return {
            str(box.id): str(place_map.place.id)
            for place_map in self.desk.promises.books.maps
            for box in place_map.boxes
            if not box.id.startswith("full")
        }

    @property
    def placed(self) -> dict[str, str]:
        """Where boxes were put, by what became of them."""
        return {
            str(departure.box): str(departure.place)
            for departure in self.work.departures.sequence
            if departure.place is not None
        }

    def assert_whole(self) -> None:
        """What holds after every run, whatever has gone wrong in it."""
        assert self.blunders == []
        assert sorted(self.fates) == [name(n) for n in range(1, self.boxes + 1)]
        assert len(self.work.pile) == 0
        assert not self.still_held
        assert self.work.held is None
        stored = {box: place for box, place in self.placed.items() if self.fates[box] is STORED}
        assert {str(m.box): str(m.place) for m in self.store.movements} == stored
        assert self.booked == {
            box: place for box, place in self.placed.items() if not self._went_away(box, place)
        }
        assert self.work.questions.open == ()

    def _went_away(self, box: str, place: str) -> bool:
        """Whether the trolley in which a box stood was exchanged afterwards."""
        stored = [movement.at for movement in self.store.movements if movement.box == box]
        return any(
            place.startswith(bay) and stored and stored[0] <= at for at, bay in self.bays.exchanges
        )


def filling(layout: CellLayout, place: PlaceId) -> Standing:
    """A box that leaves no room in a place."""
    compartment = layout.places[place]
    width, height = compartment.opening
    corner = (0.0, -width / 2, 0.0)
    return Standing(BoxId(f"full {place}"), corner, (compartment.depth, width, height), 1.0)


def exchanged_by(bays: FakeBays) -> FakePerson:
    """A person who exchanges trolleys when asked."""

    def answer(question: Question) -> str:
        if question.id.startswith("exchange/"):
            bays.exchange(question.about)
        return question.choices[0]

    return FakePerson(answer)
