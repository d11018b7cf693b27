"""How many boxes must leave before a requested one: the paper's rule and access, with bounds."""

from depal.studies.retrieval.referee import Checked, checked
from depal.studies.retrieval.rows import Row
from depal.studies.retrieval.stacks import StackPiece, StackRows, real_rows, stack_rows
from depal.studies.retrieval.trials import SHARES, random_rows

__all__ = [
    "SHARES",
    "Checked",
    "Row",
    "StackPiece",
    "StackRows",
    "checked",
    "random_rows",
    "real_rows",
    "stack_rows",
]
