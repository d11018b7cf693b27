"""Random pallets to select from: five generators, one volume, 9 to 44 boxes.

All boxes stand axis-aligned in the same 0.8 (x) x 1.6 (y) x 1.0 (z) m in front of the robot, in
the cell frame. The number of boxes is uniform in 9..44 and no side is below 5 cm.

    guillotine  random cuts near the middle of random boxes; fills the volume
    layered     full layers of one height each, cut in the ground plane; fills the volume
    cubic       always the largest box along its longest side; fills the volume
    columns     towers side by side, each cut at its own heights; fills the volume
    dropped     near-cubic boxes dropped on one another; gaps and bridges

A generator draws from nothing but `Generator.random`, and computes with integers from there on:
the same state gives the same pallet on every machine.
"""

from depal.studies.pallets.guillotine import guillotine_boxes
from depal.studies.pallets.named import (
    GENERATORS,
    PalletGenerator,
    generator_named,
    named_generators,
)
from depal.studies.pallets.pallet import RandomPallet
from depal.studies.pallets.volume import COUNTS, SIZE, SMALLEST, X_MAX, X_NEAR

__all__ = [
    "COUNTS",
    "GENERATORS",
    "SIZE",
    "SMALLEST",
    "X_MAX",
    "X_NEAR",
    "PalletGenerator",
    "RandomPallet",
    "generator_named",
    "guillotine_boxes",
    "named_generators",
]
