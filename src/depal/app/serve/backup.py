"""`depal backup`: a copy that can be started from, taken while everything works."""

import shutil
import sqlite3
from contextlib import closing
from pathlib import Path

from depal.app.serve.serving import RUNS, STORE
from depal.errors import SettingError
from depal.logistics.store import Database

JOURNALS = ".db"


def back_up(data: Path, to: Path) -> str:
    """Copies a data folder.

    Args:
        data: of a cell that may be working.
        to: a folder that does not exist yet.

    Returns:
        What was copied, in a line.

    Raises:
        SettingError: there is no such data, or the new folder exists.
    """
    if not (data / STORE).is_file():
        raise SettingError("--data", f"there is no {STORE} in {data}", "a cell's data folder")
    if to.exists():
        raise SettingError("TO", f"{to} exists already", "a new folder")
    fresh = to.with_name(f"{to.name}.part")
    if fresh.exists():
        shutil.rmtree(fresh)
    fresh.mkdir(parents=True)
    with Database(f"sqlite:///{data / STORE}") as database:
        database.copy_to(fresh / STORE)
    runs = 0
    for folder in sorted((data / RUNS).glob("*")) if (data / RUNS).is_dir() else ():
        _copy_run(folder, fresh / RUNS / folder.name)
        runs += 1
    fresh.rename(to)  # until here there is no folder of that name: nothing half-done
    return f"{to}: the store's data and {runs} run{'' if runs == 1 else 's'}"


def _copy_run(folder: Path, to: Path) -> None:
    to.mkdir(parents=True)
    for path in sorted(folder.iterdir()):
        if path.suffix == JOURNALS:
            with closing(sqlite3.connect(path)) as source:
                source.execute("VACUUM INTO ?", (str(to / path.name),))
        elif path.is_file() and not path.name.endswith((".lock", "-wal", "-shm")):
            shutil.copyfile(path, to / path.name)
