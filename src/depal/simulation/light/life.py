"""A controller's life: what it was given goes dead with it."""

import asyncio


class EndedError(BaseException):
    """The controller that does this has ended; no handler of its own may take it for a fault."""


class Life:
    """From the start of a controller to its end, which comes between any two of its deeds.

    Attributes:
        over: set once it has ended.
    """

    def __init__(self) -> None:
        """Begun."""
        self.over = asyncio.Event()

    def end(self) -> None:
        """Nothing of this controller reaches the world any more."""
        self.over.set()

    def check(self) -> None:
        """Whoever acts for a controller asks first.

        Raises:
            EndedError: it has ended.
        """
        if self.over.is_set():
            raise EndedError
