"""The cell as people and systems see it: one frozen value, made anew at each change."""

from dataclasses import dataclass, field
from enum import Enum

from depal.geometry import Vector3


class Mode(Enum):
    """The state of the cell in PackML's terms.

    Idle: nothing to do, or a delivery waits to be started. Execute: boxes are moved. Held: a
    person is needed. Suspended: something outside is waited for. Stopped: a person has stopped it.
    Aborted: the safety controller has stopped it. Complete: the pallet is empty.
    """

    IDLE = "idle"
    EXECUTE = "execute"
    HELD = "held"
    SUSPENDED = "suspended"
    STOPPED = "stopped"
    ABORTED = "aborted"
    COMPLETE = "complete"


@dataclass(frozen=True, slots=True)
class Solid:
    """An upright box in the cell frame.

    Attributes:
        centre: [m].
        size: along its own axes [m].
        yaw: by which it is turned [rad].
    """

    centre: Vector3
    size: Vector3
    yaw: float


@dataclass(frozen=True, slots=True)
class QueueLine:
    """One box on the pallet, in the order of the last selection.

    Attributes:
        box: its name.
        gtin: its product; None where it is only detected.
        name: of the product, as the store calls it.
        solid: where it stands.
        h: Eq. (1) [m].
        l: Eq. (2).
        s: Eq. (3).
        fate: what the last selection made of it.
        reason: the fate in words.
        blockers: the boxes that must go before it.
        requested: whether a request aims at it.
    """

    box: str
    gtin: str | None
    name: str
    solid: Solid
    h: float
    l: float  # noqa: E741 - the paper's name
    s: float
    fate: str
    reason: str
    blockers: tuple[str, ...] = ()
    requested: bool = False


@dataclass(frozen=True, slots=True)
class StandingBox:
    """A box that was put into a place.

    Attributes:
        box: its name.
        gtin: its product, where it is known.
        place: the compartment.
        solid: where it stands.
    """

    box: str
    gtin: str | None
    place: str
    solid: Solid


@dataclass(frozen=True, slots=True)
class TrolleyState:
    """A trolley's bay or a shelf.

    Attributes:
        id: its name.
        present: whether a trolley stands locked there; a shelf always does.
        boxes: how many boxes stand in it.
        fill: the share of its room that they take, in [0, 1].
        full: whether no box has fitted lately.
        exchanging: whether somebody is asked to exchange it.
        aside: whether it takes what is set aside.
    """

    id: str
    present: bool
    boxes: int
    fill: float
    full: bool
    exchanging: bool
    aside: bool = False


@dataclass(frozen=True, slots=True)
class RequestState:
    """A request that has not ended.

    Attributes:
        key: its name.
        gtin: the wanted product, or None.
        box: the wanted box, or None.
        priority: p in [0, 1].
        waits: since when, of the cell's clock [s].
        due: on the cell's clock [s], if at all.
        aims: the box that it aims at; None while none is known.
        boxes_before: how many boxes leave before it, as it looks now; None while nobody knows.
        minutes: until it is served, as it looks now; None while nobody knows.
    """

    key: str
    gtin: str | None
    box: str | None
    priority: float
    waits: float
    due: float | None
    aims: str | None = None
    boxes_before: int | None = None
    minutes: float | None = None


@dataclass(frozen=True, slots=True)
class QuestionState:
    """A question that nobody has answered.

    Attributes:
        id: its name, unique for all time.
        text: what is asked.
        choices: the answers to choose from; the last is the careful one.
        about: the box, the trolley or the place that it is about.
        asked: when, on the cell's clock [s].
        blocks: whether the cell waits for the answer.
        at: where the box that it is about stands, where that is known [m].
    """

    id: str
    text: str
    choices: tuple[str, ...]
    about: str
    asked: float
    blocks: bool = True
    at: Vector3 | None = None


@dataclass(frozen=True, slots=True)
class Alarm:
    """Something abnormal that needs an action.

    Attributes:
        id: its name; the same cause has the same one.
        text: what has happened.
        todo: what to do.
        since: on the cell's clock [s].
        urgent: whether the cell stands because of it.
    """

    id: str
    text: str
    todo: str
    since: float
    urgent: bool = True


@dataclass(frozen=True, slots=True)
class TaskNode:
    """A node of a task tree, in the order of the tree.

    Attributes:
        label: the schema with its arguments.
        depth: below the root.
        state: "accomplished", "running", "enabled" or "disabled", as in the paper's figures.
        concrete: whether it is an action.
        why: why it does not run; empty where it does or has.
    """

    label: str
    depth: int
    state: str
    concrete: bool
    why: str = ""


@dataclass(frozen=True, slots=True)
class TaskTree:
    """An allocated task with everything below it.

    Attributes:
        number: of the tree.
        priority: of the request that it serves.
        nodes: depth first.
    """

    number: int
    priority: float
    nodes: tuple[TaskNode, ...]


@dataclass(frozen=True, slots=True)
class CellState:
    """Everything that a screen shows of the cell at one moment.

    Attributes:
        version: rises with every change.
        at: the cell's clock [s].
        mode: in PackML's terms.
        reason: why it is in that mode, for people.
        delivery: that is worked on, or None.
        run: the number of the run, or None.
        boxes: how many the note promises.
        stored: how many were stored.
        aside: how many were set aside or taken by a person.
        lost: how many fell.
        stopping: whether it stops after this box.
        w: the weight of Eq. (3).
        speed: the share of the arm's full speed.
        policy: which boxes may be taken.
        joints: of the arm [rad], empty while there is no arm.
        held: the box in the gripper, or None.
        target: the box that was selected last, or None.
        explanation: why that one, in words.
        rate: boxes stored per hour so far, without waiting for people.
        queue: what stands on the pallet, best first.
        standing: what stands in the places.
        trolleys: bays and shelves.
        requests: those that wait.
        questions: those that nobody has answered.
        alarms: what needs an action, the most urgent first.
        trees: the task trees.
        picture: the number of the last camera picture; 0 while there is none.
    """

    version: int = 0
    at: float = 0.0
    mode: Mode = Mode.IDLE
    reason: str = ""
    delivery: str | None = None
    run: int | None = None
    boxes: int = 0
    stored: int = 0
    aside: int = 0
    lost: int = 0
    stopping: bool = False
    w: float = 0.5
    speed: float = 1.0
    policy: str = "paper"
    joints: tuple[float, ...] = ()
    held: str | None = None
    target: str | None = None
    explanation: str = ""
    rate: float = 0.0
    queue: tuple[QueueLine, ...] = ()
    standing: tuple[StandingBox, ...] = ()
    trolleys: tuple[TrolleyState, ...] = ()
    requests: tuple[RequestState, ...] = ()
    questions: tuple[QuestionState, ...] = ()
    alarms: tuple[Alarm, ...] = ()
    trees: tuple[TaskTree, ...] = ()
    picture: int = field(default=0)
