"""A stack stands where the delivery says, and stays there."""

import numpy as np
import pytest
from simulated_layouts import layout

from depal.domain import Delivery
from depal.logistics import shipped_deliveries
from depal.simulation.cases import cases_of
from depal.simulation.world import World

CELL = layout()


def the_largest() -> Delivery:
    """The shipped delivery with the most cases."""
    deliveries = [delivery for delivery in shipped_deliveries() if delivery.stack]
    return max(deliveries, key=lambda delivery: len(delivery.stack or ()))


@pytest.fixture(scope="module")
def world() -> World:
    """Its stack, settled."""
    note = the_largest()
    return World(CELL, cases_of(note, note.stack or (), CELL))


def centres(world: World) -> np.ndarray:
    """Of all boxes, (n, 3)."""
    return np.array([world.box(index).translation for index in range(len(world.cases))])


def test_a_settled_stack_stands_within_two_millimetres_of_the_delivery(world: World) -> None:
    """A settled stack stands within two millimetres of the delivery."""
    said = np.array([case.shape.centre for case in world.cases])
    assert len(said) >= 40
    assert np.abs(centres(world) - said).max() < 0.002


def test_a_settled_stack_that_is_kept_awake_drifts_less_than_a_millimetre_in_ten_seconds(
    world: World,
) -> None:
    """A settled stack that is kept awake drifts less than a millimetre in ten seconds."""
    before, steps = centres(world), world.steps
    for _ in range(100):
        world.refresh()  # nobody sleeps
        world.advance(world.now + 0.1)
    assert world.steps - steps > 4900
    assert np.abs(centres(world) - before).max() < 0.001
