"""Finished pieces of work in a folder, so that an interrupted study goes on where it stopped."""

import hashlib
import json
import os
import re
from collections.abc import Callable, Sequence
from concurrent.futures import Executor
from pathlib import Path
from typing import Any, Generic, TypeVar

from pydantic import TypeAdapter, ValidationError

from depal import __version__
from depal.errors import SettingError
from depal.studies.sweep import Progress, no_progress, sweep

T = TypeVar("T")
R = TypeVar("R")

OPTION = "--keep"

_NAMED = 40
"""So many letters of a piece's name are in a file's name."""


class Kept(Generic[T, R]):
    """The results of a folder, each in a file of its own; without a folder nothing is kept.

    A result is of one piece, as its `repr` tells it, and of one version of the package.
    """

    def __init__(
        self,
        folder: Path | None,
        name: Callable[[T], str],
        read: Callable[[Any], R],
        written: Callable[[R], Any],
    ) -> None:
        """Opens a folder; it is made where there is none.

        Args:
            folder: where the results are.
            name: what a piece's file is called; need not be one piece's alone.
            read: a result from its JSON; ValueError or TypeError where it is none.
            written: a result as JSON.

        Raises:
            SettingError: the folder cannot be made.
        """
        self._folder, self._name, self._read, self._written = folder, name, read, written
        if folder is None:
            return
        try:
            folder.mkdir(parents=True, exist_ok=True)
        except OSError as error:
            what = f"cannot make the folder {str(folder)!r}: {error.strerror}"
            raise SettingError(OPTION, what, "a folder that can be written to") from error

    @classmethod
    def of(cls, folder: Path | None, name: Callable[[T], str], kind: type[R]) -> "Kept[T, R]":
        """Of results that are dataclasses.

        Raises:
            SettingError: the folder cannot be made.
        """
        adapter = TypeAdapter(kind)

        def written(result: R) -> object:
            return adapter.dump_python(result, mode="json")

        return cls(folder, name, adapter.validate_python, written)

    def get(self, piece: T) -> R | None:
        """What was kept of a piece; None where there is nothing, or nothing that can be read."""
        if self._folder is None:
            return None
        try:
            return self._read(json.loads(self._path(self._folder, piece).read_text("utf-8")))
        except (OSError, ValueError, TypeError, ValidationError):
            return None

    def keep(self, piece: T, result: R) -> None:
        """Keeps a result, whole or not at all.

        Raises:
            SettingError: the folder cannot be written to.
        """
        if self._folder is None:
            return
        path = self._path(self._folder, piece)
        part = path.with_suffix(f".{os.getpid()}.part")
        try:
            text = json.dumps(self._written(result), allow_nan=False)
            part.write_text(text + "\n", "utf-8")
            part.replace(path)
        except OSError as error:
            part.unlink(missing_ok=True)
            what = f"cannot write {str(path)!r}: {error.strerror}"
            raise SettingError(OPTION, what, "a folder that can be written to") from error

    def _path(self, folder: Path, piece: T) -> Path:
        name = re.sub(r"[^A-Za-z0-9_+-]", "_", self._name(piece))[:_NAMED]
        return folder / f"{name}-{key_of(piece)[:16]}.json"


def key_of(piece: object) -> str:
    """What a result depends on, as a hash: the package's version, and everything in the piece."""
    return hashlib.sha256(f"{__version__} {piece!r}".encode()).hexdigest()


def sweep_kept(
    work: Callable[[T], R],
    pieces: Sequence[T],
    kept: Kept[T, R],
    executor: Executor | None = None,
    progress: Progress = no_progress,
) -> list[R]:
    """A sweep that leaves out the pieces whose results are kept, and keeps those of the others.

    Returns:
        One result a piece, in the order of the pieces.

    Raises:
        DepalError: a worker process died, or the folder cannot be written to.
    """
    results = [kept.get(piece) for piece in pieces]
    todo = [number for number, result in enumerate(results) if result is None]
    before = len(pieces) - len(todo)

    def heard(index: int, result: R) -> None:
        kept.keep(pieces[todo[index]], result)

    def told(done: int, _total: int) -> None:
        progress(before + done, len(pieces))

    found = iter(sweep(work, [pieces[number] for number in todo], executor, told, heard))
    return [next(found) if result is None else result for result in results]
