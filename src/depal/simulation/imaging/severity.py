"""How hard the pictures are for who looks at them."""

from enum import StrEnum


class Severity(StrEnum):
    """How much a camera and the boxes before it differ from their ideal."""

    EASY = "easy"
    NORMAL = "normal"
    HARD = "hard"
