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
from depal.errors import DepalError
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
    "mujoco-core",
    "ompl",
    "opencv-contrib-python-headless",
    "pillow",
    "zxing-cpp",
    "SQLAlchemy",
)
_OPTIONAL = {
    "distributed": "sweeps on a Dask cluster",
    "pyrealsense2": "a RealSense camera",
    "networkx": "a peer in depal bench",
    "py_trees": "a peer in depal bench",
    "behaviortreepy": "a peer in depal bench",
    "gtpyhop": "a peer in depal bench",
}


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
        _tried("physics", _simulate),
        _tried("the peer of motion planning", _load_planner),
        _tried("barcodes", _read_barcode),
        _tried("the store's data", _open_store),
        _tried("deliveries that ship with depal", _read_shipped),
        _tried("cells that ship with depal", _read_cells),
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


def _simulate() -> str:
    import mujoco  # noqa: PLC0415 - slow to load

    spec = mujoco.MjSpec()
    box = spec.worldbody.add_body(pos=(0.0, 0.0, 1.0))
    box.add_freejoint()
    box.add_geom(type=mujoco.mjtGeom.mjGEOM_BOX, size=(0.1, 0.1, 0.1))
    model = spec.compile()
    data = mujoco.MjData(model)
    mujoco.mj_step(model, data, nstep=100)
    if not data.qpos[2] < 1.0:
        raise DepalError("a box does not fall")
    return f"MuJoCo {mujoco.__version__}: a box falls"


def _load_planner() -> str:
    importlib.import_module("ompl.base")
    return "OMPL loads"


def _read_barcode() -> str:
    from depal.simulation.imaging.prints.label import bars_of  # noqa: PLC0415 - slow to load
    from depal.simulation.imaging.reader import codes_in  # noqa: PLC0415

    digits = "12000823098180"
    bars = np.pad(np.repeat(bars_of(digits), 3), 60, constant_values=252)
    if codes_in(np.tile(bars, (120, 1))) != (digits,):
        raise DepalError("a barcode that was drawn is not read")
    return "zxing-cpp reads what it draws"


def _open_store() -> str:
    from depal.cell.files import shipped_cell  # noqa: PLC0415 - slow to load
    from depal.logistics.store import LocalStore  # noqa: PLC0415

    delivery = shipped_deliveries()[0]
    with LocalStore() as store:
        store.seed_places([delivery], shipped_cell().places.values())
        kept = store.note_of(delivery.id)
    if kept is None or kept.lines != delivery.lines:
        raise DepalError("a delivery's note is not what was kept")
    return "SQLite keeps a delivery's note"


def _read_cells() -> str:
    from depal.cell.files import SHIPPED, shipped_cell  # noqa: PLC0415 - slow to load

    return f"{len(SHIPPED)}: {', '.join(shipped_cell(name).name for name in SHIPPED)}"


def _read_shipped() -> str:
    deliveries = shipped_deliveries()
    return f"{len(deliveries)}: {', '.join(delivery.id for delivery in deliveries)}"


def _write() -> str:
    with tempfile.TemporaryDirectory() as folder:
        (Path(folder) / "probe").write_text("probe", encoding="utf-8")
    return "can be written"
