"""On top and occludes with probability: in the selection's sense, and right with noisy poses."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from seen_boxes import blurred, seen

from depal.domain import cell_from_pallet
from depal.geometry import OrientedBox, prisms_of
from depal.logistics import shipped_deliveries
from depal.perception.faces import SeenBox
from depal.perception.relations import Slack, chances_of, relations_of
from depal.selection.relations import PERCEIVED, relate

coordinate = st.floats(-0.5, 0.5)
edge = st.floats(0.1, 0.5)
boxes = st.lists(
    st.builds(
        lambda x, y, z, a, b, c, yaw: seen((x + 1.8, y, z + 0.6), (a, b, c), yaw),
        coordinate, coordinate, coordinate, edge, edge, edge, st.floats(-0.7, 0.7),
    ),
    min_size=1,
    max_size=6,
)  # fmt: skip


def sharp(box: SeenBox) -> SeenBox:
    """The same box with a pose that is known."""
    return SeenBox(box.shape, box.score, np.zeros((6, 6)))


@given(boxes)
def test_with_poses_that_are_known_the_relations_are_those_of_the_selection(
    pile: list[SeenBox],
) -> None:
    """Pair by pair: the same inequalities with the same tolerances."""
    prisms = prisms_of(box.shape for box in pile)
    chances = chances_of([sharp(box) for box in pile], Slack(PERCEIVED.overlap, PERCEIVED.slack))
    for a in range(len(pile)):
        for b in range(len(pile)):
            code = 0 if a == b else relate(prisms, a, b, PERCEIVED.overlap, PERCEIVED.slack)
            if code == 16:
                continue  # one inside the other: the selection refuses to answer
            for chance, bit in ((chances.on_top[a, b], 4), (chances.occludes[a, b], 8)):
                if min(chance, 1.0 - chance) < 0.05:  # not at the very edge of an inequality
                    assert bool(chance > 0.5) is bool(code & bit)


@given(boxes, st.permutations(range(6)))
def test_probabilities_depend_on_the_two_boxes_alone(pile: list[SeenBox], order: list[int]) -> None:
    """Whatever their order; each is a probability, and no box stands on itself."""
    kept = [index for index in order if index < len(pile)]
    one, two = chances_of(pile), chances_of([pile[index] for index in kept])
    for name in ("on_top", "occludes"):
        first, second = getattr(one, name), getattr(two, name)
        assert second == pytest.approx(first[np.ix_(kept, kept)], abs=1e-12)
        assert ((first >= 0.0) & (first <= 1.0)).all()
        assert (np.diag(first) < 1e-9).all()


@given(boxes, st.floats(1.0, 4.0))
def test_what_is_less_well_known_is_less_certain_where_it_holds(
    pile: list[SeenBox], factor: float
) -> None:
    """A conjunction of margins that all hold."""
    vague = [SeenBox(b.shape, b.score, b.covariance * factor**2) for b in pile]
    sure, unsure = chances_of(pile), chances_of(vague)
    for name in ("on_top", "occludes"):
        firm = getattr(sure, name) > 0.97
        assert (getattr(unsure, name)[firm] <= getattr(sure, name)[firm] + 1e-9).all()


def test_a_box_on_another_a_box_before_another_and_boxes_side_by_side() -> None:
    """As in the paper's Fig. 4."""
    low, high = seen((1.6, 0.0, 0.3)), seen((1.6, 0.0, 0.6))
    behind, beside = seen((1.9, 0.0, 0.3)), seen((1.6, 0.3, 0.3))
    on_top, occludes = relations_of([low, high, behind, beside])
    assert [(r.upper, r.lower) for r in on_top] == [(1, 0)]
    assert [(r.upper, r.lower) for r in occludes] == [(0, 2)]
    assert all(relation.probability > 0.99 for relation in (*on_top, *occludes))


@pytest.mark.parametrize("scale", [0.5, 1.0])
def test_precision_and_recall_on_the_shipped_deliveries_with_noisy_poses(scale: float) -> None:
    """Against the exact stack; errors as perception has them, and half as large."""
    random = np.random.default_rng(5)
    found = {"on_top": [0, 0, 0], "occludes": [0, 0, 0]}
    for delivery in shipped_deliveries():
        frame = cell_from_pallet(delivery.pallet_size)
        exact = [
            seen(solid.centre, solid.size, 0.0)
            for case in delivery.stack or ()
            for solid in [_upright(case.in_pallet.seen_from(frame))]
        ]
        truth = chances_of([sharp(box) for box in exact], Slack(1e-4, 1e-4))
        noisy = chances_of([blurred(box, random, scale) for box in exact])
        for name, counts in found.items():
            real, said = getattr(truth, name) > 0.5, getattr(noisy, name) > 0.5
            counts[0] += int((real & said).sum())
            counts[1] += int(said.sum())
            counts[2] += int(real.sum())
    for hits, said, real in found.values():
        assert hits / said >= 0.95
        assert hits / real >= 0.95


def _upright(solid: OrientedBox) -> OrientedBox:
    along = np.abs(np.array(solid.pose.rotation)) @ np.array(solid.size)
    x, y, z = along.tolist()
    return OrientedBox.upright(solid.centre, (x, y, z))
