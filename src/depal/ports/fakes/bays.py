"""Bays in which trolleys come and go as a test says."""

from dataclasses import dataclass, field


@dataclass(slots=True)
class FakeBays:
    """A trolley stands in every bay unless it was pulled out.

    Attributes:
        pulled: bays without a trolley.
        exchanges: how often each bay got another trolley.
    """

    pulled: set[str] = field(default_factory=set)
    exchanges: dict[str, int] = field(default_factory=dict)

    def trolley(self, bay: str) -> str | None:
        """The trolley in the bay."""
        return None if bay in self.pulled else f"{bay}#{self.exchanges.get(bay, 0) + 1}"

    def exchange(self, bay: str) -> None:
        """Another trolley stands there."""
        self.pulled.discard(bay)
        self.exchanges[bay] = self.exchanges.get(bay, 0) + 1
