"""What is printed on the boxes."""

import numpy as np
import pytest
import zxingcpp
from hypothesis import given
from hypothesis import strategies as st

from depal.geometry import OrientedBox
from depal.logistics import shipped_deliveries
from depal.simulation.imaging.atlas import LEVELS, AtlasBuilder
from depal.simulation.imaging.prints import PrintedBoxes, Stock, design_of, label_for
from depal.simulation.imaging.prints.design import family_of
from depal.simulation.imaging.prints.label import BARS, MARGIN, QUIET, label_image

GTINS = sorted({case.gtin for d in shipped_deliveries() for case in d.stack or ()})


@given(st.floats(0.05, 0.6), st.floats(0.03, 0.6))
def test_a_label_fits_its_side_with_bars_of_at_least_0_4_mm(width: float, height: float) -> None:
    """At most about 100 by 60 mm, quiet zones within, a margin around."""
    label = label_for((width, height))
    if label is None:
        assert width < 0.0736 or height < 0.037 + 1e-9
        return
    assert label.module >= 0.4e-3
    assert label.size[0] <= min(width - 2 * MARGIN, 0.1) + 1e-9
    assert label.size[0] == pytest.approx((BARS + 2 * QUIET) * label.module)
    assert label.below + label.size[1] / 2 <= height / 2
    assert label.size[1] <= 0.06


@pytest.mark.parametrize("gtin", [*GTINS[:8], "4006381333931"])
def test_a_label_says_the_14_digits(gtin: str) -> None:
    """Read by a program that did not write it: as GS1-128 with the identifier 01."""
    label = label_for((0.3, 0.2))
    assert label is not None
    picture = label_image(gtin, "case", label)
    (code,) = zxingcpp.read_barcodes(np.ascontiguousarray(picture[..., 0]))
    assert code.bytes == b"01" + gtin.zfill(14).encode()
    assert code.symbology_identifier == "]C1"


def test_all_sides_but_top_and_bottom_carry_a_label() -> None:
    """Four labels of two triangles each beside the box's twelve, each just before its side."""
    mesh = PrintedBoxes(AtlasBuilder()).mesh(GTINS[0], (0.3, 0.2, 0.25), 7)
    assert len(mesh.parts) == 12 + 8
    assert set(mesh.parts.tolist()) == {7}
    beyond = np.abs(mesh.corners) - (0.15, 0.1, 0.125)
    out = beyond.max(axis=(1, 2))
    assert np.count_nonzero(out > 1e-9) == 8
    assert out.max() < 0.001
    assert np.all(np.abs(mesh.normals[out > 1e-9][..., 2]) < 0.1)


@given(st.sampled_from(GTINS), st.floats(0.1, 0.5), st.floats(0.1, 0.5))
def test_a_turned_case_is_the_same_case_turned(gtin: str, one: float, two: float) -> None:
    """What stands with its length along y has the corners and the prints of its own box."""
    prints = PrintedBoxes(AtlasBuilder())
    size = (min(one, two), max(one, two), 0.2)
    mesh = prints.mesh(gtin, size, 0)
    corners = np.unique(mesh.corners[:12].reshape(-1, 3).round(6), axis=0)
    expected = np.unique(OrientedBox.upright((0, 0, 0), size).corners.round(6), axis=0)
    np.testing.assert_allclose(corners, expected, atol=2e-6)
    other = prints.mesh(gtin, (size[1], size[0], size[2]), 0)
    assert mesh.skins.tolist() == other.skins.tolist()


def test_a_third_of_the_products_have_a_sibling_that_differs_in_a_word_or_a_colour() -> None:
    """The same stock, motif, name and ground; what is their own differs for nearly all."""
    families: dict[str, list[str]] = {}
    for gtin in GTINS:
        families.setdefault(family_of(gtin), []).append(gtin)
    siblings = [gtin for family in families.values() if len(family) > 1 for gtin in family]
    assert len(siblings) >= 0.3 * len(GTINS)
    for family in families.values():
        designs = [design_of(gtin) for gtin in family]
        assert len({(d.stock, d.motif, d.brand, d.ground, d.seed) for d in designs}) == 1
    assert len({design_of(gtin) for gtin in GTINS}) == len(GTINS)


def test_no_two_products_of_a_range_look_the_same() -> None:
    """All thousand numbers that a range can have, differing in a word, an amount or a colour."""
    designs = [design_of(f"1234567890{number:03d}0") for number in range(1000)]
    assert len(set(designs)) == 1000
    assert len({(d.stock, d.motif, d.brand, d.ground, d.seed) for d in designs}) == 1


def test_some_cases_are_printed_all_over_some_are_plain_some_are_brown() -> None:
    """Over the ranges of a thousand makers."""
    stocks = [design_of(f"{number:010d}0000").stock for number in range(1000)]
    shares = {stock: stocks.count(stock) / 1000 for stock in Stock}
    assert shares[Stock.GRAPHIC] > 0.5
    assert shares[Stock.PLAIN] > 0.1
    assert shares[Stock.KRAFT] > 0.2


def test_the_same_product_is_printed_the_same_and_once() -> None:
    """In every atlas the same texels; a second case of a product adds none."""
    atlases = []
    for _ in range(2):
        builder = AtlasBuilder()
        prints = PrintedBoxes(builder)
        prints.mesh(GTINS[1], (0.3, 0.2, 0.25), 0)
        once = len(builder.build().texels)
        prints.mesh(GTINS[1], (0.2, 0.3, 0.25), 1)
        atlases.append(builder.build())
        assert len(atlases[-1].texels) == once
    assert atlases[0].texels.tobytes() == atlases[1].texels.tobytes()


def test_coarser_levels_of_a_texture_keep_its_mean() -> None:
    """Each level is half as wide and high; a chequerboard becomes grey."""
    builder = AtlasBuilder()
    board = np.indices((64, 32)).sum(axis=0) % 2 * 200
    builder.add(np.repeat(board[..., None], 3, axis=2).astype(np.uint8))
    atlas = builder.build()
    assert atlas.table.shape == (1, LEVELS, 3)
    for start, width, height in atlas.table[0, 1:].tolist():
        assert np.all(atlas.texels[start : start + width * height] == 100)
    assert atlas.table[0, :, 1].tolist() == [32, 16, 8, 4, 2, 1, 1, 1]
