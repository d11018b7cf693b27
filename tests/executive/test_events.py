"""Events and the text that the journal keeps of them."""

from typing import get_args

import pytest
from hypothesis import given
from hypothesis import strategies as st

from depal.errors import JournalError
from depal.executive import events as ev
from depal.executive.events import Event, Outcome, decode, decoded, encode
from depal.executive.journal import Record

numbers = st.one_of(st.integers(-(2**70), 2**70), st.floats(allow_nan=False, allow_infinity=False))
texts = st.text(st.characters(), max_size=8)  # halves of surrogate pairs too
values = st.one_of(st.none(), st.booleans(), numbers, texts)
changes = st.lists(st.tuples(texts, values), max_size=3).map(tuple)
moments = st.floats(0, 1e12)
counts = st.integers(0, 2**40)
parts: dict[type[Event], tuple[st.SearchStrategy[object], ...]] = {
    ev.Allocated: (
        counts,
        texts,
        st.lists(texts, max_size=3).map(tuple),
        st.floats(-1e9, 1e9),
        texts,
    ),
    ev.Changed: (changes, texts),
    ev.Started: (counts, counts, counts),
    ev.Ended: (counts, st.sampled_from(Outcome), changes, texts),
    ev.CancelAsked: (counts, texts),
    ev.Prioritised: (counts, st.floats(-1e9, 1e9)),
    ev.Withdrawn: (counts, texts),
    ev.Archived: (counts, st.booleans()),
    ev.Retried: (counts, counts),
    ev.Ticked: (),
    ev.ModeChanged: (st.booleans(), texts),
    ev.Restarted: (),
}
happened = st.one_of([st.builds(kind, moments, *rest) for kind, rest in parts.items()])


def records(events: list[Event]) -> list[Record]:
    """What a journal keeps of events."""
    return [
        Record(number, event.at, type(event).__name__, encode(event))
        for number, event in enumerate(events, 1)
    ]


@given(st.lists(happened, max_size=6))
def test_together_and_one_by_one_the_events_are_read_as_they_were(events: list[Event]) -> None:
    """Types included: a whole number stays one."""
    written = records(events)
    together = list(decoded(written))
    assert together == [decode(r.at, r.kind, r.body) for r in written] == events
    assert [encode(event) for event in together] == [record.body for record in written]
    assert repr(together) == repr(events)


def test_every_kind_of_event_is_drawn_above() -> None:
    """So that a new one is not forgotten."""
    assert set(parts) == set(get_args(Event))


@pytest.mark.parametrize(
    ("kind", "body"),
    [
        ("Started", '{"attempt":1,"tree":1}'),
        ("Started", '{"attempt":1,"node":1,"speed":2,"tree":1}'),
        ("Flown", "{}"),
        ("Ticked", "[]"),
        ("Ticked", ""),
        ("Ended", '{"attempt":1,"facts":[],"outcome":"lost","reason":""}'),
        ("Changed", '{"facts":[["b1.taken"]],"source":"x"}'),
    ],
)
def test_what_is_no_event_is_named(kind: str, body: str) -> None:
    """All before it are read, alone and in a crowd."""
    good = records([ev.Ticked(1.0)] * 3)
    reading = decoded([*good, Record(4, 2.0, kind, body), *good])
    assert [next(reading) for _ in good] == [ev.Ticked(1.0)] * 3
    with pytest.raises(JournalError) as caught:
        next(reading)
    assert str(caught.value) == f"the journal holds no event of this version: {kind} {body}"


def test_a_long_journal_is_read_to_its_end() -> None:
    """Page by page."""
    events: list[Event] = [ev.Started(1.5, number, 1, 2) for number in range(2 * ev.TOGETHER + 7)]
    assert list(decoded(records(events))) == events
