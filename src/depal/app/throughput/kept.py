"""Finished runs in a folder, so that an interrupted study goes on where it stopped."""

import hashlib
import json
import os
import re
from pathlib import Path

from pydantic import ValidationError

from depal import __version__
from depal.app.files import Json
from depal.app.run.values import Job
from depal.app.throughput.row import Row
from depal.errors import SettingError

OPTION = "--keep"

_NAMED = 40
"""So many letters of a delivery's name are in a file's name."""


class Kept:
    """The finished runs of a folder; without a folder nothing is kept."""

    def __init__(self, folder: Path | None) -> None:
        """Opens a folder; it is made where there is none.

        Raises:
            SettingError: it cannot be made.
        """
        self._folder = folder
        if folder is None:
            return
        try:
            folder.mkdir(parents=True, exist_ok=True)
        except OSError as error:
            what = f"cannot make the folder {str(folder)!r}: {error.strerror}"
            raise SettingError(OPTION, what, "a folder that can be written to") from error

    def row(self, job: Job) -> Row | None:
        """The run that was kept of a job; None where there is none, or none that can be read."""
        if self._folder is None:
            return None
        try:
            kept = json.loads(self._path(self._folder, job).read_text("utf-8"))
            return Row.of(kept)
        except (OSError, ValueError, TypeError, ValidationError):
            return None

    def keep(self, job: Job, fields: dict[str, Json]) -> None:
        """Keeps a run, whole or not at all.

        Raises:
            SettingError: the folder cannot be written to.
        """
        if self._folder is None:
            return
        path = self._path(self._folder, job)
        part = path.with_suffix(f".{os.getpid()}.part")
        try:
            part.write_text(json.dumps(fields, allow_nan=False) + "\n", "utf-8")
            part.replace(path)
        except OSError as error:
            part.unlink(missing_ok=True)
            what = f"cannot write {str(path)!r}: {error.strerror}"
            raise SettingError(OPTION, what, "a folder that can be written to") from error

    @staticmethod
    def _path(folder: Path, job: Job) -> Path:
        return folder / f"{_name(job)}-{job.seed}-{key_of(job)[:16]}.json"


def key_of(job: Job) -> str:
    """What a run depends on, as a hash: the package's version, the delivery, every option."""
    return hashlib.sha256(f"{__version__} {job!r}".encode()).hexdigest()


def _name(job: Job) -> str:
    return re.sub(r"[^A-Za-z0-9_-]", "_", job.delivery.id)[:_NAMED]
