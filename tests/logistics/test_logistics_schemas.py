"""The published schemas, and what the package hands out."""

import json
from collections.abc import Callable
from importlib import resources
from typing import Any

import pytest
from jsonschema import Draft202012Validator

import depal.logistics
from depal.logistics import delivery_schema, requests_schema

Raw = dict[str, Any]
FILE = resources.files("depal.logistics") / "deliveries" / "shipped.json"


def test_the_package_hands_out_these_names() -> None:
    """A change here is a change for its users."""
    assert sorted(depal.logistics.__all__) == [
        "check_requests",
        "deliveries_in",
        "delivery_schema",
        "read_deliveries",
        "read_delivery",
        "read_requests",
        "requests_schema",
        "shipped_deliveries",
    ]


@pytest.mark.parametrize("schema", [delivery_schema, requests_schema])
def test_a_schema_is_a_schema(schema: Callable[[], Raw]) -> None:
    """Of the draft that it names, with a title and no address."""
    Draft202012Validator.check_schema(schema())
    assert schema()["$schema"] == "https://json-schema.org/draft/2020-12/schema"
    assert schema()["title"]
    assert "$id" not in schema()


def test_every_field_is_described() -> None:
    """The descriptions are also what errors say was expected."""
    schemas = [*delivery_schema()["$defs"].values(), *requests_schema()["$defs"].values()]
    assert all(field["description"] for part in schemas for field in part["properties"].values())


def test_real_deliveries_follow_the_schema_alone_and_as_a_list() -> None:
    """A file holds one delivery or a list."""
    validator = Draft202012Validator(delivery_schema())
    real = json.loads(FILE.read_text("utf-8"))
    assert validator.is_valid(real)
    assert all(validator.is_valid(raw) for raw in real)


@pytest.mark.parametrize(
    "damage",
    [
        lambda raw: raw.update(lines=[]),
        lambda raw: raw.update(stack=[]),
        lambda raw: raw.update(stack=None),
        lambda raw: raw.update(id=" "),
        lambda raw: raw.update(colour="red"),
        lambda raw: raw.pop("pallet"),
        lambda raw: raw["lines"][0].update(gtin="123"),
        lambda raw: raw["lines"][0].update(mass=0),
        lambda raw: raw["lines"][0].update(mass=5399),
        lambda raw: raw["lines"][0].update(count=0),
        lambda raw: raw["lines"][0].update(size=[0.1, 0.1]),
        lambda raw: raw["lines"][0].update(size=[0.1, 0.1, 400]),
        lambda raw: raw["stack"][0].update(corner=[0, 0, "0"]),
    ],
)
def test_the_schema_refuses_what_a_schema_can_refuse(
    toy: Raw, damage: Callable[[Raw], object]
) -> None:
    """Editors that know the schema mark these mistakes while typing."""
    validator = Draft202012Validator(delivery_schema())
    assert validator.is_valid(toy)
    damage(toy)
    assert not validator.is_valid(toy)
    assert not validator.is_valid([])


@pytest.mark.parametrize(
    ("item", "valid"),
    [
        ({"at": "0 s", "gtin": "12000823098180", "priority": 0.8}, True),
        ({"at": 95, "box": "b1", "priority": 1, "due": "1.5 min"}, True),
        ({"priority": 0.8}, False),
        ({"gtin": "12000823098180", "box": "b1", "priority": 0.8}, False),
        ({"box": "b1", "priority": 2}, False),
        ({"box": "b1", "priority": 1, "at": "1:30"}, False),
    ],
)
def test_the_schema_of_requests_says_either_product_or_box(item: Raw, *, valid: bool) -> None:
    """With a priority, and times with their units."""
    assert Draft202012Validator(requests_schema()).is_valid([item]) is valid
