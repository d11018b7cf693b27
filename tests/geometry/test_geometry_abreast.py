"""Parts computed side by side: what comes out is that of one part after the other."""

import threading

import pytest
from hypothesis import given
from hypothesis import strategies as st

from depal.geometry.abreast import abreast


@given(st.lists(st.integers(), max_size=8))
def test_the_results_are_those_of_the_parts_in_their_order(parts: list[int]) -> None:
    """Whichever is ready first."""
    assert abreast(lambda part: (part, part * part), parts) == [(n, n * n) for n in parts]


def test_two_parts_are_at_work_at_the_same_time() -> None:
    """Each waits for the other: one after the other they would wait for ever."""
    both = threading.Barrier(2, timeout=20.0)
    assert sorted(abreast(lambda _: both.wait(), ("one", "other"))) == [0, 1]


def test_one_part_alone_needs_no_thread() -> None:
    """It is computed where it was asked for."""
    (thread,) = abreast(lambda _: threading.current_thread(), ["alone"])
    assert thread is threading.current_thread()


@given(st.integers(0, 3))
def test_what_a_part_raises_is_raised(bad: int) -> None:
    """Nothing is swallowed in a thread."""
    with pytest.raises(ZeroDivisionError):
        abreast(lambda part: 1 // (part - bad), range(4))
