"""Where the pallet lies as seen from the robot."""

import math

import numpy as np

from depal.domain import PalletStand
from depal.geometry import Vector3


def pallet_front(stand: PalletStand) -> Vector3:
    """Towards the robot from the pallet: the outward normal of the side that faces it."""
    rotation = np.array(stand.cell_from_pallet.rotation)
    x, y, _ = pallet_middle(stand)
    away = np.array([x, y, 0.0])
    axis = max((rotation[:, 0], rotation[:, 1]), key=lambda side: abs(float(side @ away)))
    toward = -axis * math.copysign(1.0, float(axis @ away))
    return (float(toward[0]), float(toward[1]), 0.0)


def pallet_heading(stand: PalletStand) -> float:
    """The direction of the pallet's middle, about the robot's base [rad]."""
    x, y, _ = pallet_middle(stand)
    return math.atan2(y, x)


def pallet_middle(stand: PalletStand) -> Vector3:
    """The middle of the deck, in the cell frame [m]."""
    length, width, _ = stand.size
    return stand.cell_from_pallet.apply((length / 2, width / 2, 0.0))
