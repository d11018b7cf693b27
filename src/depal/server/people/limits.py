"""Guessing passwords is slow: after some failures an account and an address have to wait."""

import threading
from dataclasses import dataclass, replace

from depal.server.chance import Chance
from depal.server.problems import TooMany

FREE = {"account": 5, "address": 20}
"""So many failures in a row cost nothing."""

FIRST, LONGEST = 2.0, 900.0
"""The first wait; each further failure doubles it, up to this [s]."""

FORGOTTEN = 3600.0
"""After so long without a failure all is forgotten [s]."""

MANY = 10_000
"""Of so many names at the most something is remembered."""


@dataclass(frozen=True, slots=True)
class _Failures:
    count: int
    last: float


class Limits:
    """Failures by account and by address, in memory; used by several threads."""

    def __init__(self, chance: Chance) -> None:
        """Nobody has failed."""
        self._chance = chance
        self._failures: dict[tuple[str, str], _Failures] = {}
        self._lock = threading.Lock()

    def attempt(self, account: str, address: str) -> None:
        """A try begins; until it has succeeded it counts as a failure.

        So many at once are as many as one after the other.

        Args:
            account: whose password is tried; "" where it is not about an account.
            address: from where.

        Raises:
            TooMany: not yet; it says when.
        """
        now = self._chance.now()
        with self._lock:
            wait = max(self._wait(key, now) for key in _keys(account, address))
            if wait > 0.0:
                raise TooMany(f"too many tries; try again in {wait:.0f} s", after=wait)
            if len(self._failures) > MANY:
                self._forget(now)
            for key in _keys(account, address):
                before = self._failures.get(key)
                fresh = before is not None and now - before.last < FORGOTTEN
                count = before.count + 1 if before is not None and fresh else 1
                self._failures[key] = _Failures(count, now)

    def succeeded(self, account: str, address: str) -> None:
        """The right password: the account's failures are forgotten, the address' others are not."""
        with self._lock:
            self._failures.pop(("account", account), None)
            before = self._failures.get(("address", address))
            if before is not None:
                self._failures["address", address] = replace(before, count=before.count - 1)

    def _wait(self, key: tuple[str, str], now: float) -> float:
        failures = self._failures.get(key)
        if failures is None or failures.count < FREE[key[0]]:
            return 0.0
        if now < failures.last:  # the clock was set back: the wait begins anew, and no longer
            self._failures[key] = failures = _Failures(failures.count, now)
        wait = min(FIRST * 2.0 ** min(failures.count - FREE[key[0]], 30), LONGEST)
        return max(failures.last + wait - now, 0.0)

    def _forget(self, now: float) -> None:
        kept = {k: f for k, f in self._failures.items() if now - f.last < FORGOTTEN}
        newest = sorted(kept.items(), key=lambda item: item[1].last)[-MANY // 2 :]
        self._failures = dict(newest)


def _keys(account: str, address: str) -> list[tuple[str, str]]:
    named = [("account", account)] if account else []
    return [*named, ("address", address)]
