"""The inverse of the normal equations is the inverse, whatever is zero."""

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from depal.perception.settling.kernels import inverse


@given(st.integers(1, 30), st.integers(0, 1_000_000), st.floats(0.0, 1.0))
@settings(max_examples=40, deadline=None)
def test_a_matrix_times_its_inverse_is_one(size: int, seed: int, zeros: float) -> None:
    """Of symmetric positive matrices, full and nearly empty ones."""
    random = np.random.default_rng(seed)
    rows = random.normal(0.0, 1.0, (size, size)) * (random.random((size, size)) >= zeros)
    matrix = rows.T @ rows + np.diag(random.uniform(0.5, 2.0, size))
    out = np.full((size, size), np.nan)
    inverse(matrix.copy(), out)
    assert np.abs(out @ matrix - np.eye(size)).max() < 1e-8
    assert np.abs(out - out.T).max() < 1e-8
