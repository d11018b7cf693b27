"""Stacks of thousands of cases."""

import json
from pathlib import Path

import pytest

from depal.errors import DeliveryError
from depal.logistics import read_deliveries

GTIN = "12000823098180"


def cubes(count: int) -> dict[str, object]:
    """A delivery of cubes, 24 by 16 in a layer."""
    stack = [
        {
            "gtin": GTIN,
            "corner": [index % 24 / 20, index // 24 % 16 / 20, index // 384 / 20],
            "size": [0.05, 0.05, 0.05],
        }
        for index in range(count)
    ]
    line = {"gtin": GTIN, "name": "cube", "size": [0.05] * 3, "mass": 0.1, "count": count}
    return {"id": "c", "pallet": {"size": [1.2, 0.8, 0.144]}, "lines": [line], "stack": stack}


def test_a_stack_of_two_thousand_cases_is_checked_as_a_whole(tmp_path: Path) -> None:
    """Also where one case in the middle is moved: its neighbours and what it carried are named."""
    raw = cubes(2000)
    path = tmp_path / "cubes.json"
    path.write_text(json.dumps(raw))
    assert len(read_deliveries(path)[0].boxes) == 2000
    stack = raw["stack"]
    assert isinstance(stack, list)
    stack[1000]["corner"] = [*stack[1001]["corner"][:2], 0.3]
    path.write_text(json.dumps(raw))
    with pytest.raises(DeliveryError) as caught:
        read_deliveries(path)
    assert [problem.where for problem in caught.value.problems] == ["stack[1000]", "stack[1384]"]
