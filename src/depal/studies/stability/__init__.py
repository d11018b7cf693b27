"""How true the margins are, and what the guard is worth: the linear program beside MuJoCo."""

from depal.studies.stability.study import (
    LOOSE,
    PACKED,
    Agreement,
    Paired,
    Row,
    Stability,
    mcnemar,
    stability,
    summed_up,
)

__all__ = [
    "LOOSE",
    "PACKED",
    "Agreement",
    "Paired",
    "Row",
    "Stability",
    "mcnemar",
    "stability",
    "summed_up",
]
