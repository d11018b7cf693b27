"""What holds for the pallets of every generator."""

import hashlib

import numpy as np
import numpy.typing as npt
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.stats import chisquare

from depal.studies.pallets import (
    COUNTS,
    GENERATORS,
    SIZE,
    SMALLEST,
    X_MAX,
    X_NEAR,
    RandomPallet,
)

NAMES = sorted(GENERATORS)
GAP_FREE = sorted(set(GENERATORS) - {"dropped"})

seeds = st.integers(min_value=0, max_value=2**32 - 1)


def pallet_of(name: str, seed: int) -> RandomPallet:
    """One pallet of a generator."""
    return GENERATORS[name](np.random.default_rng(seed))


def overlaps(pallet: RandomPallet) -> npt.NDArray[np.bool_]:
    """Which boxes share room, (n, n), none with itself."""
    low, high = pallet.low, pallet.high
    common = np.minimum(high[:, None], high) - np.maximum(low[:, None], low)
    shared = np.asarray((common > 0).all(axis=2))
    np.fill_diagonal(shared, val=False)
    return shared


@pytest.mark.parametrize("name", NAMES)
@settings(max_examples=25, deadline=None)
@given(seed=seeds)
def test_boxes_do_not_overlap(name: str, seed: int) -> None:
    """No two boxes share any room, not even by rounding."""
    assert not overlaps(pallet_of(name, seed)).any()


@pytest.mark.parametrize("name", GAP_FREE)
@settings(max_examples=25, deadline=None)
@given(seed=seeds)
def test_gap_free_pallets_fill_the_volume(name: str, seed: int) -> None:
    """As boxes do not overlap and stay inside, their volumes prove that nothing is left."""
    volume = pallet_of(name, seed).sizes.prod(axis=1).sum()
    assert volume == pytest.approx(1.28, abs=1e-10)


@pytest.mark.parametrize("name", GAP_FREE)
@settings(max_examples=10, deadline=None)
@given(seed=seeds)
def test_gap_free_pallets_reach_every_side_of_the_volume(name: str, seed: int) -> None:
    """The corners of the volume are those of the outermost boxes."""
    pallet = pallet_of(name, seed)
    assert pallet.low.min(axis=0) == pytest.approx([X_NEAR, -SIZE[1] / 2, 0], abs=1e-11)
    assert pallet.high.max(axis=0) == pytest.approx([X_MAX, SIZE[1] / 2, SIZE[2]], abs=1e-11)


@pytest.mark.parametrize("name", NAMES)
@settings(max_examples=25, deadline=None)
@given(seed=seeds)
def test_boxes_stay_inside_the_volume(name: str, seed: int) -> None:
    """No corner lies outside, not even by rounding."""
    pallet = pallet_of(name, seed)
    assert (pallet.low >= [1.4, -0.8, 0.0]).all()
    assert (pallet.high <= [2.2, 0.8, 1.0]).all()
    assert pallet.x_max == 2.2


@pytest.mark.parametrize("name", NAMES)
@settings(max_examples=25, deadline=None)
@given(seed=seeds)
def test_no_side_is_below_five_centimetres(name: str, seed: int) -> None:
    """Exactly: a side of 5 cm less a rounding error would fail."""
    assert pallet_of(name, seed).sizes.min() >= SMALLEST


@pytest.mark.parametrize("name", [*GAP_FREE, pytest.param("dropped", marks=pytest.mark.slow)])
def test_the_number_of_boxes_is_uniform(name: str) -> None:
    """Chi-square over 2,000 pallets, at a level of one in a thousand."""
    rng = np.random.default_rng(7)
    numbers = [len(GENERATORS[name](rng)) for _ in range(2000)]
    seen = np.bincount(numbers, minlength=COUNTS.stop)
    assert seen[: COUNTS.start].sum() == 0
    assert len(seen) == COUNTS.stop
    assert chisquare(seen[COUNTS.start :]).pvalue > 1e-3


@pytest.mark.parametrize("name", NAMES)
@settings(max_examples=10, deadline=None)
@given(seed=seeds)
def test_one_state_gives_one_pallet(name: str, seed: int) -> None:
    """Bit by bit, and the generators are left in one state as well."""
    first, second = np.random.default_rng(seed), np.random.default_rng(seed)
    for _ in range(2):
        one, other = GENERATORS[name](first), GENERATORS[name](second)
        assert np.array_equal(one.low, other.low)
        assert np.array_equal(one.high, other.high)
    assert first.random() == second.random()


@pytest.mark.parametrize(
    ("name", "digest"),
    [
        ("guillotine", "d3e391de613e7d3a"),
        ("layered", "d38b7950d10a909f"),
        ("cubic", "61cf3c1651885d32"),
        ("columns", "9e14475cd232d19d"),
        ("dropped", "58ac34d03a8c5c4a"),
    ],
)
def test_every_machine_gets_the_same_pallets(name: str, digest: str) -> None:
    """The corners of ten pallets, bit by bit, as they were when the generator was written."""
    rng = np.random.default_rng(2024)
    total = hashlib.sha256()
    for _ in range(10):
        pallet = GENERATORS[name](rng)
        total.update(pallet.low.astype("<f8").tobytes() + pallet.high.astype("<f8").tobytes())
    assert total.hexdigest()[:16] == digest


@pytest.mark.parametrize("name", NAMES)
def test_corners_cannot_be_changed(name: str) -> None:
    """A pallet is a value."""
    pallet = pallet_of(name, 0)
    for corners in (pallet.low, pallet.high):
        assert corners.dtype == np.float64
        assert corners.flags.c_contiguous
        with pytest.raises(ValueError, match="read-only"):
            corners[0, 0] = 0.0


@pytest.mark.parametrize("name", NAMES)
@settings(max_examples=10, deadline=None)
@given(seed=seeds)
def test_prisms_are_the_boxes_exactly(name: str, seed: int) -> None:
    """Centre plus and minus half an edge gives the corners back without rounding."""
    pallet = pallet_of(name, seed)
    prisms = pallet.prisms
    assert prisms.shape == (len(pallet), 8)
    assert np.array_equal(prisms[:, :3], pallet.centres)
    assert np.array_equal(2 * prisms[:, 3:6], pallet.sizes)
    assert np.array_equal(prisms[:, :3] - prisms[:, 3:6], pallet.low)
    assert np.array_equal(prisms[:, :3] + prisms[:, 3:6], pallet.high)
    assert (prisms[:, 6:] == [1.0, 0.0]).all()


@pytest.mark.parametrize("name", NAMES)
@settings(max_examples=10, deadline=None)
@given(seed=seeds)
def test_prisms_that_touch_do_not_overlap(name: str, seed: int) -> None:
    """Where two faces share a coordinate, the centres are just two half edges apart."""
    pallet = pallet_of(name, seed)
    centres, halves = pallet.prisms[:, :3], pallet.prisms[:, 3:6]
    touching = pallet.high[:, None] == pallet.low
    apart = centres - centres[:, None]
    reach = halves + halves[:, None]
    assert (apart[touching] == reach[touching]).all()
    assert touching.any()
