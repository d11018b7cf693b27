"""A cell without physics and without paths, behind the same ports: a hundred boxes a second.

What it leaves out are forces, collisions and pictures. What it keeps is what exactly one placement
depends on: where every box is, what hangs on the arm and how much of it, what the valves do while
nobody commands them, and people who act while the controller is gone. Its arm moves its flange
along straight lines: the six axes are x, y, z [m] and yaw [rad] of the flange and two that are 0.
"""

from depal.simulation.light.cell import LightCell, build_light
from depal.simulation.light.life import EndedError, Life
from depal.simulation.light.piles import light_delivery
from depal.simulation.light.rates import NO_FAULTS, SOAK, Rates
from depal.simulation.light.world import FLOOR, HAND, PALLET, REMOVED, LightBox, LightWorld

__all__ = [
    "FLOOR",
    "HAND",
    "NO_FAULTS",
    "PALLET",
    "REMOVED",
    "SOAK",
    "EndedError",
    "Life",
    "LightBox",
    "LightCell",
    "LightWorld",
    "Rates",
    "build_light",
    "light_delivery",
]
