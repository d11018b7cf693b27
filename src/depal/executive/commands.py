"""What the engine tells the rim to do, once the events behind it are written."""

import msgspec

from depal.executive.schema import Action, Cancel


class Start(msgspec.Struct, frozen=True):
    """Run a primitive.

    Attributes:
        attempt: its number; a message is repeated under the same one.
        action: its schema.
        args: the things that its parameters stand for.
    """

    attempt: int
    action: Action
    args: tuple[str, ...]


class Stop(msgspec.Struct, frozen=True):
    """Break off an attempt, as its policy says.

    Attributes:
        attempt: its number.
        policy: at once, at its next checkpoint, or never: then it is only told.
        reason: why.
    """

    attempt: int
    policy: Cancel
    reason: str


class Probe(msgspec.Struct, frozen=True):
    """Find out what an attempt in doubt has done.

    Attributes:
        attempt: its number.
        action: its schema; it names the probe.
        args: the things that its parameters stand for.
    """

    attempt: int
    action: Action
    args: tuple[str, ...]


Command = Start | Stop | Probe
