"""Requests in the store's data: accepted once, ended exactly once (I8)."""

from collections.abc import Iterator
from pathlib import Path

import pytest
from hypothesis import settings
from hypothesis import strategies as st
from hypothesis.stateful import RuleBasedStateMachine, invariant, rule

from depal.domain import BoxId, Delivery, Gtin, Request
from depal.errors import RequestError, SettingError
from depal.logistics import shipped_deliveries
from depal.logistics.store import Database, LocalStore, RequestState, random_requests

TEA, RICE = Gtin("12000823098180"), Gtin("12000807013116")
ENDS = [RequestState.SERVED, RequestState.REJECTED, RequestState.CANCELLED]


@pytest.fixture
def store() -> Iterator[LocalStore]:
    """An empty store in memory."""
    with LocalStore() as store:
        yield store


class EachEndsOnce(RuleBasedStateMachine):
    """Accepts and settles in any order, held against a dictionary."""

    def __init__(self) -> None:
        """An empty store."""
        super().__init__()
        self.store = LocalStore()
        self.ends: dict[str, tuple[RequestState, float | None]] = {}

    @rule(number=st.integers(1, 4))
    def accept(self, number: int) -> None:
        """The same requests again are no new ones."""
        wanted = [Request(0.25 * each, gtin=TEA) for each in range(number)]
        for key in self.store.accept(wanted, "file"):
            self.ends.setdefault(key, (RequestState.PENDING, None))

    @rule(number=st.integers(1, 4), state=st.sampled_from(ENDS), at=st.floats(0, 9))
    def settle(self, number: int, state: RequestState, at: float) -> None:
        """Only a pending one can end."""
        key = f"file#{number}"
        if key not in self.ends:
            with pytest.raises(SettingError, match="does not exist"):
                self.store.settle(key, state, at)
            return
        pending = self.ends[key][0] is RequestState.PENDING
        assert self.store.settle(key, state, at) == pending
        if pending:
            self.ends[key] = state, at

    @rule(at=st.floats(0, 9))
    def serve(self, at: float) -> None:
        """A case serves the most important one, which is the last one accepted."""
        waiting = [key for key, end in self.ends.items() if end[0] is RequestState.PENDING]
        key = self.store.serve(BoxId("b1"), TEA, at)
        assert key == max(waiting, default=None)
        if key is not None:
            self.ends[key] = RequestState.SERVED, at

    @invariant()
    def the_store_says_what_the_model_says(self) -> None:
        """Key by key."""
        found = {kept.key: (kept.state, kept.settled) for kept in self.store.requests()}
        assert found == self.ends

    def teardown(self) -> None:
        """Closes the store."""
        self.store.close()


TestEachEndsOnce = EachEndsOnce.TestCase
TestEachEndsOnce.settings = settings(stateful_step_count=20, max_examples=25)


def test_two_hands_cannot_both_end_a_request(tmp_path: Path) -> None:
    """Compare and set: the second finds that it has ended."""
    url = f"sqlite:///{tmp_path / 'store.db'}"
    with LocalStore(Database(url)) as one, LocalStore(Database(url)) as other:
        (key,) = one.accept([Request(0.5, gtin=TEA)], "file")
        assert other.settle(key, RequestState.CANCELLED, 3.0, "no longer wanted")
        assert not one.settle(key, RequestState.SERVED, 4.0)
        (kept,) = one.requests()
    assert (kept.state, kept.settled) == (RequestState.CANCELLED, 3.0)
    assert kept.reason == "no longer wanted"


def test_a_case_serves_the_most_important_request_that_has_come(store: LocalStore) -> None:
    """Requests for its own name count as those for its product do; later ones wait."""
    wanted = [
        Request(0.4, gtin=TEA),
        Request(0.6, box=BoxId("b7")),
        Request(0.9, gtin=RICE),
        Request(1.0, gtin=TEA, arrived=100.0),
    ]
    keys = store.accept(wanted, "file")
    assert [kept.key for kept in store.pending(50.0)] == list(keys[:3])
    assert store.serve(BoxId("b7"), None, 10.0) == keys[1]
    assert store.serve(BoxId("b8"), TEA, 10.0) == keys[0]
    assert store.serve(BoxId("b9"), TEA, 10.0) is None
    assert store.serve(BoxId("b9"), TEA, 100.0) == keys[3]
    assert [kept.key for kept in store.pending(200.0)] == [keys[2]]


def test_a_request_comes_back_as_it_was_given(store: LocalStore) -> None:
    """Every field."""
    wanted = Request(0.5, gtin=TEA, arrived=3.5, due=60.0)
    store.accept([wanted], "file")
    assert [kept.request for kept in store.requests()] == [wanted]


def test_another_request_under_a_used_key_is_refused_and_nothing_is_changed(
    store: LocalStore,
) -> None:
    """The transaction is taken back as a whole."""
    store.accept([Request(0.5, gtin=TEA)], "file")
    with pytest.raises(RequestError) as caught:
        store.accept([Request(0.5, gtin=TEA), Request(0.7, gtin=RICE)][::-1], "file")
    assert str(caught.value) == (
        "key: 'file#1' is the key of another request; expected a key of its own"
    )
    assert len(store.requests()) == 1


def test_an_end_must_be_one(store: LocalStore) -> None:
    """Pending is none, and a name that nobody gave is none either."""
    (key,) = store.accept([Request(0.5, gtin=TEA)], "file")
    with pytest.raises(SettingError, match="does not end pending"):
        store.settle(key, RequestState.PENDING, 1.0)
    with pytest.raises(SettingError, match="did you mean 'file#1'"):
        store.settle("file#2", RequestState.SERVED, 1.0)


@pytest.fixture(scope="module")
def delivery() -> Delivery:
    """A real one."""
    return shipped_deliveries()[0]


def test_random_requests_are_the_same_for_a_seed_and_can_all_be_served(delivery: Delivery) -> None:
    """In order of their times, each with a case."""
    drawn = random_requests(delivery, 3, seed=5)
    assert drawn == random_requests(delivery, 3, seed=5)
    assert drawn != random_requests(delivery, 3, seed=6)
    assert [each.arrived for each in drawn] == sorted(each.arrived for each in drawn)
    counts = {line.product.gtin: line.count for line in delivery.lines}
    everything = random_requests(delivery, 10_000, seed=1, horizon=5.0)
    assert len(everything) == len(delivery.boxes)
    for each in everything:
        assert each.gtin is not None
        assert each.arrived <= 5.0
        counts[each.gtin] -= 1
    assert set(counts.values()) == {0}
