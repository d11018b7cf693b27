"""A small sound delivery, and files to plant mistakes in."""

import copy
import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from depal.domain import Delivery
from depal.logistics import read_deliveries

Raw = dict[str, Any]

TEA, RICE = "12000823098180", "12000807013116"

TOY: Raw = {
    "id": "toy",
    "pallet": {"size": [1.2, 0.8, 0.144]},
    "lines": [
        {"gtin": TEA, "name": "tea", "size": [0.4, 0.3, 0.2], "mass": 5.5, "count": 2},
        {"gtin": RICE, "name": "rice", "size": [0.3, 0.3, 0.1], "mass": 8, "count": 1},
    ],
    "stack": [
        {"gtin": TEA, "corner": [0, 0, 0], "size": [0.4, 0.3, 0.2]},
        {"gtin": TEA, "corner": [0.4, 0, 0], "size": [0.3, 0.4, 0.2]},
        {"gtin": RICE, "corner": [0, 0, 0.2], "size": [0.3, 0.3, 0.1]},
    ],
}


@pytest.fixture
def toy() -> Raw:
    """Two cases of tea side by side and one of rice on top; a fresh copy."""
    return copy.deepcopy(TOY)


@pytest.fixture
def tea() -> str:
    """The trade item number of the tea."""
    return TEA


@pytest.fixture
def toy_delivery(tmp_path: Path) -> Delivery:
    """The same, read."""
    path = tmp_path / "read" / "toy.json"
    path.parent.mkdir()
    path.write_text(json.dumps(TOY), encoding="utf-8")
    return read_deliveries(path)[0]


@pytest.fixture
def complaint(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Callable[..., str]:
    """Writes a file, reads it and returns the error's message."""
    monkeypatch.chdir(tmp_path)

    def told(
        content: str | bytes,
        name: str = "in.json",
        read: Callable[[Path], object] = read_deliveries,
    ) -> str:
        Path(name).write_bytes(content if isinstance(content, bytes) else content.encode())
        with pytest.raises(Exception) as caught:  # noqa: PT011 - the text is what is compared
            read(Path(name))
        return f"{type(caught.value).__name__}: {caught.value}"

    return told
