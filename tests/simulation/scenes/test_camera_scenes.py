"""Scenes for perception: plausible piles, and a truth that fits the pictures."""

import itertools
import math
from dataclasses import replace

import numpy as np
import pytest

from depal.cell.files import shipped_cell
from depal.geometry import footprint_overlap, prisms_of
from depal.logistics import shipped_deliveries
from depal.logistics.gtin import gtin_fault
from depal.simulation.cases import cases_of
from depal.simulation.imaging.prints.design import design_of, family_of
from depal.simulation.scenes import (
    Kind,
    Scene,
    Severity,
    assortment,
    random_delivery,
    scene,
    sibling_share,
)
from depal.simulation.scenes.piles import loosened, unloaded

CELL = shipped_cell("default")
LAYOUT = replace(
    CELL,
    cameras=tuple(
        replace(
            mount,
            colour_size=(mount.colour_size[0] // 2, mount.colour_size[1] // 2),
            depth_size=(mount.depth_size[0] // 2, mount.depth_size[1] // 2),
        )
        for mount in CELL.cameras
    ),
)
"""The default cell with pictures of half the breadth and height."""

DELIVERY = shipped_deliveries()[2]
CASES = cases_of(DELIVERY, DELIVERY.stack or (), LAYOUT)


@pytest.fixture(scope="module", params=list(Kind))
def made(request: pytest.FixtureRequest) -> Scene:
    """A scene of each kind, a third of its boxes foreign."""
    return scene(DELIVERY, LAYOUT, 4, Severity.NORMAL, request.param, foreign=1 / 3)


def test_a_scene_has_a_frame_of_every_camera(made: Scene) -> None:
    """With the sizes and poses of the layout."""
    for frame, mount in zip(made.frames, LAYOUT.cameras, strict=True):
        assert frame.colour.shape == (*mount.colour_size[::-1], 3)
        assert frame.depth.shape == mount.depth_size[::-1]
        assert frame.cell_from_camera == mount.cell_from_camera


def test_faces_lie_on_their_boxes(made: Scene) -> None:
    """Corners of a face are corners of the box; fronts look to the robot, tops look up."""
    for box in made.truth.boxes:
        for face, outward in ((box.front, (-1, 0, 0)), (box.top, (0, 0, 1))):
            apart = np.linalg.norm(face.corners[:, None] - box.shape.corners[None], axis=2)
            assert apart.min(axis=1).max() < 1e-9
            inward = np.array(face.cell_from_face.rotation)[:, 2]
            assert -inward @ outward > math.cos(math.radians(45))
            u, v = face.corners[1] - face.corners[0], face.corners[3] - face.corners[0]
            assert (np.linalg.norm(u), np.linalg.norm(v)) == pytest.approx(face.size)
            assert np.cross(u, v) @ inward > 0.0
            assert u[1] < 0.0


def test_depths_lie_on_the_faces_that_count(made: Scene) -> None:
    """In the middle of a face that a camera sees whole, its depth is the face's."""
    checked = 0
    for box in made.truth.boxes:
        for face in (box.front, box.top):
            for frame, seen, angle in zip(made.frames, face.seen, face.angles, strict=True):
                if seen < 1.0 or angle > math.radians(60):
                    continue
                at = frame.cell_from_camera.inverse.apply(face.cell_from_face.translation)
                (fx, _, cx), (_, fy, cy), _ = frame.depth_k
                x, y = round(at[0] / at[2] * fx + cx), round(at[1] / at[2] * fy + cy)
                patch = frame.depth[y - 4 : y + 5, x - 4 : x + 5]
                if (patch > 0).any():
                    assert abs(np.median(patch[patch > 0]) - at[2]) < 0.035 * at[2]
                    checked += 1
    assert checked > 5


def test_what_counts_is_seen_by_some_camera_not_too_flatly(made: Scene) -> None:
    """The visible share of all cameras is at least each one's, unless that one sees it flatly."""
    for box in made.truth.boxes:
        for face in (box.front, box.top):
            fair = [s for s, a in zip(face.seen, face.angles, strict=True) if a < math.radians(70)]
            assert max(fair, default=0.0) <= face.visible <= min(sum(fair), 1.0) + 1e-9
            assert face.counts == (face.visible >= 0.7)
    assert any(box.front.counts for box in made.truth.boxes)
    assert any(box.top.counts for box in made.truth.boxes)


def test_foreign_boxes_are_on_no_note_and_half_of_them_are_siblings(made: Scene) -> None:
    """Well-formed numbers; a sibling has a known range's artwork and not a known product's."""
    known = set(DELIVERY.products)
    foreign = [box.gtin for box in made.truth.boxes if box.foreign]
    assert len(foreign) == round(len(made.truth.boxes) / 3)
    assert not known.intersection(foreign)
    assert all(gtin_fault(gtin) is None for gtin in foreign)
    families = {family_of(gtin) for gtin in known}
    siblings = [gtin for gtin in foreign if family_of(gtin) in families]
    assert len(siblings) == math.ceil(len(foreign) / 2)
    assert not {design_of(g) for g in siblings} & {design_of(g) for g in known}
    counts = {line.product.gtin: line.count for line in made.note.lines}
    own = [box.gtin for box in made.truth.boxes if not box.foreign]
    assert counts == {gtin: own.count(gtin) for gtin in set(own)}


def test_on_top_means_touching_and_what_stands_on_the_pallet_stands_on_nothing(
    made: Scene,
) -> None:
    """The upper bottom is at the lower top; a box above the deck has something below."""
    boxes = made.truth.boxes
    bottoms = [box.shape.centre[2] - box.shape.size[2] / 2 for box in boxes]
    carried = {upper for upper, _ in made.truth.on_top}
    for upper, lower in made.truth.on_top:
        top = bottoms[lower] + boxes[lower].shape.size[2]
        assert abs(bottoms[upper] - top) < 0.006
    deck = LAYOUT.pallet.size[2]
    assert carried == {k for k, bottom in enumerate(bottoms) if bottom > deck + 0.01}


def test_the_same_seed_gives_the_same_bytes() -> None:
    """And another seed another picture."""
    one, two, other = (scene(DELIVERY, LAYOUT, seed, kind=Kind.UNLOADED) for seed in (1, 1, 2))
    assert one.truth == two.truth
    for a, b in zip(one.frames, two.frames, strict=True):
        assert a.colour.tobytes() == b.colour.tobytes()
        assert a.depth.tobytes() == b.depth.tobytes()
    assert other.frames[0].depth.tobytes() != one.frames[0].depth.tobytes()


@pytest.mark.parametrize("seed", range(6))
def test_no_box_is_left_without_what_it_stands_on(seed: int) -> None:
    """Unloading takes what is free, from above and from the front."""
    left = {case.index for case in unloaded(CASES, np.random.default_rng(seed))}
    assert 0 < len(left) < len(CASES)
    rows = prisms_of(case.shape for case in CASES)
    for upper, lower in itertools.permutations(range(len(CASES)), 2):
        gap = rows[upper, 2] - rows[upper, 5] - rows[lower, 2] - rows[lower, 5]
        if upper in left and abs(gap) < 1e-3 and footprint_overlap(rows, upper, lower) > 0.01:
            assert lower in left


@pytest.mark.parametrize("seed", range(4))
def test_loosened_boxes_are_turned_and_do_not_reach_into_each_other(seed: int) -> None:
    """Most of them are turned; none overlaps another."""
    moved = loosened(CASES, np.random.default_rng(seed), math.radians(3), 0.03)
    rows = prisms_of(case.shape for case in moved)
    before = prisms_of(case.shape for case in CASES)
    assert np.count_nonzero(np.abs(rows[:, 7]) > 0.01) > len(rows) / 2
    for a, b in itertools.combinations(range(len(rows)), 2):
        if abs(rows[a, 2] - rows[b, 2]) < rows[a, 5] + rows[b, 5] - 2e-3:
            assert footprint_overlap(rows, a, b) <= max(footprint_overlap(before, a, b), 0.0) + 1e-9


@pytest.mark.parametrize("seed", range(3))
def test_random_deliveries_are_stacked_and_have_twins(seed: int) -> None:
    """As many cases on the stack as on the note; well-formed numbers."""
    delivery = random_delivery(seed)
    assert delivery.stack is not None
    assert len(delivery.stack) == len(delivery.boxes)
    assert all(gtin_fault(gtin) is None for gtin in delivery.products)


@pytest.mark.parametrize("seed", range(3))
def test_at_least_three_in_ten_products_have_a_sibling_of_equal_size(seed: int) -> None:
    """In what a store sells, and nearly so in a random delivery; none look the same."""
    shipped = {line.product.gtin: line.product for d in shipped_deliveries() for line in d.lines}
    sold = assortment(shipped.values(), seed)
    assert sibling_share(sold) >= 0.3
    assert len({product.gtin for product in sold}) == len(sold) > len(shipped)
    assert set(shipped) < {product.gtin for product in sold}
    assert len({design_of(product.gtin) for product in sold}) == len(sold)
    assert all(gtin_fault(product.gtin) is None for product in sold)
    random = [p for k in range(8) for p in random_delivery(8 * seed + k).products.values()]
    assert sibling_share(random) >= 0.3


def test_foreign_boxes_are_nothing_that_the_store_sells() -> None:
    """A book may know more than the note."""
    sold = assortment(DELIVERY.products.values(), share=0.9)
    known = frozenset(product.gtin for product in sold)
    made = scene(DELIVERY, LAYOUT, 2, foreign=0.5, known=known)
    assert not known & {box.gtin for box in made.truth.boxes if box.foreign}
