"""A safety controller that says what a test says."""

from dataclasses import dataclass

from depal.ports.devices import SafetyState


@dataclass(slots=True)
class FakeSafety:
    """All is well unless somebody says otherwise.

    Attributes:
        stopped: a stop is active.
        gate_open: somebody may be inside.
        near: somebody is in the warning field.
        inside: somebody is in the protective field.
        read: when it was last heard [s]; None for just now.
    """

    stopped: bool = False
    gate_open: bool = False
    near: bool = False
    inside: bool = False
    read: float | None = None

    def state(self) -> SafetyState:
        """What it says now."""
        return SafetyState(self.stopped, self.gate_open, self.near, self.inside, self.read)
