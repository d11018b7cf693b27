"""Requests of a run that is being started: they are there when it begins."""

from depal.domain import Request


class Early:
    """By key, in the order in which they came."""

    def __init__(self, requests: tuple[tuple[str, Request], ...] = ()) -> None:
        """Those that were there before."""
        self._requests = dict(requests)

    @property
    def requests(self) -> tuple[tuple[str, Request], ...]:
        """Those that are wanted now."""
        return tuple(self._requests.items())

    def put(self, key: str, request: Request) -> None:
        """One more, or one that has changed."""
        self._requests[key] = request

    def drop(self, key: str) -> None:
        """It is not wanted any more."""
        self._requests.pop(key, None)
