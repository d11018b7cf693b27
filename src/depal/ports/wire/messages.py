"""What is said between a controller and the world that it works in."""

import msgspec

from depal.domain import BoxId, CellLayout, Cup, Delivery, PlaceId
from depal.ports.devices import Watch
from depal.ports.people import Question
from depal.ports.wire.values import Path

VERSION = 3
"""Of these messages; both sides have the same."""


class Built(msgspec.Struct, frozen=True):
    """What stands in the world."""

    delivery: str
    number: int


class State(msgspec.Struct, frozen=True):
    """What the sensors say: sent while anything changes, and with every reply."""

    at: float
    joints: tuple[float, float, float, float, float, float]
    load: float
    vacuum: dict[str, float]
    folded: bool
    trolleys: dict[str, str | None]
    stopped: bool
    gate_open: bool
    lag: float = 0.0
    near: bool = False
    inside: bool = False


class Truth(msgspec.Struct, frozen=True):
    """The referee's word, for reports and tests only.

    Attributes:
        where: of each box of the stack.
        names: which box a name of the cell's means.
        collisions: in words.
        lost: how many boxes the suction has lost.
    """

    where: tuple[str, ...]
    names: dict[str, int]
    collisions: tuple[str, ...]
    lost: int


# What a controller says


class Hello(msgspec.Struct, frozen=True, tag=True):
    """The first thing: which messages it speaks, and who it is."""

    version: int
    pid: int


class Build(msgspec.Struct, frozen=True, tag=True):
    """A full pallet and empty trolleys come into the cell."""

    layout: CellLayout
    delivery: Delivery
    seed: int
    severity: str
    number: int


class Follow(msgspec.Struct, frozen=True, tag=True):
    """Moves; the reply is why it stopped before the end, or None."""

    path: Path
    watch: Watch


class Limit(msgspec.Struct, frozen=True, tag=True):
    """Flange and tool are no faster than this from now on [m/s]."""

    speed: float


class Halt(msgspec.Struct, frozen=True, tag=True):
    """Brings the arm to rest on its path."""

    reason: str


class Fold(msgspec.Struct, frozen=True, tag=True):
    """Moves the hinge."""

    up: bool


class Suck(msgspec.Struct, frozen=True, tag=True):
    """Opens valves; the reply is whether the vacuum stands."""

    cups: tuple[Cup, ...]


class Release(msgspec.Struct, frozen=True, tag=True):
    """Vents all cups."""


class Read(msgspec.Struct, frozen=True, tag=True):
    """Reads barcodes."""


class Range(msgspec.Struct, frozen=True, tag=True):
    """Reads the range sensor of a compartment; the reply is its profile [m]."""

    place: PlaceId


class Take(msgspec.Struct, frozen=True, tag=True):
    """Takes a picture with one camera."""

    camera: int


class Look(msgspec.Struct, frozen=True, tag=True):
    """What a sight would see that knows the truth."""


class Do(msgspec.Struct, frozen=True, tag=True):
    """A person does what an answer promises."""

    question: Question
    answer: str


class Ask(msgspec.Struct, frozen=True, tag=True):
    """What a person beside the cell would answer who sees what is so."""

    question: Question


class Lifted(msgspec.Struct, frozen=True, tag=True):
    """The cell calls the box in the hand by this name; for the referee."""

    box: BoxId


class Judge(msgspec.Struct, frozen=True, tag=True):
    """Asks the referee, for reports and tests only."""


class Beat(msgspec.Struct, frozen=True, tag=True):
    """The controller is alive."""


class Shutdown(msgspec.Struct, frozen=True, tag=True):
    """The world is to end."""


Call = (
    Hello
    | Build
    | Follow
    | Limit
    | Halt
    | Fold
    | Suck
    | Release
    | Read
    | Range
    | Take
    | Look
    | Do
    | Ask
    | Lifted
    | Judge
    | Beat
    | Shutdown
)


class Request(msgspec.Struct, frozen=True):
    """A call with a number; 0 expects no reply."""

    number: int
    call: Call


class Welcome(msgspec.Struct, frozen=True):
    """The reply to a hello.

    Attributes:
        pace: seconds of the world's time per second.
        start: the world's time at the origin [s].
        origin: of the machine's monotonic clock [s].
        built: what stands in the world.
        lag: how far its time is behind the pace [s].
    """

    pace: float
    start: float
    origin: float
    built: Built | None
    lag: float = 0.0


class Reply(msgspec.Struct, frozen=True):
    """What a call has come to, or, with number 0, only the newest state.

    Attributes:
        number: of the call.
        value: MessagePack of what the call promises.
        error: why it could not be done; None where it was.
        state: of the sensors; None while nothing is built.
    """

    number: int
    value: bytes = b""
    error: str | None = None
    state: State | None = None
