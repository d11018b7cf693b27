"""Laws of what a box's faces say together."""

from hypothesis import given
from hypothesis import strategies as st

from depal.domain import Gtin
from depal.perception.faces import Name
from depal.perception.recognition import believed
from depal.perception.recognition.trust import shipped_trust

ONE, OTHER, THIRD = (Gtin(f"{number:014d}") for number in (17, 24, 31))
LIMIT = shipped_trust().limit

names = st.builds(
    Name,
    st.sampled_from((ONE, OTHER)),
    st.sampled_from(("side", "top")),
    st.floats(0.5, 1.0),
    st.booleans(),
    st.just(0),
    st.floats(-12.0, 12.0),
    st.sets(st.sampled_from((OTHER, THIRD))).map(tuple),
)


def said(gtin: Gtin, odds: float, *rivals: Gtin, certain: bool = False) -> Name:
    """What a face says."""
    return Name(gtin, "side", 0.9, certain, 0, odds, rivals)


@given(names, names)
def test_it_does_not_matter_which_face_is_asked_first(one: Name, other: Name) -> None:
    """Neither comes before the other."""
    if one.odds != other.odds:
        assert believed([one, other]) == believed([other, one])


@given(names)
def test_a_face_alone_is_believed_when_it_is_certain(name: Name) -> None:
    """And never else, however high its odds are: it may have a rival."""
    assert believed([name]) == (name.gtin if name.certain else None)
    assert believed([]) is None


@given(st.floats(-12.0, 12.0), st.floats(-12.0, 12.0))
def test_faces_that_contradict_each_other_are_not_believed(first: float, second: float) -> None:
    """Each of them certain of another product."""
    pair = [said(ONE, first, certain=True), said(OTHER, second, certain=True)]
    assert believed(pair) is None


@given(st.floats(0.0, 12.0), st.floats(0.0, 12.0))
def test_two_faces_that_say_the_same_add_their_odds(first: float, second: float) -> None:
    """Neither is certain, both together are."""
    both = [said(ONE, first), said(ONE, second)]
    assert believed(both) == (ONE if first + second >= LIMIT else None)


@given(st.floats(0.0, 12.0), st.floats(0.0, 12.0))
def test_a_rival_must_be_excluded_by_one_face_at_least(first: float, second: float) -> None:
    """One that neither face excludes may be the box."""
    high = LIMIT + first
    assert believed([said(ONE, high, OTHER), said(ONE, second, OTHER, THIRD)]) is None
    assert believed([said(ONE, high, OTHER), said(ONE, second, THIRD)]) == ONE


def test_other_letters_on_one_face_take_the_name_from_the_other() -> None:
    """A sibling's top may look like the product's where its words are hidden."""
    sure = said(ONE, LIMIT + 1.0, certain=True)
    assert believed([sure, said(ONE, -6.0)]) is None
    assert believed([sure, said(ONE, -0.5)]) == ONE
