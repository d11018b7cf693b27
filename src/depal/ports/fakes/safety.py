"""A safety controller that says what a test says."""

from dataclasses import dataclass

from depal.ports.devices import SafetyState


@dataclass(slots=True)
class FakeSafety:
    """All is well unless somebody says otherwise.

    Attributes:
        stopped: a stop is active.
        gate_open: somebody may be inside.
    """

    stopped: bool = False
    gate_open: bool = False

    def state(self) -> SafetyState:
        """What it says now."""
        return SafetyState(self.stopped, self.gate_open)
