"""The simulated safety controller."""

from depal.ports import SafetyState


class SimulatedSafety:
    """A safety controller; tests and faults trip it.

    Attributes:
        stopped: an emergency stop or a protective stop is active.
        gate_open: somebody may be inside.
    """

    def __init__(self) -> None:
        """All is well."""
        self.stopped = False
        self.gate_open = False

    def state(self) -> SafetyState:
        """What it says now."""
        return SafetyState(self.stopped, self.gate_open)
