"""How full the places of small trolleys become with real deliveries."""

import os
import time

import pytest

from depal.domain import BoxId, Delivery, Place, PlaceId
from depal.errors import DeliveryError
from depal.geometry import Pose
from depal.logistics import shipped_deliveries
from depal.logistics.placing import (
    Arrival,
    Envelope,
    Held,
    PlaceMap,
    arrivals,
    find_spots,
    measure_fill,
)
from depal.studies.real import unload_delivery

SMALL = [
    Place(PlaceId(f"trolley_{bay}/level_{level}"), Pose(), (0.60, 0.60), 0.50)
    for bay in (1, 2, 3)
    for level in (1, 2)
]


def in_order(delivery: Delivery) -> tuple[Arrival, ...]:
    """The boxes as the paper's Algorithm 1 takes them."""
    return arrivals(delivery, unload_delivery(delivery, (), 0.5).sequence)


def test_the_places_of_small_trolleys_are_half_full_when_they_are_declared_full() -> None:
    """The large ones among the shipped deliveries fill three trolleys; no box is refused."""
    deliveries = [in_order(delivery) for delivery in shipped_deliveries()]
    filling = measure_fill(deliveries, SMALL)
    assert len(filling.fills) >= 10
    assert filling.mean >= 0.5
    assert filling.refused == 0
    assert filling.stored == sum(len(each) for each in deliveries)


def test_a_box_that_no_place_takes_is_refused_and_the_empty_trolleys_stay() -> None:
    """Exchanging them would not help."""
    huge = Arrival(BoxId("b0"), (Held((0.3, 0.3, 0.7)),))
    small = Arrival(BoxId("b1"), (Held((0.3, 0.3, 0.3)),))
    assert measure_fill([[huge]], SMALL).fills == ()
    filling = measure_fill([[small, huge, small]], SMALL[:1])
    assert (filling.stored, filling.refused, len(filling.fills)) == (2, 1, 1)
    assert filling.mean == pytest.approx(0.027 / SMALL[0].volume)
    assert measure_fill([], SMALL).mean == 0.0


def test_a_note_without_a_stack_brings_no_boxes() -> None:
    """Nobody knows how they stand."""
    delivery = shipped_deliveries()[0]
    note = Delivery(delivery.id, delivery.pallet_size, delivery.lines)
    with pytest.raises(DeliveryError, match="is a note without a stack"):
        arrivals(note, [0])


@pytest.mark.skipif(
    os.environ.get("NUMBA_DISABLE_JIT", "0") not in {"", "0"}, reason="plain Python is slow"
)
def test_spots_beside_fifteen_boxes_are_found_in_two_milliseconds() -> None:
    """Median of some calls on a place that is filled with small boxes."""
    place_map = PlaceMap(Place(PlaceId("shelf/level_1"), Pose(), (1.2, 0.6), 0.6))
    held = Held((0.2, 0.22, 0.2), 3.0, (Envelope(-0.02, -0.15, 0.15, 0.01, 0.2),) * 3)
    for number in range(15):
        spot, *_ = find_spots(place_map, Held((0.2, 0.2 + number * 0.001, 0.15), 3.0))
        place_map = place_map.with_box(spot.standing(BoxId(f"b{number}"), 3.0))
    taken = []
    for _ in range(9):
        begin = time.perf_counter()
        find_spots(place_map, held)
        taken.append(time.perf_counter() - begin)
    assert sorted(taken)[4] < 0.002
