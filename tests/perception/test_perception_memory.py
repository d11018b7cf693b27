"""Identity from look to look: names are kept, errors average out, doubts grow, nothing returns."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from seen_boxes import blurred, seen

from depal.domain import BoxId, DeliveryLine, Gtin, Product
from depal.geometry import OrientedBox
from depal.perception.faces import Look, SeenBox
from depal.perception.memory import Memory, tally_of
from depal.perception.memory.memory import FRESH, PATIENCE
from depal.perception.memory.parting import clashes

PILE = (
    seen((1.6, 0.4, 0.3), gtin="a"),
    seen((1.6, 0.1, 0.3)),
    seen((1.6, -0.2, 0.3), gtin="a"),
    seen((1.6, 0.1, 0.6), gtin="b"),
)
"""Four boxes of one size: three in a row, one on the middle one."""

seeds = st.integers(0, 2**32 - 1)


def looked(memory: Memory, boxes: tuple[SeenBox, ...], at: float = 0.0) -> Memory:
    """One look."""
    return memory.update(Look(boxes), at)


def names(memory: Memory) -> dict[str, tuple[float, ...]]:
    """Where each box is believed to be."""
    return {str(box.name): box.centre for box in memory}


def test_first_names_go_row_by_row_from_below_and_left_to_right() -> None:
    """As the robot sees them; whatever the order in which they were found."""
    memory = looked(Memory(), PILE[::-1])
    assert [str(box.name) for box in memory] == ["b1", "b2", "b3", "b4"]
    assert [box.centre for box in memory] == [box.shape.centre for box in PILE]


def test_names_that_were_given_to_places_in_advance_hold() -> None:
    """The others take numbers that are free; a box that comes later finds its own."""
    places = ((BoxId("b1"), (1.6, 0.1, 0.3)), (BoxId("wanted"), (1.6, 0.1, 0.6)))
    memory = looked(Memory(places=places), PILE[:3])
    assert names(memory)["b1"] == PILE[1].shape.centre
    assert set(names(memory)) == {"b1", "b2", "b3"}
    assert names(looked(memory, PILE))["wanted"] == PILE[3].shape.centre


@given(seeds, st.permutations(range(len(PILE))), st.integers(1, 5))
def test_boxes_keep_their_names_whatever_the_order_and_the_noise(
    seed: int, order: list[int], looks: int
) -> None:
    """Flush neighbours of one size included."""
    random = np.random.default_rng(seed)
    memory = looked(Memory(), PILE)
    for number in range(looks):
        noisy = [blurred(box, random) for box in PILE]
        memory = looked(memory, tuple(noisy[k] for k in order), float(number))
    assert memory.moved <= {box.name for box in memory}
    for name, centre in names(looked(Memory(), PILE)).items():
        assert names(memory)[name] == pytest.approx(centre, abs=0.02)


@given(seeds)
def test_looks_at_a_box_that_stands_average_out(seed: int) -> None:
    """The error of nine looks is about a third of one's, and the covariance says so."""
    random = np.random.default_rng(seed)
    box = seen((1.6, 0.0, 0.5))
    memory = Memory()
    for number in range(9):
        memory = looked(memory, (blurred(box, random, 0.7),), float(number))
    (found,) = memory
    off = np.abs(np.array(found.centre) - box.shape.centre)
    assert off.max() < 0.006
    assert np.sqrt(found.seen.covariance[0, 0]) == pytest.approx(0.003 / 3, rel=0.3)
    assert found.looks == 9


@given(st.floats(0.03, 0.18), seeds)
def test_a_box_that_was_pushed_keeps_its_name_and_is_noticed(push: float, seed: int) -> None:
    """One look may be wrong: it is believed to be there when a second one agrees."""
    random = np.random.default_rng(seed)
    memory = looked(Memory(), PILE[:2])
    x, y, z = PILE[0].shape.centre
    there = seen((x - push, y, z), gtin="a")
    memory = looked(memory, (blurred(there, random, 0.3), PILE[1]), 1.0)
    assert set(names(memory)) == {"b1", "b2"}
    assert memory.moved == memory.hidden == {"b1"}
    assert names(memory)["b1"] == PILE[0].shape.centre
    assert looked(memory, PILE[:2], 2.0).hidden == set()  # it was wrong
    memory = looked(memory, (blurred(there, random, 0.3), PILE[1]), 2.0)
    assert (set(names(memory)), memory.hidden) == ({"b1", "b2"}, set())
    assert names(memory)["b1"] == pytest.approx(there.shape.centre, abs=0.006)


@given(st.lists(st.booleans(), min_size=1, max_size=30))
def test_a_box_is_believed_until_too_many_looks_in_a_row_miss_it(shown: list[bool]) -> None:
    """Meanwhile it counts as hidden; then it is gone, and what comes there has a new name."""
    memory, missed, number = looked(Memory(), PILE[:2]), 0, 2
    for at, there in enumerate(shown, start=1):
        memory = looked(memory, PILE[: 2 if there else 1], float(at))
        number += there and missed >= PATIENCE
        missed = 0 if there else missed + 1
        name = BoxId(f"b{number}")
        assert {box.name for box in memory} == ({"b1", name} if missed < PATIENCE else {"b1"})
        assert memory.hidden == ({name} if 0 < missed < PATIENCE else set())


def test_a_taken_box_never_returns_under_its_name() -> None:
    """Not by an old picture, and not by what stands in its place afterwards."""
    memory = looked(Memory(), PILE).without(BoxId("b2"), 10.0)
    assert "b2" not in names(memory)
    assert set(names(looked(memory, PILE, 10.0 + FRESH / 2))) == {"b1", "b3", "b4"}
    assert set(names(looked(memory, PILE, 20.0))) == {"b1", "b3", "b4", "b5"}
    assert memory.without(BoxId("nobody"), 1.0) is memory


def test_two_boxes_that_a_look_runs_together_stay_two_for_a_while() -> None:
    """They have been seen often; what covers both has not."""
    memory = Memory()
    for number in range(4):
        memory = looked(memory, PILE, float(number))
    together = seen((1.6, 0.25, 0.3), (0.3, 0.6, 0.3), score=0.7)
    after = looked(memory, (together, *PILE[2:]), 5.0)
    assert set(names(after)) == {"b1", "b2", "b3", "b4"}
    assert after.hidden == {"b1", "b2"}
    for number in range(6, 12):
        after = looked(after, (together, *PILE[2:]), float(number))
    assert len(after) == 3  # it was right after all


@given(st.lists(st.tuples(st.floats(1.5, 2.0), st.floats(-0.4, 0.4)), min_size=1, max_size=12))
def test_believed_boxes_share_no_space(centres: list[tuple[float, float]]) -> None:
    """Whatever looks tell."""
    memory = Memory()
    for number, (x, y) in enumerate(centres):
        memory = looked(memory, (seen((x, y, 0.3)),), float(number))
    assert not clashes([box.seen.shape for box in memory]).any()


def test_a_product_stays_known_and_two_products_are_none() -> None:
    """Where looks contradict each other the reader is to say."""
    box = PILE[0]
    memory = looked(looked(Memory(), (box,)), (replace(box, gtin=None),))
    assert [each.seen.gtin for each in memory] == ["a"]
    memory = looked(memory, (replace(box, gtin=Gtin("b")),))
    assert [each.seen.gtin for each in memory] == [None]


def test_the_size_that_was_measured_stays_where_a_look_must_guess_it() -> None:
    """The face that was seen stays in place."""
    box = seen((1.6, 0.0, 0.3), (0.4, 0.3, 0.3))
    guess = seen((1.55, 0.0, 0.3), (0.3, 0.3, 0.3), sized=False)
    memory = looked(looked(Memory(), (box,)), (guess,))
    (found,) = memory
    assert found.seen.sized
    assert found.seen.shape.size == pytest.approx((0.4, 0.3, 0.3))
    assert found.centre == pytest.approx((1.6, 0.0, 0.3))
    memory = looked(looked(Memory(), (guess,)), (box,))
    assert [each.seen.shape.size for each in memory] == [(0.4, 0.3, 0.3)]


# The note

NOTE = tuple(
    DeliveryLine(Product(Gtin(name), name, (0.3, 0.2, 0.2), 4.0), count)
    for name, count in (("a", 2), ("b", 1))
)


@given(st.lists(st.sampled_from(["a", "b", "c", None]), max_size=8))
def test_every_case_of_the_note_is_seen_unseen_or_one_of_the_unnamed(
    found: list[str | None],
) -> None:
    """And what is too much is said, by product."""
    gtins = [None if name is None else Gtin(name) for name in found]
    tally = tally_of(NOTE, gtins)
    for line in NOTE:
        name, count = line.product.gtin, found.count(line.product.gtin)
        assert tally.unseen.get(name, 0) == max(0, line.count - count)
        assert any(s.gtin == name for s in tally.surplus) is (count > line.count)
    assert any(s.promised == 0 for s in tally.surplus) is ("c" in found)
    assert tally.unnamed == found.count(None)
    assert tally.missing == max(0, sum(tally.unseen.values()) - tally.unnamed)


def test_a_surplus_is_a_sentence() -> None:
    """As reasons are."""
    tally = tally_of(NOTE, [Gtin("a")] * 3 + [Gtin("c")])
    assert list(map(str, tally.surplus)) == [
        "the note promises 2 of product a, this is one more",
        "product c is not on the note",
    ]


def test_a_name_outweighs_a_look_that_shows_another_size_without_one() -> None:
    """As many looks as have shown it must show otherwise, before it is believed."""
    wide = replace(PILE[0], gtin=None, shape=OrientedBox.upright((1.6, 0.4, 0.36), (0.3, 0.2, 0.4)))
    memory = looked(Memory(), PILE[:1])
    size = PILE[0].shape.size
    for at in range(1, 3):
        memory = looked(memory, PILE[:1], float(at))
    memory = looked(memory, (wide,), 3.0)
    box = next(iter(memory))
    assert box.seen.gtin == "a"
    assert box.seen.shape.size == pytest.approx(size)
