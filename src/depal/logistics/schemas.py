"""The published JSON Schemas of the two file formats."""

from depal.logistics.expectations import Schema
from depal.logistics.models import DeliveryEntry
from depal.logistics.request_model import RequestEntry

_DIALECT = "https://json-schema.org/draft/2020-12/schema"


def delivery_schema() -> Schema:
    """The JSON Schema (draft 2020-12) of a delivery file: one delivery or a list of them.

    What a schema cannot say is left to `read_deliveries`: check digits, each product on one
    line, the stack as the note promises it, and cases that can stand where they stand.

    Returns:
        The schema as a new dictionary.
    """
    entry = DeliveryEntry.model_json_schema()
    parts = entry.pop("$defs")
    one = {"$ref": "#/$defs/DeliveryEntry"}
    return {
        "$schema": _DIALECT,
        "title": "Delivery file",
        "description": "One delivery or a list of deliveries. Metres and kilograms.",
        "anyOf": [one, {"type": "array", "items": one, "minItems": 1}],
        "$defs": {**parts, "DeliveryEntry": entry},
    }


def requests_schema() -> Schema:
    """The JSON Schema (draft 2020-12) of a file of requests, read as YAML.

    Returns:
        The schema as a new dictionary.
    """
    entry = RequestEntry.model_json_schema()
    return {
        "$schema": _DIALECT,
        "title": "Requests file",
        "description": "A list of what the store wants first. Times since the start of the run.",
        "type": "array",
        "items": {"$ref": "#/$defs/RequestEntry"},
        "$defs": {"RequestEntry": entry},
    }
