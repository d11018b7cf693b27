"""A note without a stack is stacked so that it stands."""

from dataclasses import replace

import numpy as np
import pytest
from simulated_layouts import EURO, layout

from depal.domain import Delivery, DeliveryLine, Gtin, Product
from depal.errors import DeliveryError
from depal.logistics import shipped_deliveries
from depal.simulation import build, stacked


@pytest.mark.parametrize("number", range(10))
def test_a_real_note_stacks_without_overlap_within_the_pallet(number: int) -> None:
    """Every case of the note once, none inside another."""
    note = replace(shipped_deliveries()[number], stack=None)
    stack = stacked(note)
    assert sorted(case.gtin for case in stack) == sorted(b.product.gtin for b in note.boxes)
    low = np.array([case.corner for case in stack])
    high = low + np.array([case.size for case in stack])
    overlap = np.minimum(high[:, None], high[None]) - np.maximum(low[:, None], low[None])
    resting = np.abs(low[:, None, 2] - high[None, :, 2]) < 1e-3
    area = (np.clip(overlap[:, :, :2], 0, None).prod(axis=2) * resting).sum(axis=1)
    share = area / (high - low)[:, :2].prod(axis=1)
    assert (share[low[:, 2] > 0] > 0.5).all()
    depth = overlap.min(axis=2)
    np.fill_diagonal(depth, 0.0)
    assert depth.max() < 1e-3
    assert low.min() > -1e-3
    assert (high.max(axis=0)[:2] < np.array(EURO[:2]) + 1e-3).all()


def test_a_stacked_note_stands() -> None:
    """Nothing moves once it has settled."""
    note = replace(shipped_deliveries()[-1], stack=None)
    cell = build(layout(), note)
    cell.world.refresh()
    cell.world.advance(3.0)
    assert cell.referee.summary().boxes == {"pallet": len(note.boxes)}
    assert cell.referee.moved() < 0.001


def test_a_note_that_does_not_fit_is_refused() -> None:
    """With how many cases there is room for."""
    product = Product(Gtin("10000000000000"), "crate", (0.6, 0.8, 0.5), 5.0)
    with pytest.raises(DeliveryError, match="room for 6 of 7 cases only"):
        stacked(Delivery("large", EURO, (DeliveryLine(product, 7),)))


def test_an_empty_note_is_an_empty_stack() -> None:
    """No case, no corner."""
    assert stacked(Delivery("empty", EURO, ())) == ()
