"""Several requests with due times: the paper's maximum, and an agenda, beside the optimum."""

from depal.studies.due.optimum import Wanted, least_lateness
from depal.studies.due.trials import (
    HORIZON,
    POLICIES,
    SMALL,
    DuePiece,
    DueRow,
    draw_pallet,
    due_rows,
    small_pallets,
)

__all__ = [
    "HORIZON",
    "POLICIES",
    "SMALL",
    "DuePiece",
    "DueRow",
    "Wanted",
    "draw_pallet",
    "due_rows",
    "least_lateness",
    "small_pallets",
]
