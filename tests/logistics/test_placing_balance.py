"""A pile to which boxes are added where they may go does not tip."""

from itertools import product

import numpy as np
from hypothesis import given
from hypothesis import strategies as st
from scipy.optimize import linprog

from depal.domain import BoxId, Place, PlaceId
from depal.geometry import Pose
from depal.logistics.placing import MARGINS, Held, PlaceMap, Spot, Standing, can_stand, find_spots

PLACE = Place(PlaceId("shelf/level_1"), Pose(), (0.6, 1.0), 0.6)

edges = st.integers(4, 20).map(lambda n: n * 0.02)
heights = st.sampled_from([0.1, 0.1, 0.12])
masses = st.none() | st.floats(1.0, 12.0, width=16)
helds = st.builds(Held, st.tuples(edges, edges, heights), masses)


def weight(box: Standing) -> float:
    """Its mass, or what it is taken for [kg]."""
    return box.volume * 300.0 if box.mass is None else box.mass


def corners(box: Standing, other: Standing | None) -> list[tuple[float, float]]:
    """The corners of the area on which a box stands upon another one, or upon the floor."""
    spans = []
    for axis in (0, 1):
        low, high = box.corner[axis], box.corner[axis] + box.size[axis]
        if other is not None:
            low = max(low, other.corner[axis])
            high = min(high, other.corner[axis] + other.size[axis])
        if high - low < 1e-6:
            return []
        spans.append((low, high))
    if other is not None:
        gap = box.corner[2] - other.corner[2] - other.size[2]
        return list(product(*spans)) if -1e-6 < gap <= MARGINS.level + 2e-6 else []
    return list(product(*spans)) if box.corner[2] < 1e-6 else []


def can_be_in_balance(boxes: tuple[Standing, ...]) -> bool:
    """Whether forces at the corners of all contacts, none of them pulling, hold every box."""
    columns = []
    for i, box in enumerate(boxes):
        for k, other in [(-1, None), *enumerate(boxes)]:
            if k == i:
                continue
            for x, y in corners(box, other):
                column = np.zeros((len(boxes), 3))
                column[i] = (1.0, x, y)
                if k >= 0:
                    column[k] = (-1.0, -x, -y)
                columns.append(column.ravel())
    middles = [[1.0, b.corner[0] + b.size[0] / 2, b.corner[1] + b.size[1] / 2] for b in boxes]
    needed = np.array([weight(b) * np.array(m) for b, m in zip(boxes, middles, strict=True)])
    found = linprog(np.zeros(len(columns)), A_eq=np.array(columns).T, b_eq=needed.ravel())
    return bool(found.status == 0)


@given(st.lists(st.tuples(helds, st.integers(0, 7)), min_size=2, max_size=14))
def test_a_pile_of_boxes_in_offered_spots_can_be_in_balance(
    boxes: list[tuple[Held, int]],
) -> None:
    """By the equations of statics, whichever spots are taken."""
    place_map = PlaceMap(PLACE)
    for number, (held, choice) in enumerate(boxes):
        if spots := find_spots(place_map, held):
            high = sorted(spots, key=lambda spot: -spot.corner[2])
            spot = high[choice % len(high)]
            place_map = place_map.with_box(spot.standing(BoxId(str(number)), held.mass))
    assert can_be_in_balance(place_map.boxes)


def test_a_box_is_not_put_on_an_overhang_that_it_would_tip() -> None:
    """The overhang is a quarter; as heavy as what overhangs is borne, twice as heavy is not."""
    base = Standing(BoxId("base"), (0.2, -0.1, 0.0), (0.3, 0.2, 0.2), 10.0)
    upper = Standing(BoxId("upper"), (0.1, -0.1, 0.2), (0.4, 0.2, 0.2), 4.0)
    place_map = PlaceMap(PLACE, (base, upper))
    spot = Spot(PLACE.id, (0.1, -0.1, 0.4), (0.1, 0.2, 0.2))
    assert can_stand(place_map, Held(spot.size, 4.0), spot)
    assert can_be_in_balance((*place_map.boxes, spot.standing(BoxId("top"), 4.0)))
    assert not can_stand(place_map, Held(spot.size, 8.0), spot)
    assert not can_be_in_balance((*place_map.boxes, spot.standing(BoxId("top"), 8.1)))
