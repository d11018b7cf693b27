"""A sample of every figure of perception, on a few scenes, with room for the noise of so few."""

import math

import pytest

from depal.perception.faces import Facing
from depal.simulation.scenes import Kind, Severity
from depal.studies.bench.perception import Extent, bench_perception, busy_pieces
from depal.studies.perception.eye import open_eye
from depal.studies.perception.scenes import calibrated, delivery_of, pieces, scene_of
from depal.studies.perception.truth import truth_of

SAMPLED = 0.6
"""Precision and recall of a few scenes; the figures themselves are for `make figures`."""


@pytest.mark.slow
def test_a_few_scenes_show_every_figure() -> None:
    """A full and an unloaded one, and one for the time; the rest is `make figures`."""
    told: list[tuple[int, int]] = []
    extent = Extent((Severity.NORMAL,), scenes=2, timed=1)
    result = bench_perception(extent, open_eye, progress=lambda *at: told.append(at))
    assert told[-1] == (4, 4)
    kinds = [one.piece.kind for one in result.scenes[Severity.NORMAL]]
    assert kinds == [Kind.FULL, Kind.UNLOADED]
    figures = {figure.name.removeprefix("normal: "): figure for figure in result.figures}
    for facing in Facing:
        for what in ("precision", "recall"):
            assert figures[f"{facing.value} faces: {what}"].value >= SAMPLED
        assert figures[f"{facing.value} faces: centre in depth, p95"].value <= 30.0
    looks = [figure for name, figure in figures.items() if "look, " in name]
    assert len(looks) == 2
    assert all(0.0 < figure.value < 30.0 for figure in looks)


@pytest.mark.slow
def test_the_truth_of_a_scene_has_siblings_strangers_and_stocks() -> None:
    """Every box with both faces; calibrated frames know where they were taken from."""
    (piece,) = pieces(Severity.NORMAL, 1, seed=3)
    delivery = delivery_of(piece.seed)
    made = scene_of(piece, delivery)
    truth = truth_of(made, [line.product for line in delivery.lines])
    assert len(truth.faces) == 2 * len(truth.boxes)
    assert {face.box for face in truth.faces} == set(range(len(truth.boxes)))
    assert {box.known for box in truth.boxes} == {True, False}
    assert {box.stock for box in truth.boxes} <= {"printed", "kraft", "plain"}
    assert any(box.sibling for box in truth.boxes if not box.known)
    for frame, mount in zip(calibrated(made), made.layout.cameras, strict=True):
        off = math.dist(frame.cell_from_camera.translation, mount.cell_from_camera.translation)
        assert off < 0.01


def test_busy_scenes_are_of_the_deliveries_with_the_most_faces() -> None:
    """One more than is timed: the first one warms up."""
    busy = busy_pieces(4)
    assert len(busy) == 5
    assert len({piece.seed for piece, _ in busy}) == 5
    assert {delivery.id for _, delivery in busy} == {"dev-056", "dev-041", "dev-024"}
    assert not busy_pieces(0)
