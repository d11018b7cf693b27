"""What looks like a box that turned out to be another is another too, where the note agrees."""

from cells_at_work import DECK, name
from hypothesis import given
from hypothesis import strategies as st

from depal.cell.mistaken import sizes_of_the_mistaken
from depal.domain import (
    EURO_PALLET,
    Delivery,
    DeliveryLine,
    Detection,
    Gtin,
    Perceived,
    Product,
    Recognition,
)
from depal.geometry import OrientedBox, Vector3

SMALL = Product(Gtin("small"), "small", (0.312, 0.267, 0.191), 4.0)
LARGE = Product(Gtin("large"), "large", (0.347, 0.243, 0.231), 5.0)


def note(small: int, large: int) -> Delivery:
    """So many cases of each."""
    return Delivery("d", EURO_PALLET, (DeliveryLine(SMALL, small), DeliveryLine(LARGE, large)))


def shape(number: int, size: Vector3) -> OrientedBox:
    """A box on the pallet."""
    return OrientedBox.upright((1.5, 0.3 * number, DECK + size[2] / 2), size)


def seen(count: int, size: Vector3 = SMALL.size) -> list[Detection]:
    """Boxes that nobody has named."""
    return [Detection(name(n), shape(n, size)) for n in range(1, count + 1)]


counts = st.integers(0, 6)


@given(small=counts, large=st.integers(1, 6), count=st.integers(1, 6), turned=st.booleans())
def test_more_of_a_look_than_the_note_promises_are_of_the_other_product(
    *, small: int, large: int, count: int, turned: bool
) -> None:
    """Each along its own axes; where the note promises enough of them they stay what they are."""
    a, b, c = SMALL.size
    boxes = seen(count, (b, a, c) if turned else (a, b, c))
    sizes = sizes_of_the_mistaken(SMALL.size, LARGE, boxes, note(small, large), [])
    if count <= small:
        assert sizes == {}
        return
    x, y, z = LARGE.size
    assert sizes == dict.fromkeys([box.id for box in boxes], (y, x, z) if turned else (x, y, z))


@given(counts, counts, counts)
def test_none_is_of_a_product_of_which_all_have_left_or_are_named(
    large: int, left: int, named: int
) -> None:
    """Those with names are not touched, and count as seen; so are others of another size."""
    boxes: list[Perceived] = [
        *seen(3),
        Detection(name(9), shape(9, (0.2, 0.2, 0.2))),
        *(Recognition(name(20 + n), shape(20 + n, LARGE.size), LARGE.gtin) for n in range(named)),
    ]
    gone = [*[LARGE.gtin] * left, None]
    sizes = sizes_of_the_mistaken(SMALL.size, LARGE, boxes, note(0, large), gone)
    assert set(sizes) == ({name(1), name(2), name(3)} if left + named < large else set())
