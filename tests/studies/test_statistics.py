"""Means and their intervals."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from depal.studies.statistics import Sample


@given(st.lists(st.floats(-100, 100), min_size=2, max_size=50))
def test_mean_and_deviation_are_the_populations(values: list[float]) -> None:
    """Not the sample's."""
    sample = Sample.of(values)
    assert sample.mean == pytest.approx(float(np.mean(values)))
    assert sample.std == pytest.approx(float(np.std(values)))
    low, high = sample.ci95
    assert low <= sample.mean <= high


def test_the_interval_holds_the_true_mean_in_95_of_100_cases() -> None:
    """Measured, with a fixed seed."""
    rng = np.random.default_rng(5)
    intervals = [Sample.of(rng.normal(3.0, 2.0, 100)).ci95 for _ in range(2000)]
    share = np.mean([low <= 3.0 <= high for low, high in intervals])
    assert 0.93 <= share <= 0.97


def test_nothing_has_no_mean() -> None:
    """And no error either; one value alone has a mean and no error."""
    assert math.isnan(Sample.of([]).mean)
    assert math.isnan(Sample.of([]).error)
    assert Sample.of([3.0]).mean == 3.0
    assert math.isnan(Sample.of([3.0]).error)
