"""Scenes for perception: pictures of a pallet with their truth, without physics."""

from depal.simulation.imaging.severity import Severity
from depal.simulation.scenes.assortment import assortment, sibling_share
from depal.simulation.scenes.piles import Kind
from depal.simulation.scenes.random_stacks import random_delivery
from depal.simulation.scenes.scene import Scene, scene
from depal.simulation.scenes.truth import TrueBox, TrueFace, Truth

__all__ = [
    "Kind",
    "Scene",
    "Severity",
    "TrueBox",
    "TrueFace",
    "Truth",
    "assortment",
    "random_delivery",
    "scene",
    "sibling_share",
]
