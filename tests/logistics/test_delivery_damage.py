"""Laws of reading: damage is found where it was done, and nothing else is ever raised."""

import contextlib
import copy
import json
from collections.abc import Iterator
from dataclasses import replace
from importlib import resources
from pathlib import Path
from typing import Any

import pytest
from biip.checksums import gs1_standard_check_digit
from hypothesis import given, settings
from hypothesis import strategies as st

from depal.domain import EURO_PALLET, Delivery, DeliveryLine, Gtin, Product
from depal.errors import DeliveryError
from depal.logistics import read_deliveries, shipped_deliveries

Raw = dict[str, Any]
Damage = tuple[Raw, str]

FILE = resources.files("depal.logistics") / "deliveries" / "shipped.json"
REAL: list[Raw] = json.loads(FILE.read_text("utf-8"))


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder that all examples share."""
    return tmp_path_factory.mktemp("damaged")


def written(folder: Path, value: object, name: str = "damaged.json") -> Path:
    """A file with a JSON value."""
    path = folder / name
    path.write_text(json.dumps(value), encoding="utf-8")
    return path


def at(raw: Any, path: tuple[str | int, ...]) -> Any:  # noqa: ANN401 - whatever JSON holds
    """What a raw delivery holds at a path."""
    for step in path:
        raw = raw[step]
    return raw


def places(value: object, path: tuple[str | int, ...] = ()) -> Iterator[tuple[str | int, ...]]:
    """All paths into a JSON value, itself left out."""
    steps = value.items() if isinstance(value, dict) else ()
    if isinstance(value, list):
        steps = enumerate(value)
    for step, inner in steps:
        yield (*path, step)
        yield from places(inner, (*path, step))


def named(path: tuple[str | int, ...]) -> str:
    """A path as messages write it."""
    return "".join(f"[{s}]" if isinstance(s, int) else f".{s}" for s in path).removeprefix(".")


real = st.sampled_from(REAL).map(copy.deepcopy)


@st.composite
def missing_keys(draw: st.DrawFn) -> Damage:
    """A key that must be there is not."""
    raw = draw(real)
    path = draw(
        st.sampled_from([p for p in places(raw) if isinstance(p[-1], str) and p != ("stack",)])
    )
    del at(raw, path[:-1])[path[-1]]
    return raw, named(path)


@st.composite
def wrong_types(draw: st.DrawFn) -> Damage:
    """A value is of a type that fits nowhere."""
    raw = draw(real)
    path = draw(st.sampled_from(list(places(raw))))
    at(raw, path[:-1])[path[-1]] = draw(st.sampled_from([None, True, float("nan"), {"a": 1}, ""]))
    return raw, named(path)


@st.composite
def renamed_keys(draw: st.DrawFn) -> Damage:
    """A key is misspelt."""
    raw = draw(real)
    path = draw(st.sampled_from([p for p in places(raw) if isinstance(p[-1], str)]))
    holder = at(raw, path[:-1])
    holder[f"{path[-1]}_"] = holder.pop(path[-1])
    return raw, f"{named(path)}_"


@st.composite
def scaled_numbers(draw: st.DrawFn) -> Damage:
    """Millimetres, grams, or a sign too many."""
    raw = draw(real)
    path = draw(st.sampled_from([p for p in places(raw) if p[0] != "stack" or p[2:3] == ("size",)]))
    while isinstance(at(raw, path), list | dict):
        inner = at(raw, path)
        path = (*path, draw(st.sampled_from([*inner] if isinstance(inner, dict) else [0])))
    value = at(raw, path)
    factor = draw(st.sampled_from([-1, 0, 100_000]))
    broken = value[:11] if isinstance(value, str) and path[-1] == "gtin" else ""
    at(raw, path[:-1])[path[-1]] = broken if isinstance(value, str) else value * factor
    return raw, named(path)


@st.composite
def turned_digits(draw: st.DrawFn) -> Damage:
    """One digit of a GTIN is another one: the check digit tells."""
    raw = draw(real)
    path = draw(st.sampled_from([p for p in places(raw) if p[-1] == "gtin"]))
    gtin = at(raw, path)
    position = draw(st.integers(0, len(gtin) - 1))
    digit = (int(gtin[position]) + draw(st.integers(1, 9))) % 10
    at(raw, path[:-1])["gtin"] = f"{gtin[:position]}{digit}{gtin[position + 1 :]}"
    return raw, named(path)


@st.composite
def wrong_counts(draw: st.DrawFn) -> Damage:
    """The note promises more or less than the stack has."""
    raw = draw(real)
    index = draw(st.integers(0, len(raw["lines"]) - 1))
    if draw(st.booleans()):
        raw["lines"][index]["count"] += draw(st.integers(1, 50))
    else:
        gtin = raw["lines"][index]["gtin"]
        raw["stack"].append(next(case for case in raw["stack"] if case["gtin"] == gtin))
    return raw, f"lines[{index}].count"


@st.composite
def displaced_cases(draw: st.DrawFn) -> Damage:
    """A case hangs over the pallet's end, or in the air, or stands where another one stands."""
    raw = draw(real)
    index = draw(st.integers(0, len(raw["stack"]) - 1))
    case = raw["stack"][index]
    kind = draw(st.sampled_from(["beyond", "below", "floating", "inside"]))
    if kind == "beyond":
        case["corner"][draw(st.integers(0, 1))] = draw(st.sampled_from([-0.01, 1.19, 9.0]))
    elif kind == "below":
        case["corner"][2] -= 5
    elif kind == "floating":
        case["corner"][2] += 5
    else:
        other = draw(st.integers(0, len(raw["stack"]) - 1).filter(lambda i: i != index))
        case["corner"] = list(raw["stack"][other]["corner"])
        index = min(index, other)
    return raw, f"stack[{index}]"


@st.composite
def repeated_lines(draw: st.DrawFn) -> Damage:
    """A product stands on the note a second time."""
    raw = draw(real)
    raw["lines"].append(draw(st.sampled_from(raw["lines"])))
    return raw, f"lines[{len(raw['lines']) - 1}].gtin"


damages = st.one_of(
    missing_keys(),
    wrong_types(),
    renamed_keys(),
    scaled_numbers(),
    turned_digits(),
    wrong_counts(),
    displaced_cases(),
    repeated_lines(),
)

json_values = st.recursive(
    st.none() | st.booleans() | st.integers() | st.floats() | st.text(max_size=9),
    lambda inner: st.lists(inner, max_size=4) | st.dictionaries(st.text(max_size=9), inner),
    max_leaves=8,
)


@settings(max_examples=120, deadline=None)
@given(damage=damages)
def test_damage_to_a_real_delivery_is_found_where_it_was_done(folder: Path, damage: Damage) -> None:
    """Whatever else follows from it, the place itself is named."""
    raw, place = damage
    with pytest.raises(DeliveryError) as caught:
        read_deliveries(written(folder, raw))
    assert any(problem.where.startswith(place) for problem in caught.value.problems)


@settings(max_examples=50, deadline=None)
@given(first=damages, second=damages)
def test_two_damaged_deliveries_in_one_list_are_both_reported(
    folder: Path, first: Damage, second: Damage
) -> None:
    """One reading is enough, and the sound one between them is not blamed."""
    sound = {**REAL[0], "id": "sound"}
    with pytest.raises(DeliveryError) as caught:
        read_deliveries(written(folder, [first[0], sound, second[0]]))
    told = [problem.where for problem in caught.value.problems]
    for index, place in ((0, first[1]), (2, second[1])):
        assert any(where.startswith(f"[{index}]") and place in where for where in told)
    assert not any(where.startswith("[1]") for where in told)


@settings(max_examples=50, deadline=None)
@given(content=st.binary(max_size=200))
def test_arbitrary_bytes_are_refused_and_nothing_else(folder: Path, content: bytes) -> None:
    """As JSON and as CSV alike."""
    for name in ("bytes.json", "bytes.csv"):
        (folder / name).write_bytes(content)
        with pytest.raises(DeliveryError) as caught:
            read_deliveries(folder / name)
        assert caught.value.problems


@settings(max_examples=50, deadline=None)
@given(value=json_values)
def test_arbitrary_json_is_refused_and_nothing_else(folder: Path, value: object) -> None:
    """No random value is a delivery."""
    with pytest.raises(DeliveryError) as caught:
        read_deliveries(written(folder, value))
    str(caught.value).encode()


@settings(max_examples=50, deadline=None)
@given(raw=real, value=json_values, data=st.data())
def test_arbitrary_json_anywhere_in_a_delivery_raises_nothing_else(
    folder: Path, raw: Raw, value: object, data: st.DataObject
) -> None:
    """It may fit by chance; else it is refused."""
    path = data.draw(st.sampled_from(list(places(raw))))
    at(raw, path[:-1])[path[-1]] = value
    with contextlib.suppress(DeliveryError):
        read_deliveries(written(folder, raw))


@settings(max_examples=50, deadline=None)
@given(
    cells=st.lists(
        st.lists(
            st.sampled_from(["12000823098180", "1", "0.5", "", '"', "a\nb", "nan", "-1", "٣"])
        ),
        max_size=4,
    )
)
def test_arbitrary_cells_under_the_header_raise_nothing_else(
    folder: Path, cells: list[list[str]]
) -> None:
    """Rows of any length, with quotes, line breaks and foreign digits."""
    header = "gtin,name,length_m,width_m,height_m,mass_kg,count"
    rows = "\n".join(",".join(row) for row in cells)
    (folder / "cells.csv").write_text(f"{header}\n{rows}", encoding="utf-8")
    with contextlib.suppress(DeliveryError):
        read_deliveries(folder / "cells.csv")


@st.composite
def notes(draw: st.DrawFn) -> Delivery:
    """Any note that a store may get."""
    gtins = draw(
        st.lists(
            st.sampled_from([7, 11, 12, 13]).flatmap(
                lambda length: st.text("0123456789", min_size=length, max_size=length)
            ),
            min_size=1,
            max_size=5,
            unique_by=lambda payload: payload.zfill(13),
        )
    )
    side = st.floats(0.001, 2.5)
    lines = tuple(
        DeliveryLine(
            Product(
                Gtin(f"{payload}{gs1_standard_check_digit(payload)}"),
                draw(st.text(st.characters(exclude_categories=["C", "Z"]), min_size=1)),
                (draw(side), draw(side), draw(side)),
                draw(st.floats(1e-3, 1000)),
            ),
            draw(st.integers(1, 10_000)),
        )
        for payload in gtins
    )
    return Delivery("any", EURO_PALLET, lines)


def as_raw(delivery: Delivery) -> Raw:
    """A delivery as its file has it."""
    raw: Raw = {
        "id": delivery.id,
        "pallet": {"size": delivery.pallet_size},
        "lines": [
            {
                "gtin": line.product.gtin,
                "name": line.product.name,
                "size": line.product.size,
                "mass": line.product.mass,
                "count": line.count,
            }
            for line in delivery.lines
        ],
    }
    if delivery.stack is not None:
        raw["stack"] = [
            {"gtin": case.gtin, "corner": case.corner, "size": case.size} for case in delivery.stack
        ]
    return raw


@settings(max_examples=50, deadline=None)
@given(delivery=notes())
def test_a_note_survives_writing_and_reading(folder: Path, delivery: Delivery) -> None:
    """As JSON and as CSV, to the last bit."""
    assert read_deliveries(written(folder, as_raw(delivery))) == (delivery,)
    rows = ["gtin,name,length_m,width_m,height_m,mass_kg,count"]
    for line in delivery.lines:
        quoted = line.product.name.replace('"', '""')
        numbers = (*line.product.size, line.product.mass, line.count)
        rows.append(",".join([line.product.gtin, f'"{quoted}"', *map(repr, numbers)]))
    (folder / "any.csv").write_text("\n".join(rows), encoding="utf-8")
    assert read_deliveries(folder / "any.csv") == (delivery,)


def test_the_shipped_deliveries_survive_writing_and_reading(folder: Path) -> None:
    """Stacks included, and in the order of the file."""
    deliveries = shipped_deliveries()
    path = written(folder, [as_raw(delivery) for delivery in deliveries])
    assert read_deliveries(path) == deliveries


@settings(max_examples=30, deadline=None)
@given(data=st.data())
def test_the_order_of_the_stack_does_not_matter(folder: Path, data: st.DataObject) -> None:
    """A sound stack is sound in any order."""
    delivery = data.draw(st.sampled_from(shipped_deliveries()))
    assert delivery.stack is not None
    shuffled = replace(delivery, stack=tuple(data.draw(st.permutations(delivery.stack))))
    assert read_deliveries(written(folder, as_raw(shuffled))) == (shuffled,)
