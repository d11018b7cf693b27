"""Laws of placing, held against a checker that knows nothing of the kernels."""

import math
from itertools import pairwise

from hypothesis import given
from hypothesis import strategies as st

from depal.domain import BoxId, Place, PlaceId
from depal.geometry import OrientedBox, Pose
from depal.logistics.placing import (
    MARGINS,
    Envelope,
    Held,
    PlaceMap,
    Spot,
    Standing,
    can_stand,
    envelopes,
    find_spots,
    is_full_for,
)

Range = tuple[float, float]
EPS = 2e-6

SMALL = Place(PlaceId("trolley_1/level_1"), Pose(), (0.5, 0.45), 0.45)
LARGE = Place(PlaceId("shelf/level_1"), Pose(), (1.2, 0.5), 0.6)
FLUSH = Envelope(reach=-0.015, right=-0.15, left=0.15, low=0.01, high=0.21)
ABOVE = Envelope(reach=0.1, right=-0.15, left=0.15, low=0.2, high=0.4)

edges = st.integers(4, 24).map(lambda n: n * 0.02)
tools = st.sampled_from([(), (FLUSH,), (ABOVE,), (FLUSH, ABOVE)])
helds = st.builds(
    Held, st.tuples(edges, edges, edges), st.none() | st.floats(1.0, 15.0, width=16), tools
)
places = st.sampled_from([SMALL, LARGE])
choices = st.lists(st.tuples(helds, st.integers(0, 7)), max_size=12)


def filled(place: Place, boxes: list[tuple[Held, int]]) -> PlaceMap:
    """A place after boxes went, one by one, to one of the spots that were offered."""
    place_map = PlaceMap(place)
    for number, (held, choice) in enumerate(boxes):
        if spots := find_spots(place_map, held):
            spot = spots[choice % len(spots)]
            place_map = place_map.with_box(spot.standing(BoxId(str(number)), held.mass))
    return place_map


def ranges(box: Standing | Spot) -> tuple[Range, Range, Range]:
    """A box as intervals along x, y, z."""
    x, y, z = ((low, low + edge) for low, edge in zip(box.corner, box.size, strict=True))
    return x, y, z


def shared(a: Range, b: Range) -> float:
    """The length that two intervals share; negative where they are apart."""
    return min(a[1], b[1]) - max(a[0], b[0])


def meet(a: tuple[Range, ...], b: tuple[Range, ...]) -> bool:
    """Whether two cuboids share space."""
    return all(shared(one, other) > EPS for one, other in zip(a, b, strict=True))


def objections(place_map: PlaceMap, held: Held, spot: Spot) -> list[str]:
    """Everything that is wrong with a spot, by brute force."""
    (width, height), depth = place_map.place.opening, place_map.place.depth
    x, y, z = ranges(spot)
    c, lift = MARGINS.clearance, MARGINS.lift
    wrong = []
    inside = (0.0, depth - c), (c - width / 2, width / 2 - c), (0.0, height - lift)
    if any(
        shared(room, edge) < edge[1] - edge[0] - EPS
        for room, edge in zip(inside, (x, y, z), strict=True)
    ):
        wrong.append("not inside")
    wide = (y[0] - c, y[1] + c)
    way = (-math.inf, x[1] + c), wide, (z[0] + lift - MARGINS.skim, z[1] + lift)
    down = (x[0] - c, x[1] + c), wide, (z[0], z[1] + lift)
    carried = 0.0
    for box in place_map.boxes:
        other = ranges(box)
        if meet(way, other):
            wrong.append(f"pushed into {box.id}")
        if meet(down, other):
            wrong.append(f"set down onto the edge of {box.id}")
        if abs(other[2][1] - z[0]) <= MARGINS.level + EPS:
            area = max(shared(x, other[0]), 0.0) * max(shared(y, other[1]), 0.0)
            carried += area
            if area and held.mass and box.mass and held.mass > MARGINS.heavier * box.mass:
                wrong.append(f"too heavy for {box.id}")
    if z[0] > EPS and carried < MARGINS.support * held.size[0] * held.size[1] - EPS:
        wrong.append("not carried")
    return wrong + tool_objections(place_map, held, spot)


def tool_objections(place_map: PlaceMap, held: Held, spot: Spot) -> list[str]:
    """What the tool would touch on its way in and down."""
    (width, height), depth = place_map.place.opening, place_map.place.depth
    x, y, z = ranges(spot)
    wrong = []
    for part in held.tool:
        end = x[0] + part.reach
        if end <= EPS:
            continue
        middle = (y[0] + y[1]) / 2
        across = (middle + part.right, middle + part.left)
        up = (z[0] + part.low, z[0] + part.high + MARGINS.lift)
        if end > depth or max(across[1], -across[0]) > width / 2 or up[0] < 0 or up[1] > height:
            wrong.append("the tool meets the compartment")
        wrong += [
            f"the tool meets {box.id}"
            for box in place_map.boxes
            if meet(((-math.inf, end), across, up), ranges(box))
        ]
    return wrong


@given(places, choices, helds)
def test_every_spot_is_free_carried_and_on_a_straight_way_in(
    place: Place, boxes: list[tuple[Held, int]], held: Held
) -> None:
    """Walls, boxes, tops and the tool, each held against every spot."""
    place_map = filled(place, boxes)
    for spot in find_spots(place_map, held):
        assert objections(place_map, held, spot) == []
        assert can_stand(place_map, held, spot)


@given(places, choices)
def test_boxes_that_were_put_where_they_could_go_never_overlap(
    place: Place, boxes: list[tuple[Held, int]]
) -> None:
    """Whichever of the offered spots are taken."""
    place_map = filled(place, boxes)
    for number, box in enumerate(place_map.boxes):
        for other in place_map.boxes[:number]:
            assert not meet(ranges(box), ranges(other))
    assert place_map.fill < 1.0


def pile_under(place_map: PlaceMap, spot: Spot) -> set[BoxId]:
    """The boxes that share a pile with a spot: below it, or balanced on what is below it."""
    under: list[Standing | Spot] = [spot]
    for one in under:
        x, y, z = ranges(one)
        for box in place_map.boxes:
            other = ranges(box)
            stacked = shared(x, other[0]) > 0 and shared(y, other[1]) > 0
            if stacked and abs(other[2][1] - z[0]) <= MARGINS.level + EPS:
                under.append(box)
    pile = {box.id for box in under if isinstance(box, Standing)}
    above = [box for box in place_map.boxes if pile & carriers(place_map, box)]
    return pile | {box.id for box in above}


def carriers(place_map: PlaceMap, box: Standing) -> set[BoxId]:
    """The boxes under a box, however far."""
    x, y, z = ranges(box)
    found: set[BoxId] = set()
    for other in place_map.boxes:
        a, b, c = ranges(other)
        if shared(x, a) > 0 and shared(y, b) > 0 and c[1] <= z[0] + EPS:
            found.add(other.id)
    return found


@given(places, choices, helds, st.data())
def test_a_spot_stays_possible_when_a_box_of_another_pile_leaves(
    place: Place, boxes: list[tuple[Held, int]], held: Held, data: st.DataObject
) -> None:
    """Less in the way never closes a way."""
    place_map = filled(place, boxes)
    spots = find_spots(place_map, held)
    if not (spots and place_map.boxes):
        return
    spot = data.draw(st.sampled_from(spots))
    pile = pile_under(place_map, spot)
    for box in place_map.boxes:
        if box.id not in pile:
            assert can_stand(place_map.without_box(box.id), held, spot)


@given(places, choices, helds)
def test_the_same_question_has_the_same_answer_and_distinct_spots(
    place: Place, boxes: list[tuple[Held, int]], held: Held
) -> None:
    """And a place is full where there is no answer."""
    place_map = filled(place, boxes)
    spots = find_spots(place_map, held)
    assert spots == find_spots(filled(place, boxes), held)
    assert len(set(spots)) == len(spots) <= 8
    assert is_full_for(place_map, [held]) == (not spots)


@given(places, choices, helds, st.floats(0.0, 0.4))
def test_no_box_is_brought_deeper_than_the_arm_reaches(
    place: Place, boxes: list[tuple[Held, int]], held: Held, max_depth: float
) -> None:
    """The outward face is what the arm holds on to."""
    place_map = filled(place, boxes)
    for spot in find_spots(place_map, held, max_depth=max_depth):
        assert spot.depth <= max_depth + EPS
        assert can_stand(place_map, held, spot, max_depth=max_depth)


@given(places, choices, helds)
def test_spots_that_cannot_be_reached_are_left_out_and_others_offered_instead(
    place: Place, boxes: list[tuple[Held, int]], held: Held
) -> None:
    """The caller's word counts."""
    place_map = filled(place, boxes)
    best = find_spots(place_map, held, limit=1)
    rest = find_spots(place_map, held, reachable=lambda spot: spot not in best)
    assert set(best).isdisjoint(rest)
    assert set(find_spots(place_map, held)) - set(best) <= set(rest)


def test_the_first_box_goes_to_the_back_against_a_wall() -> None:
    """One clearance away from each."""
    (spot, *_) = find_spots(PlaceMap(SMALL), Held((0.2, 0.15, 0.2)))
    assert math.isclose(spot.corner[0] + 0.2, 0.45 - MARGINS.clearance)
    assert math.isclose(abs(spot.corner[1] + 0.075), 0.25 - MARGINS.clearance - 0.075)
    assert spot.corner[2] == 0.0


def test_a_tool_wider_than_the_box_keeps_it_from_the_wall() -> None:
    """Or else it would scrape along it."""
    (spot, *_) = find_spots(PlaceMap(SMALL), Held((0.2, 0.15, 0.2), tool=(FLUSH,)))
    middle = abs(spot.corner[1] + 0.075)
    assert spot.depth > 0.2
    assert middle <= 0.25 - MARGINS.clearance - 0.15 + EPS


def test_a_tool_above_the_box_needs_the_height() -> None:
    """Or else the box stays at the opening."""
    spots = find_spots(PlaceMap(SMALL), Held((0.2, 0.15, 0.2), tool=(ABOVE,)))
    assert spots
    tall = find_spots(
        PlaceMap(SMALL), Held((0.2, 0.15, 0.2), tool=(Envelope(0.1, 0, 0, 0.2, 0.5),))
    )
    assert not [spot for spot in tall if spot.depth > 0.0]


def test_a_much_heavier_box_is_not_put_on_a_light_one() -> None:
    """Twice as heavy is still allowed; unknown is, too."""
    light = Standing(BoxId("light"), (0.03, -0.24, 0.0), (0.41, 0.48, 0.15), mass=2.0)
    place_map = PlaceMap(SMALL, (light,))
    assert find_spots(place_map, Held((0.3, 0.3, 0.2), mass=3.9))
    assert not find_spots(place_map, Held((0.3, 0.3, 0.2), mass=4.1))
    assert find_spots(place_map, Held((0.3, 0.3, 0.2)))


def test_a_box_may_lie_across_two_whose_tops_are_almost_level() -> None:
    """4 mm are level, 10 mm are not."""
    pair = [
        Standing(BoxId("left"), (0.03, 0.0, 0.0), (0.41, 0.24, 0.150)),
        Standing(BoxId("right"), (0.03, -0.24, 0.0), (0.41, 0.23, 0.147)),
    ]
    (spot, *_) = find_spots(PlaceMap(SMALL, tuple(pair)), Held((0.4, 0.46, 0.2)))
    assert spot.corner[2] == 0.150
    assert set(spot.carried_by) == {"left", "right"}
    uneven = Standing(BoxId("right"), (0.03, -0.24, 0.0), (0.41, 0.23, 0.140))
    assert not find_spots(PlaceMap(SMALL, (pair[0], uneven)), Held((0.4, 0.46, 0.2)))


def test_several_depths_are_offered_for_an_arm_that_does_not_get_deep() -> None:
    """Motion planning tries them in order."""
    depths = sorted(
        {round(spot.depth, 3) for spot in find_spots(PlaceMap(LARGE), Held((0.2, 0.3, 0.2)))}
    )
    assert len(depths) >= 3
    assert all(b > a for a, b in pairwise(depths))


def test_an_envelope_holds_the_solid_that_it_was_made_from() -> None:
    """Relative to the lower edge of the outward face."""
    plate = OrientedBox(Pose((-0.12, 0.01, -0.02)), (0.01, 0.3, 0.2))
    (envelope,) = envelopes([plate], (0.2, 0.3, 0.24))
    found = (envelope.reach, envelope.right, envelope.left, envelope.low, envelope.high)
    expected = (-0.015, -0.14, 0.16, 0.0, 0.2)
    assert all(math.isclose(a, b, abs_tol=1e-12) for a, b in zip(found, expected, strict=True))


def stands_behind(step: float) -> bool:
    """Whether a box can be pushed to the back over one of 0.1 m, whose neighbour is higher."""
    front = Standing(BoxId("front"), (0.0, -0.24, 0.0), (0.1, 0.48, 0.1 + step))
    back = Standing(BoxId("back"), (0.12, -0.24, 0.0), (0.32, 0.48, 0.1))
    spot = Spot(SMALL.id, (0.14, -0.15, 0.1), (0.3, 0.3, 0.2))
    place_map = PlaceMap(SMALL, (front, back))
    assert (objections(place_map, Held(spot.size), spot) == []) == (step <= 0.007)
    return can_stand(place_map, Held(spot.size), spot)


def test_a_box_is_pushed_in_over_what_is_little_higher() -> None:
    """7 mm are passed over by 8 mm; 8 mm would be too close."""
    assert stands_behind(0.0069)
    assert not stands_behind(0.0075)


def below_the_roof(top: float) -> bool:
    """Whether a box goes in with a tool that reaches so high above the floor [m]."""
    tool = (Envelope(reach=-0.02, right=-0.1, left=0.1, low=0.01, high=top),)
    held = Held((0.2, 0.2, 0.2), tool=tool)
    return any(spot.depth > 0.1 for spot in find_spots(PlaceMap(SMALL), held))


def test_the_tool_is_lifted_below_the_roof_as_the_box_is() -> None:
    """15 mm of lift and 5 mm of room."""
    assert below_the_roof(0.4299)
    assert not below_the_roof(0.4301)


def test_the_tool_passes_below_and_beside_boxes_with_room() -> None:
    """A box beside the way of the tool keeps it outside, unless it is 10 mm away."""

    def stands_deep(edge: float) -> bool:
        side = Standing(BoxId("side"), (0.0, edge, 0.0), (0.1, 0.48 / 2 - edge, 0.2))
        held = Held((0.2, 0.1, 0.1), tool=(FLUSH,))
        spot = Spot(SMALL.id, (0.2, -0.14, 0.0), held.size)
        return can_stand(PlaceMap(SMALL, (side,)), held, spot)

    assert stands_deep(0.0701)
    assert not stands_deep(0.0699)
