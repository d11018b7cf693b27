"""Time and secrets for the store's side, handed in so that tests can hold them."""

import secrets
import time
from dataclasses import dataclass
from typing import Protocol


class Chance(Protocol):
    """Where time and secrets come from."""

    def now(self) -> float:
        """Seconds since 1970."""
        ...

    def secret(self, size: int = 32) -> str:
        """A secret that nobody can guess, safe in a URL."""
        ...


@dataclass(frozen=True, slots=True)
class SystemChance:
    """The machine's."""

    def now(self) -> float:
        """Seconds since 1970."""
        return time.time()

    def secret(self, size: int = 32) -> str:
        """From the system's random source."""
        return secrets.token_urlsafe(size)
