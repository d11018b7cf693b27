"""What makes each generator the one that it is; `dropped` has a file of its own."""

import numpy as np
import numpy.typing as npt
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from depal.errors import SettingError
from depal.studies.pallets import GENERATORS, RandomPallet, generator_named, guillotine_boxes

seeds = st.integers(min_value=0, max_value=2**32 - 1)
few = settings(max_examples=25, deadline=None)


def pallet_of(name: str, seed: int) -> RandomPallet:
    """One pallet of a generator."""
    return GENERATORS[name](np.random.default_rng(seed))


def grouped(pallet: RandomPallet, axes: list[int]) -> list[npt.NDArray[np.intp]]:
    """The boxes whose low corners agree in some coordinates, group by group."""
    _, group = np.unique(pallet.low[:, axes], axis=0, return_inverse=True)
    return [np.flatnonzero(group == number) for number in range(group.max() + 1)]


def test_there_are_five_generators() -> None:
    """Their names are part of the interface."""
    assert list(GENERATORS) == ["guillotine", "layered", "cubic", "columns", "dropped"]


@pytest.mark.parametrize("name", sorted(GENERATORS))
def test_a_generator_is_found_by_its_name(name: str) -> None:
    """The one in the table."""
    assert generator_named(name) is GENERATORS[name]


@pytest.mark.parametrize(
    ("name", "message"),
    [
        ("guilotine", "generator: unknown name 'guilotine'; did you mean 'guillotine'?"),
        (
            "pyramid",
            (
                "generator: unknown name 'pyramid'; "
                "there is: columns, cubic, dropped, guillotine, layered"
            ),
        ),
    ],
)
def test_an_unknown_name_is_answered_with_those_that_exist(name: str, message: str) -> None:
    """A slip of the finger gets the nearest name, anything else all of them."""
    with pytest.raises(SettingError) as error:
        generator_named(name)
    assert str(error.value) == message


@few
@given(seed=seeds)
def test_a_guillotine_cut_runs_near_the_middle(seed: int) -> None:
    """The first cut: at .45 to .55 of one axis, the others stay whole."""
    pallet = guillotine_boxes(np.random.default_rng(seed), 2, size=(1.0, 1.0, 1.0))
    shares = np.sort(pallet.sizes[0])
    assert 0.45 <= shares[0] <= 0.55
    assert shares[1:] == pytest.approx([1.0, 1.0])


def test_guillotine_cuts_take_all_axes_alike() -> None:
    """Of 3,000 first cuts about 1,000 fall on each axis: within four standard deviations."""
    rng = np.random.default_rng(11)
    axes = [
        int(np.argmin(guillotine_boxes(rng, 2, size=(1.0, 1.0, 1.0)).sizes[0])) for _ in range(3000)
    ]
    assert np.abs(np.bincount(axes, minlength=3) - 1000).max() < 104


@few
@given(seed=seeds)
def test_layers_have_one_height_and_cover_the_deck(seed: int) -> None:
    """Boxes that stand at one level end at one level, and that is where the next ones stand."""
    pallet = pallet_of("layered", seed)
    layers = grouped(pallet, [2])
    assert 2 <= len(layers) <= 6
    below = 0.0
    for layer in layers:
        assert (pallet.low[layer, 2] == below).all()
        below = pallet.high[layer[0], 2]
        assert (pallet.high[layer, 2] == below).all()
        assert pallet.sizes[layer[0], 2] >= 0.1
        assert pallet.sizes[layer, :2].prod(axis=1).sum() == pytest.approx(1.28, abs=1e-10)
    assert below == 1.0


def test_every_number_of_layers_occurs() -> None:
    """Two to six of them, uniformly: within four standard deviations over 1,000 pallets."""
    rng = np.random.default_rng(5)
    numbers = [len(set(GENERATORS["layered"](rng).low[:, 2].tolist())) for _ in range(1000)]
    seen = np.bincount(numbers, minlength=7)
    assert len(seen) == 7
    assert np.abs(seen[2:] - 200).max() < 51


@few
@given(seed=seeds)
def test_columns_stand_from_the_deck_to_the_top(seed: int) -> None:
    """Boxes of one footprint stand on one another without a gap, at most twelve of them."""
    pallet = pallet_of("columns", seed)
    towers = grouped(pallet, [0, 1])
    assert len(pallet) / 6 <= len(towers) <= len(pallet) / 2
    for tower in towers:
        assert len(tower) <= 12
        assert (pallet.high[tower, :2] == pallet.high[tower[0], :2]).all()
        faces = [0.0, *pallet.high[tower, 2].tolist()]
        assert pallet.low[tower, 2].tolist() == faces[:-1]
        assert faces[-1] == 1.0


@few
@given(seed=seeds)
def test_cubic_boxes_are_near_to_cubes_and_of_one_size(seed: int) -> None:
    """No side is below .35 of another one of its box, no box below .35 of another one.

    Both follow from cuts through the largest leaf's longest side at .35 to .65 of it.
    """
    sizes = pallet_of("cubic", seed).sizes
    volumes = sizes.prod(axis=1)
    assert (sizes.min(axis=1) >= 0.35 * sizes.max(axis=1) - 1e-9).all()
    assert volumes.min() >= 0.35 * volumes.max() - 1e-9


@pytest.mark.parametrize(("count", "smallest"), [(1, 0.05), (50, 0.05), (1000, 0.05), (5000, 0.02)])
def test_any_number_of_guillotine_boxes_fills_the_volume(count: int, smallest: float) -> None:
    """As many as asked for, none below the smallest side."""
    pallet = guillotine_boxes(np.random.default_rng(3), count, smallest=smallest)
    assert len(pallet) == count
    assert pallet.sizes.min() >= smallest
    assert pallet.sizes.prod(axis=1).sum() == pytest.approx(1.28, abs=1e-10)


def test_guillotine_boxes_fill_a_volume_of_any_size() -> None:
    """It begins where the others do, centred on y = 0."""
    pallet = guillotine_boxes(np.random.default_rng(3), 30, size=(1.2, 0.8, 2.0))
    assert pallet.x_max == 1.4 + 1.2
    assert pallet.low.min(axis=0) == pytest.approx([1.4, -0.4, 0.0], abs=1e-11)
    assert pallet.high.max(axis=0) == pytest.approx([2.6, 0.4, 2.0], abs=1e-11)


@pytest.mark.parametrize(
    ("count", "size", "smallest", "message"),
    [
        (0, (0.8, 1.6, 1.0), 0.05, "count: 0 is out of range; expected 1 box or more"),
        (9, (0.8, 1.6, 1.0), 0.0, "smallest: 0.0 m is out of range; expected a length above 0 m"),
        (
            9,
            (0.8, float("nan"), 1.0),
            0.05,
            "size: 0.8 x nan x 1 m is out of range; expected edges of 0.05 m or more",
        ),
        (
            9,
            (0.8, 0.01, 1.0),
            0.05,
            "size: 0.8 x 0.01 x 1 m is out of range; expected edges of 0.05 m or more",
        ),
        (
            10241,
            (0.8, 1.6, 1.0),
            0.05,
            "count: 10241 boxes with no side below 0.05 m have no room; expected at most 10240",
        ),
        (
            10,
            (0.1, 0.1, 0.6),
            0.05,
            "count: of 10 boxes only 8 could be cut; expected fewer boxes, or sides below 0.05 m",
        ),
    ],
)
def test_impossible_guillotine_boxes_are_refused(
    count: int, size: tuple[float, float, float], smallest: float, message: str
) -> None:
    """At once where it is plain, after a bounded number of tries where it turns out."""
    with pytest.raises(SettingError) as error:
        guillotine_boxes(np.random.default_rng(0), count, size=size, smallest=smallest)
    assert str(error.value) == message
