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


@pytest.mark.parametrize("number", range(10))
def test_every_stack_that_ships_comes_to_rest_where_the_delivery_says(number: int) -> None:
    """Within a millimetre, and asleep: nothing creeps."""
    note = shipped_deliveries()[number]
    world = World(CELL, cases_of(note, note.stack or (), CELL))
    said = np.array([case.shape.centre for case in world.cases])
    assert np.abs(centres(world) - said).max() < 0.001
    assert (world.data.tree_asleep[1:] >= 0).all()


def test_a_settled_stack_that_is_kept_awake_drifts_less_than_a_millimetre_in_ten_seconds(
    world: World,
) -> None:
    """Asleep nothing could drift, so it is woken ten times a second."""
    before, steps = centres(world), world.steps
    for _ in range(100):
        world.refresh()  # nobody sleeps
        world.advance(world.now + 0.1)
    assert world.steps - steps > 4900
    assert np.abs(centres(world) - before).max() < 0.001
