"""The cell's books: a box stands in one place at the most."""

from collections.abc import Callable

import pytest
from hypothesis import strategies as st
from hypothesis.stateful import RuleBasedStateMachine, invariant, rule

from depal.domain import BoxId, Place, PlaceId
from depal.errors import SettingError
from depal.geometry import Pose
from depal.logistics.placing import Books, PlaceMap, Standing

NAMES = [PlaceId(f"trolley_{bay}/level_{level}") for bay in (1, 11) for level in (1, 2)]
PLACES = [Place(name, Pose(), (0.5, 0.5), 0.4) for name in NAMES]

boxes = st.integers(1, 6).map(lambda number: BoxId(f"b{number}"))


def standing(box: BoxId) -> Standing:
    """A box in the middle of the opening."""
    return Standing(box, (0.0, -0.1, 0.0), (0.2, 0.2, 0.1))


class BooksAgree(RuleBasedStateMachine):
    """Puts, takes and exchanges, held against a plain dictionary."""

    def __init__(self) -> None:
        """Empty books."""
        super().__init__()
        self.books = Books.empty(PLACES)
        self.model: dict[BoxId, PlaceId] = {}

    @rule(box=boxes, place=st.sampled_from(NAMES))
    def put(self, box: BoxId, place: PlaceId) -> None:
        """A box goes into a place; the second time it is refused."""
        if box in self.model:
            with pytest.raises(SettingError, match="already"):
                self.books.put(place, standing(box))
        else:
            self.books = self.books.put(place, standing(box))
            self.model[box] = place

    @rule(box=boxes)
    def take(self, box: BoxId) -> None:
        """A box leaves; what is nowhere cannot."""
        if box in self.model:
            self.books = self.books.take(box)
            del self.model[box]
        else:
            with pytest.raises(SettingError, match="stands in no place"):
                self.books.take(box)

    @rule(bay=st.sampled_from(["trolley_1", "trolley_11"]))
    def exchange(self, bay: str) -> None:
        """An empty trolley comes; what went is what stood in its places."""
        mine = {box for box, place in self.model.items() if place.startswith(f"{bay}/")}
        self.books, gone = self.books.exchanged(bay)
        assert {box.id for place_map in gone for box in place_map.boxes} == mine
        self.model = {box: place for box, place in self.model.items() if box not in mine}

    @invariant()
    def every_box_is_where_the_model_says(self) -> None:
        """And nowhere else, and the volumes agree."""
        found = [
            (box.id, place_map.place.id) for place_map in self.books.maps for box in place_map.boxes
        ]
        assert dict(found) == self.model
        assert len(found) == len(self.model)
        assert all(self.books.where(box) == place for box, place in found)
        filled = sum(place_map.fill * place_map.place.volume for place_map in self.books.maps)
        assert filled == pytest.approx(0.004 * len(found))


TestBooksAgree = BooksAgree.TestCase


def _twice() -> object:
    place_map = PlaceMap(PLACES[0], (standing(BoxId("b1")),))
    return Books((place_map, PlaceMap(PLACES[1], place_map.boxes)))


@pytest.mark.parametrize(
    ("act", "told"),
    [
        (
            lambda: Books.empty(PLACES).at(PlaceId("troley_1/level_1")),
            "place troley_1/level_1: is not in the books; did you mean 'trolley_1/level_1'?",
        ),
        (
            lambda: Books.empty(PLACES).exchanged("trolley_2"),
            "trolley trolley_2: has no places; did you mean 'trolley_1'?",
        ),
        (lambda: Books.empty([*PLACES, PLACES[0]]), "place trolley_1/level_1: is in the books"),
        (_twice, "box b1: is in the books twice; expected once"),
        (
            lambda: PlaceMap(PLACES[0], (standing(BoxId("b1")),)).with_box(standing(BoxId("b1"))),
            "box b1: stands in trolley_1/level_1 already; expected a box that stands nowhere",
        ),
        (
            lambda: PlaceMap(PLACES[0]).without_box(BoxId("b1")),
            "box b1: does not stand in trolley_1/level_1; there is none",
        ),
    ],
)
def test_what_cannot_be_is_refused_with_a_reason(act: Callable[[], object], told: str) -> None:
    """Each error says what exists."""
    with pytest.raises(SettingError) as caught:
        act()
    assert str(caught.value).startswith(told)
