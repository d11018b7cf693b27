"""The domain's values refuse what could never be, and speak the cell's frames."""

import math
import pickle  # what a process pool does

import pytest
from hypothesis import given
from hypothesis import strategies as st

from depal.domain import (
    EURO_PALLET,
    BoxId,
    Delivery,
    DeliveryLine,
    Gtin,
    Place,
    PlaceId,
    Product,
    Request,
    StackedCase,
    cell_from_pallet,
    checked_share,
)
from depal.errors import DepalError, InputError, RequestError, SettingError, did_you_mean
from depal.geometry import Pose

BEANS = Product(Gtin("12000823098180"), "beans", (0.4, 0.3, 0.2), 5.0)
RICE = Product(Gtin("12000807013116"), "rice", (0.3, 0.2, 0.1), 2.0)


@given(st.floats(0, 1))
def test_a_share_in_range_is_returned(value: float) -> None:
    """Zero and one included."""
    assert checked_share("w", value) == value


@pytest.mark.parametrize(
    ("value", "message"),
    [
        (1.5, "w: 1.5 is out of range; expected a number in [0, 1]"),
        (-0.1, "w: -0.1 is out of range; expected a number in [0, 1]"),
        (math.inf, "w: inf is out of range; expected a number in [0, 1]"),
        (math.nan, "w: nan is not a number; expected a number in [0, 1]"),
        (True, "w: True is not a number; expected a number in [0, 1]"),
        ("0.5", "w: '0.5' is not a number; expected a number in [0, 1]"),
    ],
)
def test_a_share_out_of_range_is_refused(value: float, message: str) -> None:
    """With what was expected."""
    with pytest.raises(SettingError) as caught:
        checked_share("w", value)
    assert str(caught.value) == message


@pytest.mark.parametrize(
    ("fields", "message"),
    [
        (
            {"priority": 2.0, "gtin": BEANS.gtin},
            (
                "priority of the request for product 12000823098180: 2.0 is out of range; "
                "expected a number in [0, 1]"
            ),
        ),
        (
            {"priority": math.nan, "box": BoxId("b1")},
            "priority of the request for box b1: nan is not a number; expected a number in [0, 1]",
        ),
        ({"priority": 0.5}, "request: neither given; expected either gtin or box"),
        (
            {"priority": 0.5, "gtin": BEANS.gtin, "box": BoxId("b1")},
            "request: both given; expected either gtin or box",
        ),
        (
            {"priority": 0.5, "box": BoxId("b1"), "arrived": -1.0},
            "arrived: -1.0 s is no time; expected 0 s or later",
        ),
        (
            {"priority": 0.5, "box": BoxId("b1"), "arrived": math.inf},
            "arrived: inf s is no time; expected 0 s or later",
        ),
        (
            {"priority": 0.5, "box": BoxId("b1"), "arrived": 9.0, "due": 3.0},
            "due: 3.0 s is before it arrived; expected >= 9.0 s",
        ),
    ],
)
def test_a_request_that_could_never_be_served_is_refused(
    fields: dict[str, object], message: str
) -> None:
    """One clear error each."""
    with pytest.raises((SettingError, RequestError)) as caught:
        Request(**fields)  # type: ignore[arg-type]
    assert str(caught.value) == message


def test_a_request_with_a_due_time_is_kept() -> None:
    """The ordinary case."""
    request = Request(priority=0.3, gtin=BEANS.gtin, arrived=95.0, due=400.0)
    assert request.wanted == "product 12000823098180"
    assert request.due == 400.0


def test_a_delivery_counts_its_boxes_and_its_mass() -> None:
    """B_pall has one element a case."""
    delivery = Delivery("d", EURO_PALLET, (DeliveryLine(BEANS, 2), DeliveryLine(RICE, 1)))
    assert [box.id for box in delivery.boxes] == [
        "12000823098180/1",
        "12000823098180/2",
        "12000807013116/1",
    ]
    assert delivery.products == {BEANS.gtin: BEANS, RICE.gtin: RICE}
    assert delivery.mass == pytest.approx(12.0)


def test_a_pallets_long_side_is_the_front() -> None:
    """x_cell = x_near + y_pallet, y_cell = length / 2 - x_pallet, z_cell = z + deck height."""
    cell = cell_from_pallet(EURO_PALLET, 1.4)
    assert cell.apply((0.0, 0.0, 0.0)) == pytest.approx((1.4, 0.6, 0.144))
    assert cell.apply((1.2, 0.8, 1.0)) == pytest.approx((2.2, -0.6, 1.144))
    assert cell.apply((0.3, 0.1, 0.5)) == pytest.approx((1.5, 0.3, 0.644))


def test_a_stacked_case_is_a_box_in_the_pallets_frame() -> None:
    """From its corner and its size."""
    case = StackedCase(BEANS.gtin, (0.1, 0.2, 0.3), (0.4, 0.2, 0.6))
    assert case.in_pallet.centre == pytest.approx((0.3, 0.3, 0.6))


def test_a_place_knows_its_volume() -> None:
    """Opening times depth."""
    assert Place(PlaceId("t/1"), Pose(), (0.6, 0.4), 0.5).volume == pytest.approx(0.12)


@pytest.mark.parametrize(
    ("name", "known", "answer"),
    [
        ("troley_3", ["trolley_3", "shelf"], "did you mean 'trolley_3'?"),
        ("x", [], "there is none"),
        ("x", ["b", "a"], "there is: a, b"),
        (
            "x",
            [f"name{i}" for i in range(10)],
            "there is: name0, name1, name2, name3, name4, name5, name6, name7 and 2 more",
        ),
    ],
)
def test_an_unknown_name_is_answered_with_what_exists(
    name: str, known: list[str], answer: str
) -> None:
    """A close one alone, else a list."""
    assert did_you_mean(name, known) == answer


def test_an_error_lists_all_its_problems() -> None:
    """One line for one, a list for several."""
    error = SettingError("w", "1.5 is out of range", "a number in [0, 1]", "default: 0.5")
    assert isinstance(error, DepalError)
    assert str(InputError("file", error.problems)) == (
        "file: w: 1.5 is out of range; expected a number in [0, 1]; default: 0.5"
    )
    assert str(InputError("file", error.problems * 2)).startswith("file: 2 problems\n  w: 1.5")
    assert str(InputError("", error.problems * 2)).startswith("2 problems\n  w: 1.5")
    many = str(InputError("file", error.problems * 60)).splitlines()
    assert (many[0], many[-1], len(many)) == ("file: 60 problems", "  and 10 more", 52)


def test_an_input_error_survives_the_way_from_a_worker() -> None:
    """With its message and its problems."""
    error = SettingError("w", "1.5 is out of range")
    back = pickle.loads(pickle.dumps(error))  # noqa: S301
    assert isinstance(back, InputError)
    assert str(back) == str(error)
    assert back.problems == error.problems
