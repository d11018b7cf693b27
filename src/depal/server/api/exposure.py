"""How a site is reached: host names, cookies, sizes."""

from dataclasses import dataclass

LOOPBACK = frozenset({"127.0.0.1", "localhost", "[::1]"})
"""Names of this machine that are always allowed."""


@dataclass(frozen=True, slots=True)
class Exposure:
    """How a site is reached.

    Attributes:
        hosts: names that it may be asked for, beside this machine's own.
        secure: whether browsers reach it by TLS; then its cookie is bound to it.
    """

    hosts: frozenset[str] = frozenset()
    secure: bool = False

    @property
    def cookie(self) -> str:
        """The name of the session's cookie; browsers take `__Host-` over TLS alone."""
        return "__Host-depal" if self.secure else "depal"

    def allows(self, host: str) -> bool:
        """Whether it may be asked for under a Host header."""
        name = (host.rsplit(":", 1)[0] if not host.endswith("]") else host).lower()
        return name in LOOPBACK or name in self.hosts
