"""What works on this machine."""

import importlib.util
import io
import os
import platform
import sys
import tempfile
from collections.abc import Callable
from dataclasses import dataclass
from importlib import metadata
from pathlib import Path

import numpy as np

from depal import __version__
from depal.app.files import Json
from depal.logistics import shipped_deliveries
from depal.selection.links import Links
from depal.selection.walks import propagate

_OLDEST_PYTHON = (3, 11)
_NEEDED = (
    "numpy",
    "scipy",
    "numba",
    "pydantic",
    "msgspec",
    "typer",
    "rich",
    "matplotlib",
    "biip",
    "PyYAML",
)
_OPTIONAL = {"distributed": "sweeps on a Dask cluster", "networkx": "a peer in depal bench"}


@dataclass(frozen=True, slots=True)
class Finding:
    """One thing that was tried.

    Attributes:
        name: what.
        works: whether it does; None where it is optional and missing.
        detail: what was found, or how to mend it.
    """

    name: str
    works: bool | None
    detail: str

    @property
    def fields(self) -> Json:
        """For JSON."""
        return {"name": self.name, "works": self.works, "detail": self.detail}


def examine() -> list[Finding]:
    """Tries everything that depal needs, and says what is there."""
    version = ".".join(map(str, sys.version_info[:3]))
    cores = len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count()
    return [
        Finding("depal", works=True, detail=__version__),
        Finding(
            "Python",
            works=sys.version_info >= _OLDEST_PYTHON,
            detail=f"{version}, 3.11 or later needed",
        ),
        Finding(
            "machine",
            works=True,
            detail=f"{platform.machine()}, {platform.system()}, {cores} cores",
        ),
        *(_package(name) for name in _NEEDED),
        _tried("compiler of the hot loops", _compile),
        _tried("pictures", _draw),
        _tried("deliveries that ship with depal", _read_shipped),
        _tried("temporary files", _write),
        *(_optional(name, purpose) for name, purpose in _OPTIONAL.items()),
    ]


def _package(name: str) -> Finding:
    try:
        return Finding(name, works=True, detail=metadata.version(name))
    except metadata.PackageNotFoundError:
        return Finding(name, works=False, detail=f"not installed; pip install {name}")


def _optional(name: str, purpose: str) -> Finding:
    if importlib.util.find_spec(name) is None:
        return Finding(name, works=None, detail=f"not installed; only for {purpose}")
    return Finding(name, works=True, detail=f"{metadata.version(name)}, for {purpose}")


def _tried(name: str, attempt: Callable[[], str]) -> Finding:
    try:
        return Finding(name, works=True, detail=attempt())
    except Exception as error:  # noqa: BLE001 - whatever it is, it is what we report
        return Finding(name, works=False, detail=f"{type(error).__name__}: {error}")


def _compile() -> str:
    propagate(Links.empty(1, 1), np.zeros(0, np.int32), np.zeros(0))
    if os.environ.get("NUMBA_DISABLE_JIT", "0") not in {"", "0"}:
        return "switched off by NUMBA_DISABLE_JIT: everything works, some hundred times slower"
    return "numba compiles"


def _draw() -> str:
    from matplotlib.figure import Figure  # noqa: PLC0415 - slow to load

    Figure().savefig(io.BytesIO())
    return "matplotlib draws without a screen"


def _read_shipped() -> str:
    deliveries = shipped_deliveries()
    return f"{len(deliveries)}: {', '.join(delivery.id for delivery in deliveries)}"


def _write() -> str:
    with tempfile.TemporaryDirectory() as folder:
        (Path(folder) / "probe").write_text("probe", encoding="utf-8")
    return "can be written"
