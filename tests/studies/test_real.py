"""Real deliveries on geometry alone: everything is taken, and nothing with a box on it."""

import dataclasses

import pytest

from depal.domain import Delivery, Request
from depal.errors import DeliveryError, SettingError
from depal.logistics import shipped_deliveries
from depal.selection import Outcome
from depal.studies.real import burdened_picks, far_side, perceived_stack, unload_delivery

DELIVERIES = {delivery.id: delivery for delivery in shipped_deliveries()}


@pytest.mark.parametrize("name", sorted(DELIVERIES))
@pytest.mark.parametrize("w", [0.0, 0.5, 1.0])
def test_every_box_is_taken_and_none_with_a_box_on_it(name: str, w: float) -> None:
    """With two products requested."""
    delivery = DELIVERIES[name]
    requests = [
        Request(priority=0.7, gtin=delivery.lines[0].product.gtin),
        Request(priority=0.4, gtin=delivery.lines[-1].product.gtin),
    ]
    result = unload_delivery(delivery, requests, w)
    assert result.complete
    assert sorted(result.sequence) == list(range(result.boxes))
    assert result.outcome is Outcome.NOTHING_PERCEIVED
    assert None not in result.served


def test_without_requests_the_order_is_that_of_h_among_the_free() -> None:
    """Eq. (1), by the stack's own numbers."""
    delivery = DELIVERIES["dev-000"]
    boxes, x_max = perceived_stack(delivery), far_side(delivery)
    sequence = unload_delivery(delivery, (), w=0.5).sequence

    def h(index: int) -> float:
        x, y, z = boxes[index].shape.centre
        return abs(y) / 7 + 2 * (x_max - x) / 7 + 4 * z / 7

    def free(index: int, left: set[int]) -> bool:
        low, high = boxes[index].shape.corners.min(axis=0), boxes[index].shape.corners.max(axis=0)
        for other in left - {index}:
            corners = boxes[other].shape.corners
            shared = (high.clip(max=corners.max(axis=0)) - low.clip(min=corners.min(axis=0))) > 1e-6
            on_top = shared[0] and shared[1] and corners.min(axis=0)[2] >= high[2] - 1e-6
            before = shared[1] and shared[2] and corners.max(axis=0)[0] <= low[0] + 1e-6
            if on_top or before:
                return False
        return True

    left = set(range(len(boxes)))
    for index in sequence:
        best = max(h(other) for other in left if free(other, left))
        assert free(index, left)
        assert h(index) == pytest.approx(best, abs=1e-11)
        left.remove(index)


def test_a_request_is_served_no_later_when_it_counts_more() -> None:
    """W = 0 and w = 0.9."""
    for delivery in DELIVERIES.values():
        request = [Request(priority=1.0, gtin=delivery.lines[-1].product.gtin)]
        early, late = (unload_delivery(delivery, request, w).served[0] for w in (0.9, 0.0))
        assert early is not None
        assert late is not None
        assert early <= late


def test_the_referee_sees_a_box_taken_from_under_another() -> None:
    """It can fail."""
    delivery = DELIVERIES["dev-000"]
    sequence = unload_delivery(delivery, (), w=0.0).sequence
    assert burdened_picks(delivery, sequence) == []
    assert burdened_picks(delivery, sequence[::-1]) != []


def test_a_note_alone_cannot_be_unloaded() -> None:
    """One clear error."""
    note = dataclasses.replace(DELIVERIES["dev-000"], stack=None)
    with pytest.raises(DeliveryError, match="is a note without a stack; expected where every"):
        unload_delivery(note, (), w=0.5)


def test_a_weight_out_of_range_is_refused() -> None:
    """One clear error."""
    delivery: Delivery = DELIVERIES["dev-000"]
    with pytest.raises(SettingError, match=r"w: 1.5 is out of range"):
        unload_delivery(delivery, (), w=1.5)
