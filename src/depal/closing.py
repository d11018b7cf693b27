"""What is closed at the end of a `with` block: files, databases, devices."""

from abc import ABC, abstractmethod
from types import TracebackType
from typing import Self


class Closing(ABC):
    """Something that is open until it is closed, or until its `with` block ends."""

    __slots__ = ()

    @abstractmethod
    def close(self) -> None:
        """Closes it; what is closed already stays so."""

    def __enter__(self) -> Self:
        """The thing itself."""
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        """Closes it."""
        self.close()
