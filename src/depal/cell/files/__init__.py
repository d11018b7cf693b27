"""Cells as files: read once at the edge, checked as a whole, then trusted."""

from depal.cell.files.reading import (
    SHIPPED,
    cell_of_yaml,
    find_cell,
    read_cell,
    shipped_cell,
    shipped_text,
)
from depal.cell.files.schema import cell_schema

__all__ = [
    "SHIPPED",
    "cell_of_yaml",
    "cell_schema",
    "find_cell",
    "read_cell",
    "shipped_cell",
    "shipped_text",
]
