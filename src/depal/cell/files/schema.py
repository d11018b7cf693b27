"""The published JSON Schema of a cell file."""

from depal.cell.files.cell_model import CellEntry
from depal.logistics.expectations import Schema


def cell_schema() -> Schema:
    """The JSON Schema (draft 2020-12) of a cell file, read as YAML.

    What a schema cannot say is left to `read_cell`: names that must exist, levels within their
    storage, cups within their module, angles within their limits.

    Returns:
        The schema as a new dictionary.
    """
    return {
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        **CellEntry.model_json_schema(),
        "title": "Cell file",
        "description": "A cell. Metres, degrees, kilograms, seconds, pascals; the robot's base "
        "is the origin, x points to the pallet, y to the left, z up.",
    }
