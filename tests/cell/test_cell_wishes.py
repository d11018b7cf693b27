"""Requests: each is served once, by one box, and what left before is counted."""

from hypothesis import given
from hypothesis import strategies as st

from depal.cell.wishes import Wishes
from depal.domain import BoxId, Gtin, Request

GTINS = [Gtin(f"product-{n}") for n in range(3)]

requests = st.builds(
    Request,
    priority=st.floats(0, 1),
    gtin=st.sampled_from(GTINS),
    arrived=st.integers(0, 10).map(float),
)


@given(
    st.lists(requests, max_size=6),
    st.lists(st.tuples(st.sampled_from(GTINS), st.booleans()), max_size=12),
)
def test_a_box_serves_one_request_and_a_request_is_served_once(
    wanted: list[Request], leaving: list[tuple[Gtin, bool]]
) -> None:
    """Whatever leaves, known or identified afterwards."""
    wishes = Wishes(wanted)
    for step, (gtin, known) in enumerate(leaving):
        box, now = BoxId(f"b{step}"), float(step)
        open_before = wishes.open(now)
        wishes.left(box, gtin if known else None, now)
        if not known:
            wishes.identified(box, gtin, now)
        served = [wish for wish in wishes if wish.box == box]
        fitting = [r for r in open_before if r.gtin == gtin]
        assert len(served) == min(1, len(fitting))
        if served:
            assert served[0].request.priority == max(r.priority for r in fitting)
    for wish in wishes:
        arrived = wish.request.arrived
        end = len(leaving) if wish.served is None else int(wish.served)
        expected = sum(arrived <= step for step in range(end))
        assert wish.boxes_before == expected


def test_a_request_that_has_not_arrived_is_not_served() -> None:
    """Its product may leave before; the next case serves it."""
    wishes = Wishes([Request(priority=0.5, gtin=GTINS[0], arrived=5.0)])
    wishes.left(BoxId("early"), GTINS[0], 4.0)
    assert wishes.open(4.0) == ()
    wishes.left(BoxId("late"), GTINS[0], 6.0)
    (wish,) = wishes
    assert (wish.box, wish.served, wish.boxes_before) == ("late", 6.0, 0)


def test_a_box_request_is_served_by_that_box_alone() -> None:
    """Also when nobody knows its product."""
    wishes = Wishes([Request(priority=0.2, box=BoxId("b1"))])
    wishes.left(BoxId("b2"), GTINS[0], 1.0)
    wishes.left(BoxId("b1"), None, 2.0)
    (wish,) = wishes
    assert (wish.served, wish.boxes_before) == (2.0, 1)


def test_a_wish_that_is_told_again_under_its_key_is_one_wish() -> None:
    """Also one that was cancelled meanwhile; wishes without a key are all different ones."""
    wish = Request(priority=0.2, gtin=GTINS[0])
    wishes = Wishes([])
    for key in ("a", "b", "a"):
        wishes.add(wish, key)
    wishes.cancel("b")
    wishes.add(wish, "b")
    assert [(each.key, each.cancelled) for each in wishes] == [("a", False), ("b", True)]
    wishes.add(wish)
    wishes.add(wish)
    assert len(wishes) == 4
