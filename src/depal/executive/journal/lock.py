"""One writer at a time: a lock file beside the journal, let go by the kernel with the process."""

import fcntl
import os
from pathlib import Path

from depal.errors import JournalError


class WriterLock:
    """The right to write one journal.

    The lock file stays when the lock is let go: removing it would let a third process lock a file
    that a second one still waits for. A forked child inherits the lock.
    """

    def __init__(self, path: Path) -> None:
        """Takes the lock, or says who has it.

        Args:
            path: the journal's file.

        Raises:
            JournalError: somebody else writes this journal, or the lock file cannot be made.
        """
        name = path.with_name(f"{path.name}.lock")
        try:
            self._file: int | None = os.open(name, os.O_RDWR | os.O_CREAT | os.O_CLOEXEC, 0o644)
        except OSError as error:
            raise JournalError(
                f"{path}: cannot be locked for writing: {error.strerror} ({name}); "
                "expected a folder that exists and can be written"
            ) from error
        try:
            fcntl.flock(self._file, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except OSError as error:
            holder = os.pread(self._file, 32, 0).decode(errors="replace").strip() or "?"
            self.release()
            raise JournalError(
                f"{path}: another process ({holder}) writes this journal already; "
                "stop it, or open the journal with readonly=True"
            ) from error
        try:
            os.ftruncate(self._file, 0)
            os.pwrite(self._file, f"{os.getpid()}\n".encode(), 0)
        except OSError:
            pass  # on a full disk the number is only missing from a message

    def release(self) -> None:
        """Lets go; twice is allowed."""
        if self._file is not None:
            os.close(self._file)
            self._file = None
