"""What simulated time is charged for computing and sensing, so that a rate hides nothing."""

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Charges:
    """Fixed times [s]; work done while the arm moves anyway is not charged.

    Attributes:
        plan: one motion with its straight parts.
        read: one reading of the barcode reader.
    """

    plan: float = 0.2
    read: float = 0.3
